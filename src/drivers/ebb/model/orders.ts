/**
 * Entries of the board's motion queue, parsed from commands: moves, delays, pen and motor switches. This file
 * converts arguments to rates for each firmware. accumulator.ts models what a move then does tick by tick.
 */
import { AxisMotion, registersFor, type Registers } from "./accumulator.js";
import type { FirmwareFeatures, TickArithmetic } from "../protocol/firmware.js";
import { slowRate } from "./slow-rate.js";
import { ACCUMULATOR_RANGE, TICKS_PER_MS } from "../../../units.js";

const RANGE = ACCUMULATOR_RANGE;

export interface AxisOrder {
  /** Signed arguments; on older firmware the sign of `rate` gives the direction. */
  readonly rate: number;
  readonly accel: number;
  readonly jerk: number;
  /** Steps after which this motor stops; Infinity for a timed move. */
  readonly steps: number;
}

export interface MoveOrder {
  readonly kind: "move";
  readonly isTimed: boolean;
  readonly axis1: AxisOrder;
  readonly axis2: AxisOrder;
  /** Ticks of a timed move; Infinity for one limited by steps. */
  readonly ticks: number;
  /** Ticks at rest afterwards. */
  readonly idleTicks: number;
  /** Bit 0: motor 1's accumulator is cleared first; bit 1: motor 2's. */
  readonly clear: number;
  /** Initial value of both accumulators in test mode; null: unchanged. */
  readonly startAcc: number | null;
}

export type Order =
  | MoveOrder
  | { readonly kind: "delay"; readonly ticks: number }
  | {
      readonly kind: "servo";
      readonly position: number;
      /** Change of position per 24 ms frame; 0: at once. */
      readonly rate: number;
      readonly ticks: number;
      /** The machine's pen is connected to this output. */
      readonly movesPen: boolean;
      /**
       * New value of the board's pen flag. Null: unchanged, and the servo's direction decides
       * whether the pen lifts.
       */
      readonly penUp: boolean | null;
      /** True for pen commands (SP, TP), whose target SP,3 can change. */
      readonly isPen: boolean;
    }
  | { readonly kind: "enable"; readonly mode1: number; readonly mode2: number | null };

const still: AxisOrder = { rate: 0, accel: 0, jerk: 0, steps: 0 };

/** SM and XM. Returns null if a rate is out of range. */
export function stepperMove(
  firmware: FirmwareFeatures,
  ms: number,
  steps1: number,
  steps2: number,
  clear: number,
): Order | null {
  if (steps1 === 0 && steps2 === 0) {
    const longestMs = firmware.arithmetic === "signed" ? 100_000 : 16_777_215;
    return { kind: "delay", ticks: Math.max(1, Math.min(ms, longestMs) * TICKS_PER_MS) };
  }
  const axis1 = constantAxis(firmware.arithmetic, ms, steps1);
  const axis2 = constantAxis(firmware.arithmetic, ms, steps2);
  if (axis1 === null || axis2 === null) return null;
  return {
    kind: "move",
    isTimed: false,
    axis1,
    axis2,
    ticks: Infinity,
    idleTicks: firmware.idleTicks,
    clear,
    startAcc: null,
  };
}

function constantAxis(arithmetic: TickArithmetic, ms: number, steps: number): AxisOrder | null {
  if (steps === 0) return still;
  const rate = slowRate(arithmetic, ms, Math.abs(steps));
  if (rate < 1 || rate > RANGE || (arithmetic !== "signed" && rate === RANGE)) return null;
  return { rate: Math.sign(steps) * rate, accel: 0, jerk: 0, steps: Math.abs(steps) };
}

/** One motor of LM or L3; negative steps negate rate and acceleration, but not the jerk, as the firmware does. Null for arguments that the board refuses. */
export function steppedAxis(
  arithmetic: TickArithmetic,
  rate: number,
  steps: number,
  accel: number,
  jerk: number,
): AxisOrder | null {
  if (arithmetic !== "signed") {
    if (rate < 0) return null;
    // −0 keeps the direction.
    return { rate: steps < 0 ? -rate : rate, accel, jerk: 0, steps: Math.abs(steps) };
  }
  if (steps >= 0) return { rate, accel, jerk, steps };
  if (rate < 0) return null;
  return { rate: 0 - rate, accel: 0 - accel, jerk, steps: -steps };
}

/** A running move: both motors, from the board's state at its start. */
export class RunningMove {
  /** Ticks until the next order can begin, idle ticks included. */
  readonly ticks: number;

  private constructor(
    readonly order: MoveOrder,
    readonly motion1: AxisMotion,
    readonly motion2: AxisMotion,
    private readonly arithmetic: TickArithmetic,
  ) {
    this.ticks = Math.max(motion1.ticks, motion2.ticks) + order.idleTicks;
  }

  static begin(order: MoveOrder, arithmetic: TickArithmetic, acc1: number, acc2: number): RunningMove {
    const load = (axis: AxisOrder, acc: number, bit: number): AxisMotion => {
      const registers = registersFor(arithmetic, axis.rate, axis.accel, axis.jerk);
      const cleared = (order.clear & bit) !== 0;
      const start = cleared ? clearedAccumulator(arithmetic, registers) : (order.startAcc ?? acc);
      return new AxisMotion(arithmetic, registers, start, axis.steps, order.ticks);
    };
    return new RunningMove(order, load(order.axis1, acc1, 1), load(order.axis2, acc2, 2), arithmetic);
  }

  /** The rest of the move after `ticks` ticks, with accumulators that may have been changed. */
  restAfter(ticks: number, acc1: number, acc2: number): RunningMove {
    const rest = (motion: AxisMotion, axis: AxisOrder, acc: number): AxisMotion => {
      const done = Math.min(ticks, motion.ticks);
      const stepsLeft = axis.steps - motion.stepsMadeAfter(done);
      const ticksLeft = Math.max(0, this.order.ticks - ticks);
      return new AxisMotion(this.arithmetic, motion.registersAfter(done), acc, stepsLeft, ticksLeft);
    };
    const { motion1, motion2, order } = this;
    const left: MoveOrder = {
      ...order,
      ticks: Math.max(0, order.ticks - ticks),
      axis1: { ...order.axis1, steps: order.axis1.steps - motion1.stepsMadeAfter(ticks) },
      axis2: { ...order.axis2, steps: order.axis2.steps - motion2.stepsMadeAfter(ticks) },
    };
    return new RunningMove(
      left,
      rest(motion1, order.axis1, acc1),
      rest(motion2, order.axis2, acc2),
      this.arithmetic,
    );
  }
}

/**
 * Firmware 3 clears the accumulator of a backward move to just below the overflow, so that its first step takes as long
 * as that of a forward move.
 */
function clearedAccumulator(arithmetic: TickArithmetic, registers: Registers): number {
  if (arithmetic !== "signed") return 0;
  const { rate, accel, jerk } = registers;
  const first = [rate + accel + jerk, accel + 2 * jerk, jerk].find((value) => value !== 0) ?? 0;
  return first < 0 ? RANGE - 1 : 0;
}
