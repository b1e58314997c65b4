/**
 * A controlled stop in the middle of a trajectory: along the very same path, at A, then the pen up.
 *
 *   speed ^ ‾‾‾‾\            v(s)² = min( plan's v(s)², v₀² − 2 A s )      s: mm from the point of the hold
 *         |       \   plan   The plan's own slowing before corners stays, so no corner is taken faster
 *         |  hold  \  ‾‾‾‾   than planned; on a curve the pull towards its middle only falls.
 *         +---------+----> s
 *
 * Every piece runs from a place of the plan to the next (block ends and every few ms between), with v² linear
 * in s, so on straight blocks it is exact and on curved ones within a fraction of a micrometre.
 */
import type { PenSettings } from "../plan/settings.js";
import { blockLength, blockState, stateAt, type MotionState, type Trajectory } from "../plan/trajectory.js";

export interface RestPlan {
  /** One run down to rest (none where the carriage rests already), then a lift if the pen is down. */
  readonly trajectory: Trajectory;
  /** Seconds of the stopped trajectory at the place of rest. */
  readonly planS: number;
}

/** Longest piece of the plan's time, s. */
const PIECE_S = 0.006;
/** Slower than this counts as rest, mm/s. */
const REST_SPEED = 1e-6;

interface Pieces {
  readonly durationS: number[];
  readonly x: number[];
  readonly y: number[];
  readonly vx: number[];
  readonly vy: number[];
  readonly ax: number[];
  readonly ay: number[];
  readonly alongMm: number[];
}

/**
 * Plans the stop of a trajectory from `tS` on, where it is in motion or not.
 *
 * @param limits mm/s²
 * @param pen how it lifts at the end; null leaves it where it is
 */
export function comeToRest(
  trajectory: Trajectory,
  tS: number,
  limits: { readonly drawAccel: number; readonly travelAccel: number },
  pen: PenSettings | null,
): RestPlan {
  const state = stateAt(trajectory, tS);
  const speed = Math.hypot(state.vx, state.vy);
  const pieces = emptyPieces();
  if (speed <= REST_SPEED) return finish(trajectory, pieces, state, tS, -1, pen);
  const accel = state.penUp ? limits.travelAccel : limits.drawAccel;
  const planS = slowDown(trajectory, tS, speed * speed, accel, pieces);
  const end = stateAt(trajectory, planS);
  return finish(
    trajectory,
    pieces,
    { ...end, penUp: state.penUp },
    planS,
    state.penUp ? -1 : state.stroke,
    pen,
  );
}

/** Fills `pieces` and returns the plan time of rest. `speed2`: v₀². */
function slowDown(trajectory: Trajectory, tS: number, speed2: number, accel: number, pieces: Pieces): number {
  const { runs, durationS, startS } = trajectory;
  let k = blockAt(trajectory, tS);
  const end = runs.firstBlock[runOf(trajectory, k) + 1]!;
  const stopMm = speed2 / (2 * accel);
  let doneMm = 0;
  let t = tS - startS[k]!;
  for (; k < end; k++, t = 0) {
    while (durationS[k]! - t > 1e-9) {
      const next = Math.min(durationS[k]!, t + PIECE_S);
      const lengthMm = blockLength(trajectory, k, next) - blockLength(trajectory, k, t);
      const isLast = doneMm + lengthMm >= stopMm;
      const until = isLast ? timeAfter(trajectory, k, t, next, stopMm - doneMm) : next;
      const pieceMm = isLast ? stopMm - doneMm : lengthMm;
      addPiece(
        trajectory,
        k,
        t,
        until,
        pieceMm,
        speed2 - 2 * accel * doneMm,
        speed2 - 2 * accel * (doneMm + pieceMm),
        pieces,
      );
      if (isLast) return startS[k]! + until;
      doneMm += lengthMm;
      t = next;
    }
  }
  return startS[end - 1]! + durationS[end - 1]!;
}

/** One piece from `t` to `until` in block `k`; `hold0`, `hold1`: v² that the stop allows at its ends. */
function addPiece(
  trajectory: Trajectory,
  k: number,
  t: number,
  until: number,
  lengthMm: number,
  hold0: number,
  hold1: number,
  pieces: Pieces,
): void {
  const from = blockState(trajectory, k, t, newState());
  const to = blockState(trajectory, k, until, newState());
  const plan0 = Math.hypot(from.vx, from.vy);
  const v0 = Math.sqrt(Math.max(0, Math.min(plan0 * plan0, hold0)));
  const v1 = Math.sqrt(Math.max(0, Math.min(to.vx * to.vx + to.vy * to.vy, hold1)));
  if (!(v0 + v1 > 0) || !(lengthMm > 0)) return;
  const duration = (2 * lengthMm) / (v0 + v1);
  const vx = plan0 > 0 ? (from.vx / plan0) * v0 : 0;
  const vy = plan0 > 0 ? (from.vy / plan0) * v0 : 0;
  pieces.durationS.push(duration);
  pieces.x.push(from.x);
  pieces.y.push(from.y);
  pieces.vx.push(vx);
  pieces.vy.push(vy);
  // Aimed at the place, so that no error runs up.
  pieces.ax.push((2 * (to.x - from.x - vx * duration)) / (duration * duration));
  pieces.ay.push((2 * (to.y - from.y - vy * duration)) / (duration * duration));
  pieces.alongMm.push(from.alongMm);
}

/** The time in block `k` after `t` at which `mm` more have been covered. */
function timeAfter(trajectory: Trajectory, k: number, t: number, end: number, mm: number): number {
  const before = blockLength(trajectory, k, t);
  let low = t;
  let high = end;
  for (let i = 0; i < 50; i++) {
    const middle = (low + high) / 2;
    if (blockLength(trajectory, k, middle) - before < mm) low = middle;
    else high = middle;
  }
  return high;
}

function finish(
  original: Trajectory,
  pieces: Pieces,
  end: MotionState,
  planS: number,
  stroke: number,
  pen: PenSettings | null,
): RestPlan {
  const count = pieces.durationS.length;
  const startS = new Float64Array(count);
  for (let k = 1; k < count; k++) startS[k] = startS[k - 1]! + pieces.durationS[k - 1]!;
  const motionS = count > 0 ? startS[count - 1]! + pieces.durationS[count - 1]! : 0;
  const runCount = count > 0 ? 1 : 0;
  const lifts = pen !== null && !penUpAt(original, planS);
  const waitS = lifts ? pen.liftMs / 1000 : 0;
  const lift = { beforeRun: runCount, up: true, startS: motionS, waitS, heightPct: pen?.upPct ?? 0 };
  const trajectory: Trajectory = {
    blockCount: count,
    durationS: Float64Array.from(pieces.durationS),
    x: Float64Array.from(pieces.x),
    y: Float64Array.from(pieces.y),
    vx: Float64Array.from(pieces.vx),
    vy: Float64Array.from(pieces.vy),
    ax: Float64Array.from(pieces.ax),
    ay: Float64Array.from(pieces.ay),
    jx: null,
    jy: null,
    startS,
    alongMm: Float64Array.from(pieces.alongMm),
    runs: {
      count: runCount,
      firstBlock: runCount ? Uint32Array.of(0, count) : Uint32Array.of(0),
      stroke: runCount ? Int32Array.of(stroke) : new Int32Array(0),
      startS: new Float64Array(runCount),
    },
    penMoves: lifts ? [lift] : [],
    totalS: motionS + waitS,
    endX: end.x,
    endY: end.y,
  };
  return { trajectory, planS };
}

function penUpAt(trajectory: Trajectory, tS: number): boolean {
  let up = true;
  for (const move of trajectory.penMoves) {
    if (move.startS >= tS - 1e-7) break;
    up = move.up;
  }
  return up;
}

/** The block under way at `tS`. */
function blockAt(trajectory: Trajectory, tS: number): number {
  let low = 0;
  let high = trajectory.blockCount;
  while (high - low > 1) {
    const middle = (low + high) >> 1;
    if (trajectory.startS[middle]! <= tS) low = middle;
    else high = middle;
  }
  return low;
}

function runOf(trajectory: Trajectory, block: number): number {
  const { firstBlock, count } = trajectory.runs;
  let low = 0;
  let high = count;
  while (high - low > 1) {
    const middle = (low + high) >> 1;
    if (firstBlock[middle]! <= block) low = middle;
    else high = middle;
  }
  return low;
}

const emptyPieces = (): Pieces => ({
  durationS: [],
  x: [],
  y: [],
  vx: [],
  vy: [],
  ax: [],
  ay: [],
  alongMm: [],
});

const newState = (): MotionState => ({
  x: 0,
  y: 0,
  vx: 0,
  vy: 0,
  ax: 0,
  ay: 0,
  penUp: true,
  stroke: -1,
  alongMm: 0,
});
