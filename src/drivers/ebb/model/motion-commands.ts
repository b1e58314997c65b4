/**
 * Parses the parameters of SM, XM, LM, L3, LT, T3, TD and HM into entries of the motion queue, as each firmware does.
 */
import type { FirmwareFeatures } from "../protocol/firmware.js";
import { rateFromStepsPerS, TICKS_PER_S } from "../../../units.js";
import { stepperMove, steppedAxis, type AxisOrder, type MoveOrder, type Order } from "./orders.js";
import { BoardFault, type Parameters } from "./parameters.js";

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
    if (ms === 0) throw new BoardFault(6, "Err: Invalid parameter value");
    const order = stepperMove(this.features, ms, mixed ? a + b : a, mixed ? a - b : b, clear);
    if (order === null) throw new BoardFault(0, "Err: <axis1> step rate too high");
    return [order];
  }

  stepped(p: Parameters, hasJerk: boolean): readonly Order[] {
    const axis1 = this.steppedArguments(p, hasJerk);
    const axis2 = this.steppedArguments(p, hasJerk);
    const dead = (axis: AxisOrder): boolean =>
      axis.steps === 0 || (axis.rate === 0 && axis.accel === 0 && axis.jerk === 0);
    const isDead = dead(axis1) && dead(axis2);
    const order = this.move(p, false, axis1, axis2, Infinity);
    if (isDead) throw new BoardFault(6, "Err: Invalid parameter value");
    return [order];
  }

  private steppedArguments(p: Parameters, hasJerk: boolean): AxisOrder {
    const signed = this.features.arithmetic === "signed";
    const rate = signed ? p.int() : p.uint(INT31);
    const steps = p.int();
    const accel = p.int();
    const jerk = hasJerk ? p.int() : 0;
    const axis = steppedAxis(this.features.arithmetic, rate, steps, accel, jerk);
    if (axis === null) throw new BoardFault(6, "Err: Invalid parameter value");
    return axis;
  }

  timed(p: Parameters, hasJerk: boolean): readonly Order[] {
    const ticks = p.uint();
    const axis1 = timedArguments(p, hasJerk);
    const axis2 = timedArguments(p, hasJerk);
    if (ticks === 0) throw new BoardFault(6, "Err: Invalid parameter value");
    if (this.features.arithmetic !== "signed" && axis1.rate === 0 && axis2.rate === 0) {
      throw new BoardFault(6, "Err: Invalid parameter value");
    }
    return [this.move(p, true, axis1, axis2, ticks)];
  }

  /** An S-shaped speed profile in two halves: positive jerk, then negative. */
  timedDouble(p: Parameters): readonly Order[] {
    const ticks = p.uint();
    if (ticks === 0) throw new BoardFault(6, "Err: Invalid parameter value");
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
    const first = this.move(p, true, first1, first2, ticks);
    return [first, { ...first, axis1: second1, axis2: second2, clear: 0, startAcc: null }];
  }

  private move(
    p: Parameters,
    isTimed: boolean,
    axis1: AxisOrder,
    axis2: AxisOrder,
    ticks: number,
  ): MoveOrder {
    const { features } = this;
    const idleTicks = isTimed ? features.idleTicksTimed : features.idleTicks;
    const base = { kind: "move" as const, isTimed, axis1, axis2, ticks, idleTicks };
    if (this.isTestMode()) {
      return p.hasMore
        ? { ...base, clear: 0, startAcc: p.uint(INT31) }
        : { ...base, clear: 3, startAcc: null };
    }
    return { ...base, clear: this.clearBits(p, 2 ** 32 - 1), startAcc: null };
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
        const rate = Math.min(INT31, Math.floor(rateFromStepsPerS(stepsPerS)));
        return {
          rate: Math.sign(distance) * Math.max(distance === 0 ? 0 : 1, rate),
          accel: 0,
          jerk: 0,
          steps: Math.abs(distance),
        };
      };
      const order: MoveOrder = {
        kind: "move",
        isTimed: false,
        axis1: axis(distance1),
        axis2: axis(distance2),
        ticks: Infinity,
        idleTicks: this.features.idleTicks,
        clear: 0,
        startAcc: null,
      };
      return [order];
    };
  }
}

function timedArguments(p: Parameters, hasJerk: boolean): AxisOrder {
  const rate = p.int();
  const accel = p.int();
  return { rate, accel, jerk: hasJerk ? p.int() : 0, steps: Infinity };
}
