/**
 * Writes legs for firmware 2.5.3 to 2.6: LM, where each motor stops after its own number of steps.
 *
 * Each motor goes to the whole step nearest to the plan, counted from the predicted counter. The rate is chosen so that
 * the last step is on the leg's last tick: both motors end together, and neither waits. The accumulator is then just
 * above zero, so every leg starts from nearly the same state.
 *
 *   tick k adds R + (k − 1) A (magnitudes); one idle tick follows
 *
 * The rate of an LM must not reach zero, or the last step would never come. Rates are
 * kept above 1 % of the mean.
 */
import { ACCUMULATOR_RANGE, rateFromStepsPerS } from "../../../units.js";
import { registersFor, stateAfter, tickOfStep } from "../model/accumulator.js";
import type { FirmwareFeatures } from "../protocol/firmware.js";
import {
  HIGHEST_RATE,
  type Leg,
  type LegCommand,
  type LegWriter,
  type MotorLeg,
  type MotorState,
} from "./leg.js";

const RANGE = ACCUMULATOR_RANGE;
/** Min rate of a motor, as a part of the leg's mean rate. */
const SLOWEST_PART_OF_MEAN = 0.01;

interface Arguments {
  /** Magnitude; the sign of `steps` gives the direction. */
  readonly rate: number;
  readonly accel: number;
  readonly steps: number;
}

export class SteppedWriter implements LegWriter {
  readonly minTicks = 200;
  readonly turnTicks = 120;
  readonly idleTicks = 0;
  /** 0.5 mm/s at 80 steps/mm. */
  readonly jerkErrorRate = rateFromStepsPerS(0.5 * 80);

  constructor(private readonly features: FirmwareFeatures) {}

  commandFor(leg: Leg, m1: MotorState, m2: MotorState): LegCommand | null {
    const ticks = leg.ticks - this.features.idleTicks;
    const a1 = argumentsFor(leg.m1, m1, ticks);
    const a2 = argumentsFor(leg.m2, m2, ticks);
    if (a1.steps === 0 && a2.steps === 0) return null;
    return {
      line: `LM,${a1.rate},${a1.steps},${a1.accel},${a2.rate},${a2.steps},${a2.accel}`,
      ticks: Math.max(run(a1, ticks, m1), run(a2, ticks, m2)) + this.features.idleTicks,
    };
  }
}

function argumentsFor(motor: MotorLeg, state: MotorState, ticks: number): Arguments {
  const steps = Math.round(motor.p1) - state.steps;
  if (steps === 0) return { rate: 0, accel: 0, steps };
  const direction = Math.sign(steps);
  const distance = Math.abs(steps) * RANGE - state.acc;
  const mean = distance / ticks;
  const slope = (direction * (motor.v1 - motor.v0)) / ticks;
  const room = Math.min(mean * (1 - SLOWEST_PART_OF_MEAN), HIGHEST_RATE - mean);
  const steepest = ticks > 1 ? Math.max(0, (2 * room) / (ticks - 1)) : 0;
  const accel = Math.trunc(Math.max(-steepest, Math.min(steepest, slope)));
  // Rounded up, so that the last step is never after the last tick.
  return { rate: Math.ceil(mean - (accel * (ticks - 1)) / 2), accel, steps };
}

/** Advances the motor until its steps are done. Returns the number of ticks. */
function run(a: Arguments, ticks: number, state: MotorState): number {
  if (a.steps === 0) return 0;
  const registers = registersFor("late", a.rate, a.accel);
  const last = tickOfStep(Math.abs(a.steps), ticks, registers, state.acc);
  state.acc = stateAfter(last, registers, state.acc).acc;
  state.steps += a.steps;
  return last;
}
