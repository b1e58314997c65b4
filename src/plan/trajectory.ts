import { firstWhere } from "../geometry/binary-search.js";
import type { Kernel } from "./shaping/impulse-filter.js";

/**
 * The pen's motion over time: constant-acceleration (or constant-jerk) blocks in columns.
 *
 *     t from a block's start:  p(t) = p0 + v0 t + a t²/2 + j t³/6
 *
 * Blocks are grouped in runs. A run begins and ends at rest, with the pen up (travel) or down (draw). Between
 * two runs the pen may move, and the carriage waits for it:
 *
 *     run 0 travel | drop | run 1 draw | lift | run 2 travel | drop | run 3 draw | lift | run 4 travel home
 *
 * With the setting `pen.overlap`, a lift continues during the travel after it, and a drop begins in the travel before it.
 */
export interface Trajectory {
  /** Number of blocks. */
  readonly blockCount: number;
  /** Seconds each block takes. All columns have `blockCount` used entries (arrays may be longer). */
  readonly durationS: Float64Array;
  /** Start position, mm in the machine frame. */
  readonly x: Float64Array;
  readonly y: Float64Array;
  /** Start velocity, mm/s. */
  readonly vx: Float64Array;
  readonly vy: Float64Array;
  /** Acceleration at the start, mm/s². */
  readonly ax: Float64Array;
  readonly ay: Float64Array;
  /** Jerk, mm/s³; null where it is zero everywhere. */
  readonly jx: Float64Array | null;
  readonly jy: Float64Array | null;
  /** Seconds from the trajectory's start to each block's start, pen waits included. */
  readonly startS: Float64Array;
  /** mm along the run's source polyline at the block's start. */
  readonly alongMm: Float64Array;
  /** Which blocks belong to which stroke. */
  readonly runs: RunColumns;
  /** In order of time. */
  readonly penMoves: PenMoveColumns;
  /** Total duration, pen waits included. */
  readonly totalS: number;
  /** End position, mm. */
  readonly endX: number;
  readonly endY: number;
  /**
   * For a shaped trajectory: the motion before shaping. It has the same runs, whose blocks begin at the same time or
   * slightly earlier. If shaping cancels all swing, the pen is where this motion was one mean delay earlier.
   */
  readonly planned?: PlannedMotion | null | undefined;
}

/** A motion before shaping, and the filter that shaped it. */
export interface PlannedMotion {
  readonly trajectory: Trajectory;
  readonly kernel: Kernel;
}

/** The runs of a trajectory, as columns. */
export interface RunColumns {
  readonly count: number;
  /** count + 1: run r has blocks [firstBlock[r], firstBlock[r+1]). */
  readonly firstBlock: Uint32Array;
  /** Stroke index in the planned StrokeSet; −1 for travel. */
  readonly stroke: Int32Array;
  /** Seconds from the trajectory's start to the run's first motion. */
  readonly startS: Float64Array;
}

/** Pen moves as columns, each with `count` used entries (arrays may be longer). */
export interface PenMoveColumns {
  readonly count: number;
  readonly beforeRun: Uint32Array;
  /** 1: up, 0: down. */
  readonly up: Uint8Array;
  readonly startS: Float64Array;
  readonly waitS: Float64Array;
  readonly moveS: Float64Array;
  readonly heightPct: Float64Array;
}

/** A lift or drop before run `beforeRun` (= runs.count: after the last one). */
export interface PenMove {
  readonly beforeRun: number;
  readonly up: boolean;
  /** Seconds from the trajectory's start. If run `beforeRun` − 1 ends later, the move begins while the carriage moves. */
  readonly startS: number;
  /** How long the carriage waits for it, at rest before run `beforeRun`. */
  readonly waitS: number;
  /** Time that the pen needs between the down height and the up height of this move, s. */
  readonly moveS: number;
  /** Target height, percent of the servo's range. */
  readonly heightPct: number;
}

/** A place in the drawing from which a plan can resume: a stroke, and mm along its polyline. */
export interface StrokePosition {
  /** Index of the stroke. */
  readonly stroke: number;
  /** mm along the stroke's polyline. */
  readonly alongMm: number;
}

/** Rounding difference between a command's plan time and the trajectory's. */
export const SAME_TIME_S = 1e-7;

/** One instant of a trajectory: mm in the machine frame, mm/s, mm/s². */
export interface MotionState {
  x: number;
  y: number;
  vx: number;
  vy: number;
  ax: number;
  ay: number;
  /** True from the start of a lift until the start of a drop. */
  penUp: boolean;
  /** The pen is still on its way up or down: it may or may not touch the paper. */
  penMoving: boolean;
  /** −1 while travelling or waiting for the pen. */
  stroke: number;
  alongMm: number;
}

export function newMotionState(): MotionState {
  return { x: 0, y: 0, vx: 0, vy: 0, ax: 0, ay: 0, penUp: true, penMoving: false, stroke: -1, alongMm: 0 };
}

/**
 * The state at `tS` seconds from the start, in O(log blocks). Before the start and after the end, the carriage is at
 * rest there. While it waits for the pen, it is where the last run ended, with `stroke` −1. Pass `out` to fill an
 * existing object.
 *
 * @throws RangeError if `tS` is NaN
 */
export function stateAt(
  trajectory: Trajectory,
  tS: number,
  out: MotionState = newMotionState(),
): MotionState {
  if (Number.isNaN(tS)) throw new RangeError("stateAt: the time is NaN, it must be seconds");
  const { penMoves, runs } = trajectory;
  const move = lastNotAfter(tS, penMoves.count, (i) => penMoves.startS[i]);
  out.penUp = move < 0 || penMoves.up[move] === 1;
  out.penMoving = move >= 0 && tS < penRestS(trajectory, move);
  const k = blockAt(trajectory, tS);
  if (k < 0) return rest(out, startOf(trajectory));
  const t = tS - trajectory.startS[k];
  const run = runOfBlock(trajectory, k);
  blockState(trajectory, k, Math.min(t, trajectory.durationS[k]), out);
  if (trajectory.planned) out.alongMm = plannedAlong(trajectory.planned, run, tS);
  // The end of a block belongs to that block, unless another block or a wait follows immediately.
  if (t >= trajectory.durationS[k] && (tS >= trajectory.totalS || endsRun(trajectory, k))) {
    return rest(out, k + 1 === trajectory.blockCount ? endOf(trajectory) : [out.x, out.y]);
  }
  out.stroke = runs.stroke[run];
  return out;
}

/** When a pen move ends: a lift after its duration, a drop when the next run begins, because that run waits for it. */
function penRestS({ penMoves, runs }: Trajectory, move: number): number {
  const { up, startS, moveS, waitS, beforeRun } = penMoves;
  if (up[move] === 1) return startS[move] + moveS[move];
  return beforeRun[move] < runs.count ? runs.startS[beforeRun[move]] : startS[move] + waitS[move];
}

/** mm along the stroke at `tS`, during a run: where the planned motion was one mean delay earlier. */
function plannedAlong({ trajectory, kernel }: PlannedMotion, run: number, tS: number): number {
  const plannedS = tS - kernel.meanDelayS;
  const { firstBlock } = trajectory.runs;
  const [first, end] = [firstBlock[run], firstBlock[run + 1]];
  const k = Math.max(first, first + lastNotAfter(plannedS, end - first, (i) => trajectory.startS[first + i]));
  return blockAlong(trajectory, k, Math.min(trajectory.durationS[k], plannedS - trajectory.startS[k]));
}

/**
 * The state of the pen on the drawn line. `stateAt` gives the carriage's: with shaping, the carriage leaves the line to
 * keep the pen on it.
 */
export function drawnAt(trajectory: Trajectory, tS: number): MotionState {
  const state = stateAt(trajectory, tS);
  if (!trajectory.planned || state.stroke < 0) return state;
  const { planned } = trajectory;
  const { x, y, vx, vy } = stateAt(planned.trajectory, tS - planned.kernel.meanDelayS);
  return { ...state, x, y, vx, vy };
}

/** Position, velocity and acceleration `t` seconds into block `k`; 0 ≤ t ≤ its duration. */
export function blockState(trajectory: Trajectory, k: number, t: number, out: MotionState): MotionState {
  const jx = trajectory.jx ? trajectory.jx[k] : 0;
  const jy = trajectory.jy ? trajectory.jy[k] : 0;
  const ax = trajectory.ax[k];
  const ay = trajectory.ay[k];
  const vx = trajectory.vx[k];
  const vy = trajectory.vy[k];
  out.x = trajectory.x[k] + t * (vx + t * (ax / 2 + (t * jx) / 6));
  out.y = trajectory.y[k] + t * (vy + t * (ay / 2 + (t * jy) / 6));
  out.vx = vx + t * (ax + (t * jx) / 2);
  out.vy = vy + t * (ay + (t * jy) / 2);
  out.ax = ax + t * jx;
  out.ay = ay + t * jy;
  out.alongMm = blockAlong(trajectory, k, t);
  return out;
}

/** mm along the source polyline, interpolated by the length of the block covered so far. */
function blockAlong(trajectory: Trajectory, k: number, t: number): number {
  const along = trajectory.alongMm[k];
  const duration = trajectory.durationS[k];
  if (!(t > 0)) return along;
  const wholeMm = blockLength(trajectory, k, duration);
  // No block says where the last one of a run ends along the polyline: it counts with its own length.
  const span = endsRun(trajectory, k) ? wholeMm : trajectory.alongMm[k + 1] - along;
  return wholeMm > 0 ? along + span * Math.min(1, blockLength(trajectory, k, t) / wholeMm) : along;
}

/**
 * Length in mm of the first `t` seconds of block `k`: exact for straight blocks, otherwise by Gauss
 * quadrature, split where the path reverses (|v| has a kink there).
 */
export function blockLength(
  trajectory: Pick<Trajectory, "vx" | "vy" | "ax" | "ay" | "jx" | "jy">,
  k: number,
  t: number,
): number {
  const vx = trajectory.vx[k];
  const vy = trajectory.vy[k];
  const ax = trajectory.ax[k];
  const ay = trajectory.ay[k];
  const jx = trajectory.jx ? trajectory.jx[k] : 0;
  const jy = trajectory.jy ? trajectory.jy[k] : 0;
  // v(u) · d = c + b u + q u², with d the initial direction (from rest: the acceleration). At its roots the
  // velocity is perpendicular to d.
  const c = vx * vx + vy * vy;
  const dx = c > 0 ? vx : ax;
  const dy = c > 0 ? vy : ay;
  const b = dx * ax + dy * ay;
  const q = (dx * jx + dy * jy) / 2;
  const root = Math.sqrt(b * b - 4 * q * c);
  let first = t;
  let second = t;
  if (b < 0) first = (2 * c) / (root - b);
  else if (q < 0) first = (-b - root) / (2 * q);
  if (b < 0 && q > 0) second = Math.min((root - b) / (2 * q), t);
  if (!(first > 0 && first < t)) first = second = t;
  let sum = lengthBetween(0, first, vx, vy, ax, ay, jx, jy);
  if (first < second) sum += lengthBetween(first, second, vx, vy, ax, ay, jx, jy);
  if (second < t) sum += lengthBetween(second, t, vx, vy, ax, ay, jx, jy);
  return sum;
}

/** Length of a path that does not reverse between the two instants. */
function lengthBetween(
  from: number,
  to: number,
  vx: number,
  vy: number,
  ax: number,
  ay: number,
  jx: number,
  jy: number,
): number {
  let sum = 0;
  for (let i = 0; i < GAUSS_NODES.length; i++) {
    const u = from + (to - from) * GAUSS_NODES[i];
    const wx = vx + u * (ax + (u * jx) / 2);
    const wy = vy + u * (ay + (u * jy) / 2);
    sum += GAUSS_WEIGHTS[i] * Math.sqrt(wx * wx + wy * wy);
  }
  return sum * (to - from);
}

// Three-point Gauss–Legendre on [0, 1]: exact up to degree five, so for every straight block.
const GAUSS_NODES = [0.5 - Math.sqrt(0.15), 0.5, 0.5 + Math.sqrt(0.15)];
const GAUSS_WEIGHTS = [5 / 18, 8 / 18, 5 / 18];

/** True if block `k` is the last of its run. */
function endsRun(trajectory: Trajectory, k: number): boolean {
  return trajectory.runs.firstBlock[runOfBlock(trajectory, k) + 1] === k + 1;
}

/** The last block that begins at or before `tS`; −1 before the first. */
export const blockAt = ({ startS, blockCount }: Trajectory, tS: number): number =>
  lastNotAfter(tS, blockCount, (k) => startS[k]);

/** The run that block `k` belongs to. */
export const runOfBlock = ({ runs }: Trajectory, k: number): number =>
  lastNotAfter(k, runs.count, (run) => runs.firstBlock[run]);

/** When a run's motion ends, s; for a dot, which has no blocks, when it begins. */
export function runEndS({ runs, startS, durationS }: Trajectory, run: number): number {
  const end = runs.firstBlock[run + 1];
  return end > runs.firstBlock[run] ? startS[end - 1] + durationS[end - 1] : runs.startS[run];
}

function rest(out: MotionState, [x, y]: readonly [number, number]): MotionState {
  out.x = x;
  out.y = y;
  out.vx = out.vy = out.ax = out.ay = 0;
  out.stroke = -1;
  return out;
}

function startOf(trajectory: Trajectory): readonly [number, number] {
  return trajectory.blockCount > 0 ? [trajectory.x[0], trajectory.y[0]] : endOf(trajectory);
}

const endOf = (trajectory: Trajectory): readonly [number, number] => [trajectory.endX, trajectory.endY];

/** Index of the last of `count` ascending values that is ≤ `value`; −1 if none is. */
const lastNotAfter = (value: number, count: number, at: (index: number) => number): number =>
  firstWhere(0, count, (i) => at(i) > value) - 1;
