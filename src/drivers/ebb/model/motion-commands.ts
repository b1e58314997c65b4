/**
 * Parses the parameters of SM, XM, LM, L3, LT, T3, TD and HM into entries of the motion queue, as each firmware does.
 */
import type { FirmwareFeatures } from "../protocol/firmware.js";
import { ACCUMULATOR_RANGE, rateFromStepsPerS, TICKS_PER_MS, TICKS_PER_S } from "../../../units.js";
import type { AxisOrder, MoveOrder, Order } from "./orders.js";
import { BoardFault, invalidValue, type Parameters } from "./parameters.js";
import { slowRate } from "./slow-rate.js";

const INT31 = 2 ** 31 - 1;

export class MotionCommands {
  constructor(
    private readonly features: FirmwareFeatures,
    /** CU,251: the last parameter is the initial value of the accumulators. */
    private readonly isTestMode: () => boolean,
  ) {}

  slow(p: Parameters, mixed: boolean): readonly Order[] {
    const ms = p.uint(2 ** 24 - 1);
    const a = p.int();
    const b = mixed || p.hasMore ? p.int() : 0;
    const clear = this.clearBits(p, 3);
    if (ms === 0) throw invalidValue();
    const [steps1, steps2] = mixed ? [a + b, a - b] : [a, b];
    if (steps1 === 0 && steps2 === 0) return [this.delay(ms)];
    const axis1 = this.constantAxis(ms, steps1);
    const axis2 = this.constantAxis(ms, steps2);
    return [{ kind: "move", axis1, axis2, ticks: Infinity, clear }];
  }

  private delay(ms: number): Order {
    const longestMs = this.features.arithmetic === "signed" ? 100_000 : 16_777_215;
    return { kind: "delay", ticks: Math.min(ms, longestMs) * TICKS_PER_MS };
  }

  private constantAxis(ms: number, steps: number): AxisOrder {
    if (steps === 0) return { rate: 0, accel: 0, jerk: 0, steps: 0 };
    const { arithmetic } = this.features;
    const rate = slowRate(arithmetic, ms, Math.abs(steps));
    const isTooFast = rate > ACCUMULATOR_RANGE || (arithmetic !== "signed" && rate === ACCUMULATOR_RANGE);
    if (rate < 1 || isTooFast) throw new BoardFault(0, "Err: <axis1> step rate too high");
    return { rate: Math.sign(steps) * rate, accel: 0, jerk: 0, steps: Math.abs(steps) };
  }

  stepped(p: Parameters, hasJerk: boolean): readonly Order[] {
    const axis1 = this.steppedAxis(p, hasJerk);
    const axis2 = this.steppedAxis(p, hasJerk);
    const order = this.move(p, axis1, axis2, Infinity);
    const isDead = ({ steps, rate, accel }: AxisOrder, jerk: number): boolean =>
      steps === 0 || (rate === 0 && accel === 0 && jerk === 0);
    const jerk2 = this.features.l3NegatesJerk ? axis2.jerk : axis1.jerk;
    if (isDead(axis1, axis1.jerk) && isDead(axis2, jerk2)) throw invalidValue();
    return [order];
  }

  /** Negative steps negate rate and acceleration, but the jerk only from 3.1 on. */
  private steppedAxis(p: Parameters, hasJerk: boolean): AxisOrder {
    const isSigned = this.features.arithmetic === "signed";
    const rate = isSigned ? p.int() : p.uint(INT31);
    const steps = p.int();
    const accel = p.int();
    const jerk = hasJerk ? p.int() : 0;
    // −0 keeps the direction.
    if (!isSigned) return { rate: steps < 0 ? -rate : rate, accel, jerk: 0, steps: Math.abs(steps) };
    if (steps >= 0) return { rate, accel, jerk, steps };
    if (rate < 0) throw invalidValue();
    const ownJerk = this.features.l3NegatesJerk ? 0 - jerk : jerk;
    return { rate: 0 - rate, accel: 0 - accel, jerk: ownJerk, steps: -steps };
  }

  timed(p: Parameters, hasJerk: boolean): readonly Order[] {
    const ticks = p.uint();
    const axis1 = timedAxis(p, hasJerk);
    const axis2 = timedAxis(p, hasJerk);
    const isDead = this.features.arithmetic !== "signed" && axis1.rate === 0 && axis2.rate === 0;
    if (ticks === 0 || isDead) throw invalidValue();
    return [this.move(p, axis1, axis2, ticks)];
  }

  /** An S-shaped speed profile in two halves: positive jerk, then negative. */
  timedDouble(p: Parameters): readonly Order[] {
    const ticks = p.uint();
    if (ticks === 0) throw invalidValue();
    const axis = (): [AxisOrder, AxisOrder] => {
      const rateA = p.int();
      const rateB = p.int();
      const accel = p.int();
      const jerk = p.int();
      return [
        { rate: rateA, accel: 0, jerk, steps: Infinity },
        { rate: rateB, accel, jerk: -jerk, steps: Infinity },
      ];
    };
    const [first1, second1] = axis();
    const [first2, second2] = axis();
    const first = this.move(p, first1, first2, ticks);
    return [first, { kind: "move", axis1: second1, axis2: second2, ticks, clear: 0 }];
  }

  private move(p: Parameters, axis1: AxisOrder, axis2: AxisOrder, ticks: number): MoveOrder {
    const move = { kind: "move" as const, axis1, axis2, ticks };
    if (!this.isTestMode()) return { ...move, clear: this.clearBits(p, 2 ** 32 - 1) };
    return p.hasMore ? { ...move, clear: 0, startAcc: p.uint(INT31) } : { ...move, clear: 3 };
  }

  private clearBits(p: Parameters, max: number): number {
    if (!this.features.hasClear || !p.hasMore) return 0;
    return Math.min(3, p.uint(max));
  }

  /** HM: the target is known when it is parsed, the start only when the motors have stopped. */
  home(p: Parameters): (steps1: number, steps2: number) => readonly Order[] {
    const takesTarget = this.features.motion === "timed" || this.features.motion === "jerk";
    const fastest = Math.min(TICKS_PER_S, Math.max(1, p.uint()));
    const target1 = p.hasMore && takesTarget ? p.int() : 0;
    const target2 = p.hasMore && takesTarget ? p.int() : 0;
    return (steps1, steps2) => {
      const distance1 = target1 - steps1;
      const distance2 = target2 - steps2;
      const longest = Math.max(Math.abs(distance1), Math.abs(distance2));
      if (longest === 0) return [];
      const axis = (distance: number): AxisOrder => {
        const stepsPerS = (fastest * Math.abs(distance)) / longest;
        const rate = Math.max(1, Math.min(INT31, Math.floor(rateFromStepsPerS(stepsPerS))));
        return { rate: Math.sign(distance) * rate, accel: 0, jerk: 0, steps: Math.abs(distance) };
      };
      return [{ kind: "move", axis1: axis(distance1), axis2: axis(distance2), ticks: Infinity, clear: 0 }];
    };
  }
}

function timedAxis(p: Parameters, hasJerk: boolean): AxisOrder {
  const rate = p.int();
  const accel = p.int();
  return { rate, accel, jerk: hasJerk ? p.int() : 0, steps: Infinity };
}
