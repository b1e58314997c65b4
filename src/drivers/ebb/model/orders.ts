/**
 * Entries of the board's motion queue, parsed from commands: moves, delays, pen and motor switches. accumulator.ts
 * models what a move does tick by tick.
 */
import { AxisMotion, registersFor, type Rates, type Registers } from "./accumulator.js";
import type { FirmwareFeatures, TickArithmetic } from "../protocol/firmware.js";
import { ACCUMULATOR_RANGE } from "../../../units.js";

/** Signed arguments; on older firmware the sign of `rate` gives the direction. */
export interface AxisOrder extends Rates {
  /** Steps after which this motor stops; Infinity for a timed move. */
  readonly steps: number;
}

export interface MoveOrder {
  readonly kind: "move";
  readonly axis1: AxisOrder;
  readonly axis2: AxisOrder;
  /** Ticks of a timed move; Infinity for one limited by steps. */
  readonly ticks: number;
  /** Bit 0: motor 1's accumulator is cleared first; bit 1: motor 2's. */
  readonly clear: number;
  /** Initial value of both accumulators in test mode; left out: unchanged. */
  readonly startAcc?: number;
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
  | { readonly kind: "enable"; readonly mode1: number; readonly mode2: number };

export const isTimed = ({ ticks }: MoveOrder): boolean => ticks !== Infinity;

/** A running move: both motors, from the board's state at its start. */
export class RunningMove {
  /** Ticks until the next order can begin, idle ticks included. */
  readonly ticks: number;

  private constructor(
    readonly order: MoveOrder,
    readonly motion1: AxisMotion,
    readonly motion2: AxisMotion,
    private readonly features: FirmwareFeatures,
  ) {
    const idleTicks = isTimed(order) ? features.idleTicksTimed : features.idleTicks;
    this.ticks = Math.max(motion1.ticks, motion2.ticks) + idleTicks;
  }

  static begin(order: MoveOrder, features: FirmwareFeatures, acc1: number, acc2: number): RunningMove {
    const { arithmetic } = features;
    const load = (axis: AxisOrder, acc: number, bit: number): AxisMotion => {
      const registers = registersFor(arithmetic, axis.rate, axis.accel, axis.jerk);
      const cleared = (order.clear & bit) !== 0;
      const start = cleared ? clearedAccumulator(arithmetic, registers) : (order.startAcc ?? acc);
      return new AxisMotion(arithmetic, registers, start, axis.steps, order.ticks);
    };
    return new RunningMove(order, load(order.axis1, acc1, 1), load(order.axis2, acc2, 2), features);
  }

  /** The rest of the move after `ticks` ticks, with accumulators that may have been changed. */
  restAfter(ticks: number, acc1: number, acc2: number): RunningMove {
    const { motion1, motion2, order, features } = this;
    const ticksLeft = Math.max(0, order.ticks - ticks);
    const axisLeft = (motion: AxisMotion, axis: AxisOrder): AxisOrder => ({
      ...axis,
      steps: axis.steps - motion.stepsMadeAfter(ticks),
    });
    const rest = (motion: AxisMotion, { steps }: AxisOrder, acc: number): AxisMotion => {
      const registers = motion.registersAfter(Math.min(ticks, motion.ticks));
      return new AxisMotion(features.arithmetic, registers, acc, steps, ticksLeft);
    };
    const axis1 = axisLeft(motion1, order.axis1);
    const axis2 = axisLeft(motion2, order.axis2);
    const left = { ...order, ticks: ticksLeft, axis1, axis2 };
    return new RunningMove(left, rest(motion1, axis1, acc1), rest(motion2, axis2, acc2), features);
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
  return first < 0 ? ACCUMULATOR_RANGE - 1 : 0;
}
