/**
 * A controlled stop in the middle of a trajectory: the carriage brakes along the same path with |a| ≤ A, then
 * the pen is lifted.
 *
 *   speed ^ ‾‾‾‾\            d(v²)/ds = −2 √(A² − (κ v²)²)      s: mm from where the stop begins
 *         |       \   plan   κ: curvature of the path, 1/mm      v never above the plan
 *         |  hold  \  ‾‾‾‾
 *         +---------+----> s
 *
 * The centripetal acceleration κ v² and the braking share the limit A (the friction circle of vehicle
 * dynamics). For constant κ, with u = κ v²/A, the solution is u(s) = sin(asin u₀ − 2 κ s): a carriage on a
 * circle at the highest possible speed stops within an eighth of the circle. For κ = 0 it is v² = v₀² − 2 A s.
 * The speed never exceeds the planned speed, so no corner is taken faster than planned.
 *
 * Every piece spans a few ms or half a degree of the plan, with v² linear in s. That is exact on straight
 * blocks; on curved ones the error is a fraction of a micrometre.
 */
import { BlockColumns } from "../block-columns.js";
import type { Kernel } from "../shaping/impulse-filter.js";
import { penMoveBefore, penMoveColumns } from "../pen/pen-moves.js";
import { liftMoveTime, liftTime, type TimedPen } from "../pen/pen-times.js";
import { fillAlong } from "./shaped-along.js";
import { shapeRest } from "./shaped-rest.js";
import {
  blockAt,
  blockLength,
  blockState,
  newMotionState,
  runEndS,
  runOfBlock,
  stateAt,
  type MotionState,
  type PlannedMotion,
  type Trajectory,
} from "../trajectory.js";

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
  pen: TimedPen | null,
): RestPlan {
  const state = stateAt(trajectory, tS);
  // A pen on its way down to a stroke lifts at once. It may have touched the paper already, so the carriage still
  // moves on to the stroke's start.
  const isLowering = !state.penUp && state.stroke < 0;
  const accel = isLowering ? NO_BRAKING : state.penUp ? limits.travelAccel : limits.drawAccel;
  // Drops planned for after the stop are not sent. A pen that was lifted only for a short travel goes to full height.
  const last = penMoveBefore(trajectory, tS);
  const needsLift = pen !== null && last !== null && (!last.up || last.heightPct < pen.upPct);
  const lift: RestLift | null = needsLift ? { pen, atOnce: isLowering } : null;
  if (trajectory.planned) return shapedRest(trajectory, trajectory.planned, tS, accel, lift);
  const pieces = new BlockColumns(0, false);
  const speed = Math.hypot(state.vx, state.vy);
  if (speed <= REST_SPEED) return finish(pieces, state, tS, -1, lift);
  const planS = slowDown(trajectory, tS, speed * speed, accel, pieces);
  const stroke = state.penUp ? -1 : state.stroke;
  return finish(pieces, stateAt(trajectory, planS), planS, stroke, lift);
}

/** How the pen lifts: at the end of the stop, or `atOnce`; then the carriage still waits for the lift at the end. */
interface RestLift {
  readonly pen: TimedPen;
  readonly atOnce: boolean;
}

/**
 * Brakes the planned motion; the shaper then turns it into the carriage's motion.
 *
 * @param lift null: the pen is up
 */
function shapedRest(
  trajectory: Trajectory,
  { trajectory: planned, kernel }: PlannedMotion,
  tS: number,
  accel: number,
  lift: RestLift | null,
): RestPlan {
  const run = runOfBlock(trajectory, Math.max(0, blockAt(trajectory, tS)));
  const endS = runEndS(trajectory, run);
  const state = stateAt(trajectory, tS);
  const pieces = new BlockColumns(0, false);
  if (trajectory.blockCount === 0 || tS >= endS) return finish(pieces, state, tS, -1, lift);
  const plannedEndS = runEndS(planned, run);
  const { vx, vy } = stateAt(planned, tS);
  const speed2 = vx * vx + vy * vy;
  let stopS = Math.min(tS, plannedEndS);
  if (speed2 > REST_SPEED * REST_SPEED) stopS = slowDown(planned, tS, speed2, accel, pieces);
  const end = stateAt(planned, stopS);
  const rest = shapeRest(planned, run, kernel, tS, state, pieces, end);
  // At the start of a run nothing moves yet.
  if (rest.shaped.count === 0) return finish(pieces, end, tS, -1, lift);
  const planS = stopS < plannedEndS - SHORTEST_PIECE_S ? stopS + kernel.meanDelayS : endS;
  return finish(rest.shaped, end, planS, state.stroke, lift, { rest: rest.planned, kernel });
}

/** Fills `pieces` and returns the plan time at which the carriage stops. `speed2`: v₀². */
function slowDown(
  trajectory: Trajectory,
  tS: number,
  speed2: number,
  accel: number,
  pieces: BlockColumns,
): number {
  const { runs, durationS, startS } = trajectory;
  let k = Math.max(0, blockAt(trajectory, tS));
  const end = runs.firstBlock[runOfBlock(trajectory, k) + 1];
  let v2 = speed2;
  let t = tS - startS[k];
  for (; k < end; k++, t = 0) {
    while (durationS[k] - t > 1e-9) {
      const next = pieceEnd(trajectory, k, t);
      const lengthMm = blockLength(trajectory, k, next) - blockLength(trajectory, k, t);
      const curvature = maxCurvature(trajectory, k, t, next);
      const from = blockState(trajectory, k, t, newMotionState());
      v2 = Math.min(v2, from.vx * from.vx + from.vy * from.vy);
      // After a change of settings the carriage may be faster on a curve than A allows: brake gradually from
      // there.
      const brake = new Brake(Math.max(SHARE_OF_ACCEL * accel, curvature * v2), curvature, v2);
      if (brake.stopMm <= lengthMm) {
        const until = timeAfter(trajectory, k, t, next, brake.stopMm);
        addPiece(from, blockState(trajectory, k, until, newMotionState()), brake.stopMm, v2, 0, pieces);
        return startS[k] + until;
      }
      const to = blockState(trajectory, k, next, newMotionState());
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

/** The end of a piece that starts at `t` in block `k`; within a piece the path turns by at most PIECE_TURN. */
function pieceEnd(trajectory: Trajectory, k: number, t: number): number {
  const from = blockState(trajectory, k, t, newMotionState());
  const leftS = trajectory.durationS[k] - t;
  let stepS = Math.min(PIECE_S, leftS);
  for (; stepS > SHORTEST_PIECE_S; stepS /= 2) {
    const to = blockState(trajectory, k, t + stepS, newMotionState());
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
    const { vx, vy, ax, ay } = blockState(trajectory, k, at, newMotionState());
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
  pieces: BlockColumns,
): void {
  const v0 = Math.sqrt(from2);
  const v1 = Math.sqrt(to2);
  if (!(v0 + v1 > 0) || !(lengthMm > 0)) return;
  const plan0 = Math.hypot(from.vx, from.vy);
  const duration = (2 * lengthMm) / (v0 + v1);
  const vx = plan0 > 0 ? (from.vx / plan0) * v0 : 0;
  const vy = plan0 > 0 ? (from.vy / plan0) * v0 : 0;
  // Computed from the end point, so that errors do not accumulate.
  const ax = (2 * (to.x - from.x - vx * duration)) / (duration * duration);
  const ay = (2 * (to.y - from.y - vy * duration)) / (duration * duration);
  pieces.push(duration, from.x, from.y, vx, vy, ax, ay, from.alongMm);
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

/** @param lift null: the pen is up */
function finish(
  pieces: BlockColumns,
  end: { readonly x: number; readonly y: number },
  planS: number,
  stroke: number,
  lift: RestLift | null,
  planned?: { readonly rest: BlockColumns; readonly kernel: Kernel },
): RestPlan {
  const heightPct = lift ? lift.pen.upPct : 0;
  const waitS = lift ? liftTime(lift.pen, heightPct) : 0;
  const moveS = lift ? liftMoveTime(lift.pen, heightPct - lift.pen.downPct) : 0;
  const runs = pieces.count > 0 ? 1 : 0;
  const atEnd = { beforeRun: runs, up: true, startS: pieces.clockS, waitS, moveS, heightPct };
  const lifts = lift?.atOnce && runs ? [{ ...atEnd, beforeRun: 0, startS: 0, waitS: 0 }, atEnd] : [atEnd];
  const oneRun = (blocks: BlockColumns): Trajectory => ({
    ...blocks.ofTrajectory(),
    runs: {
      count: runs,
      firstBlock: runs ? Uint32Array.of(0, blocks.count) : Uint32Array.of(0),
      stroke: runs ? Int32Array.of(stroke) : new Int32Array(0),
      startS: new Float64Array(runs),
    },
    penMoves: penMoveColumns(lift ? lifts : []),
    totalS: pieces.clockS + waitS,
    endX: end.x,
    endY: end.y,
  });
  const trajectory = oneRun(pieces);
  if (planned === undefined || runs === 0) return { trajectory, planS };
  const before = oneRun(planned.rest);
  fillAlong(trajectory, before, planned.kernel.meanDelayS);
  return { trajectory: { ...trajectory, planned: { trajectory: before, kernel: planned.kernel } }, planS };
}
