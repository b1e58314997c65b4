/** Questions that a driver asks of a plan: where the pen is up, which stroke comes next, how far a place is. */
import {
  stateAt,
  xFromMotors,
  yFromMotors,
  type BoardState,
  type CommandStream,
  type MachineProfile,
  type Place,
  type StrokeSet,
  type Trajectory,
} from "../../src/index.js";

/** Rounding between a command's plan time and the trajectory's. */
const SAME_TIME_S = 1e-7;

/** What the board holds after the commands before `index`. */
export function boardStateBefore(stream: CommandStream, index: number, start: BoardState): BoardState {
  if (index === 0) return start;
  return {
    steps1: stream.steps1[index - 1]!,
    steps2: stream.steps2[index - 1]!,
    acc1: stream.acc1[index - 1]!,
    acc2: stream.acc2[index - 1]!,
  };
}

export function placeOfSteps(
  machine: MachineProfile,
  steps1: number,
  steps2: number,
): { x: number; y: number } {
  return { x: xFromMotors(machine, steps1, steps2), y: yFromMotors(machine, steps1, steps2) };
}

/** The first place that is still to be drawn at `planS`, when the carriage rests there; null when none is. */
export function nextPlace(trajectory: Trajectory, planS: number): Place | null {
  const { runs } = trajectory;
  for (let run = 0; run < runs.count; run++) {
    if (runs.stroke[run]! < 0 || runs.startS[run]! < planS - SAME_TIME_S) continue;
    const block = runs.firstBlock[run]!;
    const isDot = runs.firstBlock[run + 1] === block;
    return { stroke: runs.stroke[run]!, alongMm: isDot ? 0 : trajectory.alongMm[block]! };
  }
  return null;
}

/** The place at `planS` where a stroke is being drawn, else the next one to be drawn. */
export function placeAt(trajectory: Trajectory, planS: number): Place | null {
  const state = stateAt(trajectory, planS);
  return state.stroke >= 0 ? { stroke: state.stroke, alongMm: state.alongMm } : nextPlace(trajectory, planS);
}

/** A place moved along the drawing by whole strokes or by mm; it stays within the drawing. */
export function movedPlace(
  strokes: StrokeSet,
  place: Place,
  by: { readonly strokes?: number | undefined; readonly mm?: number | undefined },
): Place {
  const last = strokes.offsets.length - 2;
  let { stroke, alongMm } = place;
  if (by.strokes) {
    // Back from the middle of a stroke means to its beginning first.
    const back = by.strokes < 0 && alongMm > 0 ? 1 : 0;
    stroke = Math.min(last, Math.max(0, stroke + by.strokes + back));
    alongMm = 0;
  }
  alongMm += by.mm ?? 0;
  while (alongMm < 0 && stroke > 0) alongMm += strokeLengthMm(strokes, --stroke);
  while (stroke < last && alongMm > strokeLengthMm(strokes, stroke)) {
    alongMm -= strokeLengthMm(strokes, stroke++);
  }
  return { stroke, alongMm: Math.min(Math.max(0, alongMm), strokeLengthMm(strokes, stroke)) };
}

export function strokeLengthMm({ xy, offsets }: StrokeSet, stroke: number): number {
  let lengthMm = 0;
  for (let i = offsets[stroke]! + 1; i < offsets[stroke + 1]!; i++) {
    lengthMm += Math.hypot(xy[2 * i]! - xy[2 * i - 2]!, xy[2 * i + 1]! - xy[2 * i - 1]!);
  }
  return lengthMm;
}

/** The point of the drawing at a place, mm. */
export function pointOfPlace({ xy, offsets }: StrokeSet, place: Place): { x: number; y: number } {
  let leftMm = place.alongMm;
  const end = offsets[place.stroke + 1]! - 1;
  for (let i = offsets[place.stroke]!; i < end; i++) {
    const x = xy[2 * i]!;
    const y = xy[2 * i + 1]!;
    const dx = xy[2 * i + 2]! - x;
    const dy = xy[2 * i + 3]! - y;
    const lengthMm = Math.hypot(dx, dy);
    if (leftMm <= lengthMm && lengthMm > 0) {
      return { x: x + (dx * leftMm) / lengthMm, y: y + (dy * leftMm) / lengthMm };
    }
    leftMm -= lengthMm;
  }
  return { x: xy[2 * end]!, y: xy[2 * end + 1]! };
}

/** A pen's place, mm, and velocity, mm/s. */
interface Moving {
  readonly x: number;
  readonly y: number;
  readonly vx: number;
  readonly vy: number;
}

/**
 * The place on the same stroke that is nearest to a point, found by following the stroke as long as it comes nearer, not
 * further than `withinMm`: where the plan rounds a corner or fits a curve, mm along it and mm along the drawing are not
 * quite the same. The other side of a narrow tip may be nearer still, and is another place; one that the stroke passes the
 * other way than `vx`, `vy` is not where the pen is, and the given place stays.
 */
export function snappedPlace(
  { xy, offsets }: StrokeSet,
  place: Place,
  { x, y, vx, vy }: Moving,
  withinMm: number,
): Place {
  const { stroke, alongMm } = place;
  const [first, end] = [offsets[stroke]!, offsets[stroke + 1]! - 1];
  const lengthOf = (i: number): number =>
    Math.hypot(xy[2 * i + 2]! - xy[2 * i]!, xy[2 * i + 3]! - xy[2 * i + 1]!);
  if (first >= end) return place;
  let i = first;
  let fromMm = 0;
  while (i + 1 < end && fromMm + lengthOf(i) < alongMm) fromMm += lengthOf(i++);
  for (let way = 0; ;) {
    const lengthMm = lengthOf(i);
    const [dx, dy] = [xy[2 * i + 2]! - xy[2 * i]!, xy[2 * i + 3]! - xy[2 * i + 1]!];
    const dot = (x - xy[2 * i]!) * dx + (y - xy[2 * i + 1]!) * dy;
    const footMm = lengthMm > 0 ? dot / lengthMm : way;
    const next = footMm > lengthMm ? 1 : footMm < 0 ? -1 : 0;
    const nearestMm = fromMm + Math.min(lengthMm, Math.max(0, footMm));
    const isThere = next === 0 || next === -way || i + next < first || i + next >= end;
    if (isThere || Math.abs(nearestMm - alongMm) >= withinMm) {
      if (dx * vx + dy * vy < 0) return place;
      const byMm = Math.min(withinMm, Math.max(-withinMm, nearestMm - alongMm));
      return { stroke, alongMm: alongMm + byMm };
    }
    way = next;
    fromMm += way > 0 ? lengthMm : -lengthOf(i - 1);
    i += way;
  }
}

/** The first command that begins `leadS` after command `index` or later. */
export function commandAfter(commands: CommandStream, index: number, leadS: number): number {
  const fromS = commands.boardS[index]! + leadS;
  let i = index;
  while (i < commands.count && commands.boardS[i]! < fromS) i++;
  return i;
}

/** A plan begins with the pen coming down; here it is down already. */
export function withoutDrop(commands: CommandStream): CommandStream {
  let first = 0;
  while (first < commands.count && commands.run[first]! < 0) first++;
  return streamFrom(commands, first);
}

/** A stream without its first commands. */
function streamFrom(stream: CommandStream, index: number): CommandStream {
  return {
    ...stream,
    count: stream.count - index,
    textOffsets: stream.textOffsets.subarray(index),
    boardS: stream.boardS.subarray(index),
    planS: stream.planS.subarray(index),
    steps1: stream.steps1.subarray(index),
    steps2: stream.steps2.subarray(index),
    acc1: stream.acc1.subarray(index),
    acc2: stream.acc2.subarray(index),
    run: stream.run.subarray(index),
  };
}

/** A stream of commands in which the motors rest: each with the seconds that it holds the board's queue. */
export function restingStream(
  lines: readonly (readonly [line: string, durationS: number])[],
  state: BoardState,
  planS: number,
): CommandStream {
  const count = lines.length;
  const characters = lines.map(([line]) => `${line}\r`).join("");
  const textOffsets = new Uint32Array(count + 1);
  const boardS = new Float64Array(count + 1);
  lines.forEach(([line, durationS], i) => {
    textOffsets[i + 1] = textOffsets[i]! + line.length + 1;
    boardS[i + 1] = boardS[i]! + durationS;
  });
  return {
    count,
    text: Uint8Array.from(characters, (character) => character.charCodeAt(0)),
    textOffsets,
    boardS,
    planS: new Float64Array(count + 1).fill(planS),
    steps1: new Int32Array(count).fill(state.steps1),
    steps2: new Int32Array(count).fill(state.steps2),
    acc1: new Uint32Array(count).fill(state.acc1),
    acc2: new Uint32Array(count).fill(state.acc2),
    run: new Int32Array(count).fill(-1),
    warnings: [],
  };
}
