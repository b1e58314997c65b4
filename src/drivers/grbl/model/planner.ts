/**
 * A model of Grbl's own planner: the speed of each move in its queue. The job uses it to predict the motion, the virtual
 * Grbl to perform it. Written from the description of planner.c: a limit for each corner by junction deviation, one pass
 * backwards from rest at the end of the queue, then constant acceleration.
 *
 * A Grbl that is built for CoreXY (motors A = x + y, B = x - y) plans the way of its motors, which is √2 times that of the
 * carriage: so the carriage moves at F/√2, and `$110`, `$120` … limit the motors.
 */

/** X, Y and Z: a position in mm, a unit vector, or the limits of the axes. */
export type Axes = readonly [x: number, y: number, z: number];

export const difference = (a: Axes, b: Axes): Axes => [a[0] - b[0], a[1] - b[1], a[2] - b[2]];

export const sum = (a: Axes, b: Axes): Axes => [a[0] + b[0], a[1] + b[1], a[2] + b[2]];

export interface GrblAxisLimits {
  /** mm/s. */
  readonly speed: Axes;
  /** mm/s². */
  readonly accel: Axes;
  readonly junctionMm: number;
  /** It is built for CoreXY: the limits of X and Y are those of the motors. Default false. */
  readonly isCore?: boolean;
}

/** How far such a Grbl counts a move of X and Y by 1 mm. */
const CORE_MM = Math.SQRT2;

/** One straight move in the queue. */
export interface Move {
  readonly unit: Axes;
  readonly lengthMm: number;
  readonly accel: number;
  /** Limit by the feed and the axes, mm/s. */
  readonly speed: number;
  /** Max speed² at its start, before the limit by the moves after it. */
  readonly maxEntry2: number;
}

/** Max moves in the queue of an Arduino, including the running one. */
export const QUEUE_MOVES = 15;

/**
 * A Grbl cuts the next moves into slices of 10 ms, at most one move each, and keeps a few of them ready. A move whose slices
 * are all cut has left the queue, but is not done. An Arduino keeps 5 slices, a FluidNC 12.
 */
export const MAX_SLICES = 12;

/** A corner with a greater cosine than this counts as straight, or as a reversal. */
const SAME = 0.999999;

/** The feed at which X and Y move at a speed; both in the same unit. */
export const feedFor = (speed: number, { isCore = false }: GrblAxisLimits): number =>
  isCore ? speed * CORE_MM : speed;

/** A move between two different positions. `before`: the previous move in the queue. */
export function moveOf(
  from: Axes,
  to: Axes,
  feed: number,
  limits: GrblAxisLimits,
  before: Move | null,
): Move {
  const delta = difference(to, from);
  const lengthMm = Math.hypot(...delta);
  const unit: Axes = [delta[0] / lengthMm, delta[1] / lengthMm, delta[2] / lengthMm];
  const isCore = limits.isCore === true && (delta[0] !== 0 || delta[1] !== 0);
  const asked = isCore ? feed / CORE_MM : feed;
  const speed = Math.min(asked, alongAxes(limits.speed, unit, isCore));
  const maxEntry2 = before
    ? Math.min(junctionSpeed2(before.unit, unit, limits), speed ** 2, before.speed ** 2)
    : 0;
  return { unit, lengthMm, accel: alongAxes(limits.accel, unit, isCore), speed, maxEntry2 };
}

/** The limit along a direction that follows from the limits of the axes. */
function alongAxes(limits: Axes, unit: Axes, isCore: boolean): number {
  const [x, y, z] = unit;
  const moved = isCore ? [x + y, x - y, z] : unit;
  let max = Infinity;
  for (let i = 0; i < 3; i++) if (moved[i] !== 0) max = Math.min(max, limits[i] / Math.abs(moved[i]));
  return max;
}

/** Max speed² around a corner: that of a circle that passes it within the junction deviation. */
export function junctionSpeed2(before: Axes, after: Axes, limits: GrblAxisLimits): number {
  const { accel, junctionMm, isCore = false } = limits;
  const cos = -(before[0] * after[0] + before[1] * after[1] + before[2] * after[2]);
  if (cos > SAME) return 0;
  if (cos < -SAME) return Infinity;
  const sine = Math.sqrt((1 - cos) / 2);
  const turn = difference(after, before);
  const size = Math.hypot(...turn);
  const along = alongAxes(accel, [turn[0] / size, turn[1] / size, turn[2] / size], isCore);
  return (along * (isCore ? junctionMm / CORE_MM : junctionMm) * sine) / (1 - sine);
}

/** Max speed² at the end of move `i` from which the moves before `end` can come to rest. */
export function exitLimit2(moves: readonly Move[], i: number, end: number): number {
  let speed2 = 0;
  for (let j = end - 1; j > i; j--) {
    const { maxEntry2, accel, lengthMm } = moves[j];
    speed2 = Math.min(maxEntry2, speed2 + 2 * accel * lengthMm);
  }
  return speed2;
}

/**
 * Speed² at the start of each move and at the end of the last one, from rest to rest, with a queue that is
 * always full.
 */
export function plannedSpeeds2(moves: readonly Move[], queueMoves: number): Float64Array {
  const speeds2 = new Float64Array(moves.length + 1);
  for (let i = 0; i < moves.length; i++) {
    const { accel, lengthMm } = moves[i];
    const limit2 = exitLimit2(moves, i, Math.min(moves.length, i + queueMoves));
    speeds2[i + 1] = Math.min(limit2, speeds2[i] + 2 * accel * lengthMm);
  }
  return speeds2;
}

/** Seconds for a straight move from rest to rest. */
export function moveTimeS(lengthMm: number, speed: number, accel: number): number {
  const peak = Math.min(speed, Math.sqrt(accel * lengthMm));
  return lengthMm === 0 ? 0 : peak / accel + lengthMm / peak;
}
