/**
 * A run of the trajectory in motor units: the plan's position and speed at any board tick.
 *
 *   board tick = plan seconds × 25 000 + origin
 *
 * `origin` is reset at the start of each run (or of the part of it that is written), and increases whenever the plan has to be slowed down.
 */
import { motor1FromXy, motor2FromXy } from "../../../machines/motors.js";
import type { MachineProfile } from "../../../machines/profile.js";
import { blockState, newMotionState, type Trajectory } from "../../../plan/trajectory.js";
import { rateFromStepsPerS, S_PER_TICK, TICKS_PER_S } from "../../../units.js";

/** The plan at one moment: position of one motor in steps (fractional), speed in accumulator counts per tick. */
export interface MotorPoint {
  readonly p: number;
  readonly v: number;
}

interface PlanPoint {
  readonly m1: MotorPoint;
  readonly m2: MotorPoint;
}

export class RunWalk {
  /** Blocks [first, end). */
  first = 0;
  end = 0;
  origin = 0;
  private readonly state = newMotionState();

  constructor(
    private readonly trajectory: Trajectory,
    private readonly machine: MachineProfile,
  ) {}

  begin(run: number, boardTicks: number, fromS = 0): void {
    const { runs } = this.trajectory;
    const beginS = Math.max(fromS, runs.startS[run]);
    this.end = runs.firstBlock[run + 1];
    this.origin = boardTicks - beginS * TICKS_PER_S;
    this.first = runs.firstBlock[run];
    if (beginS > runs.startS[run]) this.first = this.blockAt(boardTicks, this.first);
  }

  tickOf(planS: number): number {
    return Math.round(this.origin + planS * TICKS_PER_S);
  }

  planS(tick: number): number {
    return (tick - this.origin) * S_PER_TICK;
  }

  /** The tick nearest to a block's end. */
  endTick(block: number): number {
    const { startS, durationS } = this.trajectory;
    return Math.round(this.origin + (startS[block] + durationS[block]) * TICKS_PER_S);
  }

  /** The block that contains `tick`, searched from `block` on. */
  blockAt(tick: number, block: number): number {
    let k = block;
    while (k + 1 < this.end && this.endTick(k) <= tick) k++;
    return k;
  }

  /** The block that ends at `tick` or contains it, searched from `block` on. */
  blockTo(tick: number, block: number): number {
    let k = block;
    while (k + 1 < this.end && this.endTick(k) < tick) k++;
    return k;
  }

  /** The plan at `tick`, evaluated in `block`. */
  pointAt(tick: number, block: number): PlanPoint {
    return this.evaluate(this.planS(tick) - this.trajectory.startS[block], block);
  }

  /** The plan at the exact end of a block. */
  endOf(block: number): PlanPoint {
    return this.evaluate(this.trajectory.durationS[block], block);
  }

  /** Jerk of the motor with the larger jerk, counts per tick³. */
  jerk(block: number): number {
    const { jx, jy } = this.trajectory;
    const x = jx?.[block] ?? 0;
    const y = jy?.[block] ?? 0;
    const j1 = Math.abs(motor1FromXy(this.machine, x, y));
    const j2 = Math.abs(motor2FromXy(this.machine, x, y));
    return rateFromStepsPerS(Math.max(j1, j2)) * S_PER_TICK * S_PER_TICK;
  }

  /** First tick in (from, to] at which a motor's speed in the block crosses zero; Infinity if none does. */
  turnTick(block: number, from: number, to: number): number {
    const { startS, vx, vy, ax, ay, jx, jy } = this.trajectory;
    const { machine } = this;
    const startTick = this.origin + startS[block] * TICKS_PER_S;
    let earliest = Infinity;
    for (const motor of [motor1FromXy, motor2FromXy]) {
      const v = motor(machine, vx[block], vy[block]);
      const a = motor(machine, ax[block], ay[block]);
      const j = motor(machine, jx?.[block] ?? 0, jy?.[block] ?? 0);
      for (const root of rootsOfSpeed(v, a, j)) {
        const tick = Math.round(startTick + root * TICKS_PER_S);
        if (tick > from && tick <= to && tick < earliest) earliest = tick;
      }
    }
    return earliest;
  }

  /** The plan `t` seconds after the start of block `k`. */
  private evaluate(t: number, k: number): PlanPoint {
    const { machine } = this;
    const { x, y, vx, vy } = blockState(this.trajectory, k, t, this.state);
    return {
      m1: { p: motor1FromXy(machine, x, y), v: rateFromStepsPerS(motor1FromXy(machine, vx, vy)) },
      m2: { p: motor2FromXy(machine, x, y), v: rateFromStepsPerS(motor2FromXy(machine, vx, vy)) },
    };
  }
}

/** Times at which v + a t + j t²/2 crosses zero; touching zero does not count. */
function rootsOfSpeed(v: number, a: number, j: number): number[] {
  if (j === 0) return a === 0 ? [] : [-v / a];
  const discriminant = a * a - 2 * j * v;
  if (discriminant <= 0) return [];
  const root = Math.sqrt(discriminant);
  // Numerically stable: one root from the sum without cancellation, the other from the product of the roots.
  const q = -(a + (a < 0 ? -root : root));
  return q === 0 ? [0] : [q / j, (2 * v) / q];
}
