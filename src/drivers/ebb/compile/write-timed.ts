/**
 * Writes legs for firmware 2.7 to 2.8: LT with a constant acceleration per motor.
 *
 * This LT takes the direction from the sign of Rate and applies Accel to its magnitude. A magnitude that falls below
 * zero wraps to full speed. So a motor must never reverse within a leg (the compiler cuts there), and its speeds must
 * not be negative.
 *
 * The accumulator holds the fraction of a step moved since the last step, in the direction of travel. After a reversal
 * that fraction counts in the wrong direction. If zero is closer to the true position, the command clears it.
 */
import { ACCUMULATOR_RANGE, rateFromStepsPerS } from "../../../units.js";
import { registersFor, stateAfter } from "../model/accumulator.js";
import {
  correction,
  HIGHEST_RATE,
  type Leg,
  type LegCommand,
  type LegWriter,
  type MotorLeg,
  type MotorState,
} from "./leg.js";

const RANGE = ACCUMULATOR_RANGE;
/** An accumulator is cleared only if that reduces the error by more than this, steps. */
const CLEAR_WORTH_STEPS = 0.1;

interface Arguments {
  readonly rate: number;
  readonly accel: number;
  readonly clear: boolean;
}

export class TimedWriter implements LegWriter {
  readonly minTicks = 125;
  readonly turnTicks = 30;
  readonly idleTicks = 0;
  /** 0.25 mm/s at 80 steps/mm. */
  readonly jerkErrorRate = rateFromStepsPerS(0.25 * 80);

  commandFor(leg: Leg, m1: MotorState, m2: MotorState): LegCommand | null {
    const a1 = argumentsFor(leg, leg.m1, m1);
    const a2 = argumentsFor(leg, leg.m2, m2);
    // The board refuses a command with both rates zero. Nothing is lost by waiting for the next leg.
    if (a1.rate === 0 && a2.rate === 0) return null;
    run(a1, leg.ticks, m1);
    run(a2, leg.ticks, m2);
    const line = `LT,${leg.ticks},${a1.rate},${a1.accel},${a2.rate},${a2.accel}`;
    const clear = (a1.clear ? 1 : 0) + (a2.clear ? 2 : 0);
    return { line: clear === 0 ? line : `${line},${clear}`, ticks: leg.ticks };
  }
}

function argumentsFor(leg: Leg, motor: MotorLeg, state: MotorState): Arguments {
  const { ticks } = leg;
  const planned = motor.p1 - motor.p0;
  const direction = planned < 0 || (planned === 0 && motor.v0 + motor.v1 < 0) ? -1 : 1;
  const ahead = direction * (state.steps - motor.p0) - 0.5;
  const errorKept = -(ahead + state.acc / RANGE);
  const errorCleared = -ahead;
  const clear = Math.abs(errorCleared) + CLEAR_WORTH_STEPS < Math.abs(errorKept);
  const error = clear ? errorCleared : errorKept;
  const distance = (Math.abs(planned) + correction(error, ticks, leg.isLast)) * RANGE;
  const mean = distance / ticks;
  if (!(mean >= 1)) return { rate: 0, accel: 0, clear };
  const slope = (direction * (motor.v1 - motor.v0)) / ticks;
  const steepest = (2 * Math.min(mean, HIGHEST_RATE - mean)) / (ticks + 1);
  const accel = Math.trunc(Math.max(-steepest, Math.min(steepest, slope)));
  const start = Math.round(mean - (accel * (ticks + 1)) / 2) + Math.trunc(accel / 2);
  // At least 1: the sign of the rate gives the direction, and the board refuses a command with both rates zero.
  return { rate: keptAboveZero(direction * Math.max(1, start), accel, ticks), accel, clear };
}

/** The rate, raised until no tick's rate is negative; the extremes are at the first and last tick. */
function keptAboveZero(rate: number, accel: number, ticks: number): number {
  const register = registersFor("half", rate, accel).rate;
  const lowest = Math.min(register + accel, register + ticks * accel);
  return lowest < 0 ? rate + Math.sign(rate) * -lowest : rate;
}

function run(a: Arguments, ticks: number, state: MotorState): void {
  if (a.clear) state.acc = 0;
  const { net, acc } = stateAfter(ticks, registersFor("half", a.rate, a.accel), state.acc);
  state.steps += a.rate < 0 ? -net : net;
  state.acc = acc;
}
