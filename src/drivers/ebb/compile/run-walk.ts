/**
 * A run of the trajectory in motor units: the plan's position and speed at any board tick.
 *
 *   board tick = plan seconds × 25 000 + origin
 *
 * `origin` is reset at each run's start, and increases whenever the plan had to be slowed down.
 */
import { motor1FromXy, motor2FromXy } from "../../../machines/motors.js";
import type { MachineProfile } from "../../../machines/profile.js";
import type { Trajectory } from "../../../plan/trajectory.js";
import { rateFromStepsPerS, S_PER_TICK, TICKS_PER_S } from "../../../units.js";
import type { MotorLeg } from "./leg.js";

export class RunWalk {
  /** Blocks [first, end). */
  first = 0;
  end = 0;
  origin = 0;

  constructor(
    private readonly trajectory: Trajectory,
    private readonly machine: MachineProfile,
  ) {}

  begin(run: number, boardTicks: number): void {
    const { runs } = this.trajectory;
    this.first = runs.firstBlock[run]!;
    this.end = runs.firstBlock[run + 1]!;
    this.origin = boardTicks - runs.startS[run] * TICKS_PER_S;
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

  /** Writes the position and speed at `tick`, evaluated in `block`, as the start of both motors' legs. */
  startLegs(tick: number, block: number, m1: MotorLeg, m2: MotorLeg): void {
    this.evaluate(this.planS(tick) - this.trajectory.startS[block], block);
    m1.p0 = this.p1;
    m2.p0 = this.p2;
    m1.v0 = this.v1;
    m2.v0 = this.v2;
  }

  /** The same for the end of both motors' legs. At the run's end, it uses the exact end of the block. */
  endLegs(tick: number, block: number, isRunEnd: boolean, m1: MotorLeg, m2: MotorLeg): void {
    const { startS, durationS } = this.trajectory;
    this.evaluate(isRunEnd ? durationS[block] : this.planS(tick) - startS[block], block);
    m1.p1 = this.p1;
    m2.p1 = this.p2;
    m1.v1 = this.v1;
    m2.v1 = this.v2;
  }

  hasJerk(block: number): boolean {
    const { jx, jy } = this.trajectory;
    return jx !== null && jy !== null && (jx[block] !== 0 || jy[block] !== 0);
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

  private p1 = 0;
  private p2 = 0;
  private v1 = 0;
  private v2 = 0;

  private evaluate(t: number, k: number): void {
    const { trajectory: b, machine } = this;
    const jx = b.jx === null ? 0 : b.jx[k];
    const jy = b.jy === null ? 0 : b.jy[k];
    const x = b.x[k] + t * (b.vx[k] + t * (b.ax[k] / 2 + (t * jx) / 6));
    const y = b.y[k] + t * (b.vy[k] + t * (b.ay[k] / 2 + (t * jy) / 6));
    const vx = b.vx[k] + t * (b.ax[k] + (t * jx) / 2);
    const vy = b.vy[k] + t * (b.ay[k] + (t * jy) / 2);
    this.p1 = motor1FromXy(machine, x, y);
    this.p2 = motor2FromXy(machine, x, y);
    this.v1 = rateFromStepsPerS(motor1FromXy(machine, vx, vy));
    this.v2 = rateFromStepsPerS(motor2FromXy(machine, vx, vy));
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
