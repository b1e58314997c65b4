/**
 * Finds where a plot resumes after the board has refused some of its commands. The board continues with the commands
 * that it already had. Each has the planned shape, but is offset by the distance of the refused ones.
 *
 *   planned   ━━━━━a━━━━━b━━━━━c━━━━━       refused: a to b
 *   drawn     ━━━━━a━━━━━c'                 b to c, drawn from a on
 *
 * If the stroke is straight, or the refused commands were short, a to c' is on the stroke, and the plot resumes from c'.
 * Otherwise the drawn line is beside the stroke, and the plot resumes from a, so that nothing is missing.
 */
import type { StrokeSet } from "../../../drawing/stroke-set.js";
import { placeFromMotors } from "../../../machines/motors.js";
import type { MachineProfile } from "../../../machines/profile.js";
import { isPenUpBefore } from "../../../plan/pen-moves.js";
import { pointOfPlace, snappedPlace } from "../../../plan/place-on-drawing.js";
import type { Place } from "../../../plan/trajectory.js";
import type { CommandStream } from "../compile/command-stream.js";
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
  /** In the order in which they were sent. */
  readonly refused: readonly RefusedCommand[];
  /** Where the board stopped, as if the refused commands had run; null: nothing has run. */
  readonly at: NumberedPlace | null;
  readonly steps1: number;
  readonly steps2: number;
}

interface Lookups {
  partOf(stream: CommandStream): EbbPart;
  /** The place in the drawing for a place of a stream, with the carriage at x, y. */
  placeOf(place: StreamPlace, x: number, y: number): Place | null;
}

type Point = { readonly x: number; readonly y: number };

export function placeAfterRefusal(
  strokes: StrokeSet,
  machine: MachineProfile,
  { refused, at, steps1, steps2 }: RefusedStop,
  { partOf, placeOf }: Lookups,
): Place | null {
  const pointBefore = (stream: CommandStream, i: number): Point => {
    const state = boardStateBefore(stream, i, partOf(stream).start);
    return placeFromMotors(machine, state.steps1, state.steps2);
  };
  const isMove = ({ at: { stream, commandIndex: i } }: RefusedCommand): boolean =>
    distance(pointBefore(stream, i), pointBefore(stream, i + 1)) > 0;
  /** Without the drop, or the wait for it, the next stroke begins in the air. */
  const dropsPen = ({ at: { stream, commandIndex: i } }: RefusedCommand): boolean => {
    const { trajectory } = partOf(stream);
    const isAtRest = stream.run[i] < 0;
    return (
      !isPenUpBefore(trajectory, stream.planS[i + 1]) &&
      (isAtRest || isPenUpBefore(trajectory, stream.planS[i]))
    );
  };
  const hasRunAfter = ({ command }: RefusedCommand): boolean =>
    at === null || (command !== null && at.number > command.number);
  // A refused lift or height leaves nothing out.
  const first = refused.find((one) => hasRunAfter(one) && (isMove(one) || dropsPen(one)));
  const stop = placeFromMotors(machine, steps1, steps2);
  if (!first) return at && placeOf(at, stop.x, stop.y);

  const { stream, commandIndex: index } = first.at;
  const from = pointBefore(stream, index);
  const place = placeOf(first.at, from.x, from.y);
  const run = stream.run[index];
  if (!at || !place || run < 0 || !isMove(first)) return place;
  // Follow the commands of the stroke that ran after the refused one.
  const isRefused = (i: number): boolean =>
    refused.some((one) => one.at.stream === stream && one.at.commandIndex === i);
  const isSame = at.stream === stream;
  let drawnTo = place;
  let end = from;
  let drawnMm = 0;
  for (let i = index + 1; i < stream.count && stream.run[i] === run; i++) {
    if (isSame && i > at.commandIndex) break;
    if (isRefused(i)) continue;
    const [a, b] = [pointBefore(stream, i), pointBefore(stream, i + 1)];
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
