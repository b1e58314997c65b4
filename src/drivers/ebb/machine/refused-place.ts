/**
 * Finds where a plot resumes after the board has refused one of its commands. The board continues with the commands
 * that it already had. Each has the planned shape, but is offset by the distance of the refused one.
 *
 *   planned   ━━━━━a━━━━━b━━━━━c━━━━━       refused: a to b
 *   drawn     ━━━━━a━━━━━c'                 b to c, drawn from a on
 *
 * If the stroke is straight, or the refused command was short, a to c' is on the stroke, and the plot resumes from c'.
 * Otherwise the drawn line is beside the stroke, and the plot resumes from a, so that nothing is missing.
 */
import type { StrokeSet } from "../../../drawing/stroke-set.js";
import { placeFromMotors } from "../../../machines/motors.js";
import type { MachineProfile } from "../../../machines/profile.js";
import { isPenUpBefore } from "../../../plan/pen-moves.js";
import { pointOfPlace, snappedPlace } from "../../../plan/place-on-drawing.js";
import type { Place } from "../../../plan/trajectory.js";
import { boardStateBefore } from "../stream/cut-streams.js";
import type { NumberedPlace } from "../stream/stop-place.js";
import type { RefusedCommand } from "../stream/stream-types.js";
import type { StreamPlace } from "../stream/timeline.js";
import type { EbbPart } from "./ebb-part.js";

/** A line drawn this close to the stroke counts as drawn, mm. */
const BESIDE_MM = 0.08;
/** Tolerance between mm along the motion and mm along the drawing. */
const SNAP_MM = 0.5;

interface RefusedStop {
  readonly refused: RefusedCommand;
  /** Where the board stopped, as if the refused command had run; null: nothing has run. */
  readonly at: NumberedPlace | null;
  readonly steps1: number;
  readonly steps2: number;
}

type Point = { readonly x: number; readonly y: number };

/** `placeOf`: the place in the drawing for a place of a stream, with the carriage at x, y. */
export function placeAfterRefusal(
  strokes: StrokeSet,
  machine: MachineProfile,
  part: EbbPart,
  { refused, at, steps1, steps2 }: RefusedStop,
  placeOf: (place: StreamPlace, x: number, y: number) => Place | null,
): Place | null {
  const { commands, trajectory, start } = part;
  const index = refused.at.commandIndex;
  const pointBefore = (i: number): Point => {
    const state = boardStateBefore(commands, i, start);
    return placeFromMotors(machine, state.steps1, state.steps2);
  };
  const [from, to] = [pointBefore(index), pointBefore(index + 1)];
  const stop = placeFromMotors(machine, steps1, steps2);
  const isAfter = at !== null && refused.command !== null && at.number > refused.command.number;
  const dropsPen =
    isPenUpBefore(trajectory, commands.planS[index]) && !isPenUpBefore(trajectory, commands.planS[index + 1]);
  const isMove = from.x !== to.x || from.y !== to.y;
  if (at && (!isAfter || (!isMove && !dropsPen))) return placeOf(at, stop.x, stop.y);

  const place = placeOf(refused.at, from.x, from.y);
  const run = commands.run[index];
  if (!at || !place || run < 0 || !isMove) return place;
  // Follow the commands of the stroke that ran after the refused one.
  const isSame = at.stream === commands;
  let drawnTo = place;
  let end = from;
  let drawnMm = 0;
  for (let i = index + 1; i < commands.count && commands.run[i] === run; i++) {
    if (isSame && i > at.commandIndex) break;
    const [a, b] = [pointBefore(i), pointBefore(i + 1)];
    const isLast = isSame && i === at.commandIndex;
    const next = isLast ? stop : { x: end.x + b.x - a.x, y: end.y + b.y - a.y };
    drawnMm += distance(end, next);
    const moving = { ...next, vx: next.x - end.x, vy: next.y - end.y };
    drawnTo = snappedPlace(strokes, { ...place, alongMm: place.alongMm + drawnMm }, moving, SNAP_MM);
    if (distance(pointOfPlace(strokes, drawnTo), next) > BESIDE_MM) return place;
    end = next;
  }
  return drawnTo;
}

const distance = (a: Point, b: Point): number => Math.hypot(a.x - b.x, a.y - b.y);
