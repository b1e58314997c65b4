/**
 * A controlled stop in the middle of a trajectory: along the same path, with |a| ≤ A, then lift the pen.
 *
 *   speed ^ ‾‾‾‾\            d(v²)/ds = −2 √(A² − (κ v²)²)      s: mm from where the stop begins
 *         |       \   plan   κ: curvature of the path, 1/mm      v never above the plan
 *         |  hold  \  ‾‾‾‾
 *         +---------+----> s
 *
 * The centripetal acceleration κ v² and the braking share the limit A (the friction circle of vehicle
 * dynamics). While κ is constant, with u = κ v²/A the solution is u(s) = sin(asin u₀ − 2 κ s): a carriage
 * that goes round a circle at the highest possible speed stops within an eighth of it. For κ = 0 it is v² =
 * v₀² − 2 A s. Speed never exceeds the plan's, so no corner is taken faster than planned.
 *
 * Every piece spans a few ms or half a degree of the plan, with v² linear in s. That is exact on straight
 * blocks; on curved ones the error is a fraction of a micrometre.
 */
import { isPenUpBefore, penMoveColumns } from "./pen-moves.js";
import { liftTiming } from "./pen-times.js";
import type { PenSettings } from "../settings/pen.js";
import { blockLength, blockState, stateAt, type MotionState, type Trajectory } from "./trajectory.js";

export interface RestPlan {
  /** One run that ends at rest (none if the carriage is already at rest), then a lift if the pen is down. */
  readonly trajectory: Trajectory;
  /** The time in the original trajectory of the point where the carriage stops, s. */
  readonly planS: number;
}

/** Longest piece, s of plan time. */
const PIECE_S = 0.006;
/** Max turn within a piece, rad. The error against the friction circle grows with its square. */
const PIECE_TURN = 0.01;
/**
 * Share of A to use. The rest covers the difference between a piece of constant acceleration and the true
 * curve.
 */
const SHARE_OF_ACCEL = 0.995;
/** Shortest piece, s: a motor cannot follow anything shorter. */
const SHORTEST_PIECE_S = 2e-5;
/** An acceleration that leaves the motion as planned, mm/s². */
const NO_BRAKING = 1e-9;
/** Below this speed the carriage counts as at rest, mm/s. */
const REST_SPEED = 1e-6;
/** Below this curvature the path counts as straight, 1/mm. */
const STRAIGHT = 1e-9;

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
 * Plans a stop that begins at `tS`, whether or not the carriage is moving then.
 *
 * @param limits mm/s²
 * @param pen settings for the lift at the end; null leaves the pen where it is
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
  // A drop that the plan has for later than the stop is not given any more.
  const liftedBy = isPenUpBefore(trajectory, tS) ? null : pen;
  if (speed <= REST_SPEED) return finish(pieces, state, tS, -1, liftedBy);
  // A pen that comes down on the way to a stroke must not touch the paper before it: go on to the stroke's start.
  const isLowering = !state.penUp && state.stroke < 0;
  const accel = isLowering ? NO_BRAKING : state.penUp ? limits.travelAccel : limits.drawAccel;
  const planS = slowDown(trajectory, tS, speed * speed, accel, pieces);
  const end = stateAt(trajectory, planS);
  return finish(pieces, { ...end, penUp: state.penUp }, planS, state.penUp ? -1 : state.stroke, liftedBy);
}

/** Fills `pieces` and returns the plan time at which the carriage stops. `speed2`: v₀². */
function slowDown(trajectory: Trajectory, tS: number, speed2: number, accel: number, pieces: Pieces): number {
  const { runs, durationS, startS } = trajectory;
  let k = blockAt(trajectory, tS);
  const end = runs.firstBlock[runOf(trajectory, k) + 1];
  let v2 = speed2;
  let t = tS - startS[k];
  for (; k < end; k++, t = 0) {
    while (durationS[k] - t > 1e-9) {
      const next = pieceEnd(trajectory, k, t);
      const lengthMm = blockLength(trajectory, k, next) - blockLength(trajectory, k, t);
      const curvature = maxCurvature(trajectory, k, t, next);
      const from = blockState(trajectory, k, t, newState());
      v2 = Math.min(v2, from.vx * from.vx + from.vy * from.vy);
      // After a change of settings the carriage may be faster on a curve than A allows: brake gradually from
      // there.
      const brake = new Brake(Math.max(SHARE_OF_ACCEL * accel, curvature * v2), curvature, v2);
      if (brake.stopMm <= lengthMm) {
        const until = timeAfter(trajectory, k, t, next, brake.stopMm);
        addPiece(from, blockState(trajectory, k, until, newState()), brake.stopMm, v2, 0, pieces);
        return startS[k] + until;
      }
      const to = blockState(trajectory, k, next, newState());
      const end2 = Math.min(brake.speed2After(lengthMm), to.vx * to.vx + to.vy * to.vy);
      addPiece(from, to, lengthMm, v2, end2, pieces);
      if (end2 <= REST_SPEED * REST_SPEED) return startS[k] + next;
      v2 = end2;
      t = next;
    }
  }
  return startS[end - 1] + durationS[end - 1];
}

/** Braking along a circle of constant curvature, within the friction circle of `accel`. */
class Brake {
  private readonly angle: number;
  readonly stopMm: number;

  constructor(
    private readonly accel: number,
    private readonly curvature: number,
    private readonly speed2: number,
  ) {
    this.angle = Math.asin(Math.min(1, (curvature * speed2) / accel));
    this.stopMm = curvature > STRAIGHT ? this.angle / (2 * curvature) : speed2 / (2 * accel);
  }

  speed2After(mm: number): number {
    if (this.curvature <= STRAIGHT) return Math.max(0, this.speed2 - 2 * this.accel * mm);
    return (this.accel / this.curvature) * Math.sin(Math.max(0, this.angle - 2 * this.curvature * mm));
  }
}

/** The end of a piece that starts at `t` in block `k`, short enough that the path turns by little. */
function pieceEnd(trajectory: Trajectory, k: number, t: number): number {
  const from = blockState(trajectory, k, t, newState());
  const leftS = trajectory.durationS[k] - t;
  let stepS = Math.min(PIECE_S, leftS);
  for (; stepS > SHORTEST_PIECE_S; stepS /= 2) {
    const to = blockState(trajectory, k, t + stepS, newState());
    const turn = Math.atan2(from.vx * to.vy - from.vy * to.vx, from.vx * to.vx + from.vy * to.vy);
    if (Math.abs(turn) <= PIECE_TURN) break;
  }
  // Do not leave a remainder too short to be a piece.
  return leftS - stepS < SHORTEST_PIECE_S ? trajectory.durationS[k] : t + stepS;
}

/** The largest curvature of block `k` from `t` to `until`, 1/mm, sampled at three points. */
function maxCurvature(trajectory: Trajectory, k: number, t: number, until: number): number {
  let max = 0;
  for (const at of [t, (t + until) / 2, until]) {
    const { vx, vy, ax, ay } = blockState(trajectory, k, at, newState());
    const speed = Math.hypot(vx, vy);
    if (speed > REST_SPEED) max = Math.max(max, Math.abs(vx * ay - vy * ax) / speed ** 3);
  }
  return max;
}

/** One piece between two points of the plan; `from2`, `to2`: v² at its ends. */
function addPiece(
  from: MotionState,
  to: MotionState,
  lengthMm: number,
  from2: number,
  to2: number,
  pieces: Pieces,
): void {
  const v0 = Math.sqrt(from2);
  const v1 = Math.sqrt(to2);
  if (!(v0 + v1 > 0) || !(lengthMm > 0)) return;
  const plan0 = Math.hypot(from.vx, from.vy);
  const duration = (2 * lengthMm) / (v0 + v1);
  const vx = plan0 > 0 ? (from.vx / plan0) * v0 : 0;
  const vy = plan0 > 0 ? (from.vy / plan0) * v0 : 0;
  pieces.durationS.push(duration);
  pieces.x.push(from.x);
  pieces.y.push(from.y);
  pieces.vx.push(vx);
  pieces.vy.push(vy);
  // Computed from the end point, so that errors do not accumulate.
  pieces.ax.push((2 * (to.x - from.x - vx * duration)) / (duration * duration));
  pieces.ay.push((2 * (to.y - from.y - vy * duration)) / (duration * duration));
  pieces.alongMm.push(from.alongMm);
}

/** The time in block `k` when the pen has moved `mm` further than at `t`. */
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

/** @param pen lifts at the end; null: it is up */
function finish(
  pieces: Pieces,
  end: MotionState,
  planS: number,
  stroke: number,
  pen: PenSettings | null,
): RestPlan {
  const count = pieces.durationS.length;
  const startS = new Float64Array(count);
  for (let k = 1; k < count; k++) startS[k] = startS[k - 1] + pieces.durationS[k - 1];
  const motionS = count > 0 ? startS[count - 1] + pieces.durationS[count - 1] : 0;
  const runCount = count > 0 ? 1 : 0;
  const waitS = pen ? liftTiming(pen, pen.upPct).waitS : 0;
  const heightPct = pen?.upPct ?? 0;
  const lift = { beforeRun: runCount, up: true, startS: motionS, waitS, moveS: waitS, heightPct };
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
    penMoves: penMoveColumns(pen ? [lift] : []),
    totalS: motionS + waitS,
    endX: end.x,
    endY: end.y,
  };
  return { trajectory, planS };
}

/** The block that is running at `tS`. */
function blockAt(trajectory: Trajectory, tS: number): number {
  let low = 0;
  let high = trajectory.blockCount;
  while (high - low > 1) {
    const middle = (low + high) >> 1;
    if (trajectory.startS[middle] <= tS) low = middle;
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
    if (firstBlock[middle] <= block) low = middle;
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
