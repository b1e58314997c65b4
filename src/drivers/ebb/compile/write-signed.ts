/**
 * Writes legs for firmware 3: LT if the acceleration is constant, otherwise T3.
 *
 * A timed command of T ticks is followed by one idle tick, so a leg of n ticks uses T = n − 1, with speeds
 * scaled by n/T. With R, A, J the accumulator gains exactly (before the divisions by 2 and 6 are truncated)
 *
 *   R T + A T²/2 + J T³/6
 *
 * J is chosen first, then A for the end speed, then R for the end position. Each compensates the rounding
 * error of the previous one. The remaining error is at most T/2 counts, a few millionths of a step.
 */
import { ACCUMULATOR_RANGE } from "../../../units.js";
import { rateAt, registersFor, stateAfter, type Rates } from "../model/accumulator.js";
import type { FirmwareFeatures } from "../protocol/firmware.js";
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

export class SignedWriter implements LegWriter {
  readonly minTicks = 125;
  readonly turnTicks = 0;
  readonly idleTicks: number;
  /** The unit of J is 91 mm/s³: within `MAX_TICKS`, an error of half a unit bends the line by less than 2 µm. */
  readonly jerkErrorRate = Infinity;

  constructor(features: FirmwareFeatures) {
    this.idleTicks = features.idleTicksTimed;
  }

  commandFor(leg: Leg, m1: MotorState, m2: MotorState): LegCommand {
    const ticks = leg.ticks - this.idleTicks;
    const a1 = argumentsFor(leg, leg.m1, m1, ticks);
    const a2 = argumentsFor(leg, leg.m2, m2, ticks);
    run(a1, ticks, m1);
    run(a2, ticks, m2);
    const line =
      a1.jerk === 0 && a2.jerk === 0
        ? `LT,${ticks},${a1.rate},${a1.accel},${a2.rate},${a2.accel}`
        : `T3,${ticks},${a1.rate},${a1.accel},${a1.jerk},${a2.rate},${a2.accel},${a2.jerk}`;
    return { line, ticks: leg.ticks };
  }
}

function argumentsFor(leg: Leg, motor: MotorLeg, state: MotorState, ticks: number): Rates {
  const stretch = leg.ticks / ticks;
  const planned = motor.p1 - motor.p0;
  const error = motor.p0 + 0.5 - state.steps - state.acc / RANGE;
  const distance = (planned + correction(error, ticks, leg.isLast)) * RANGE;
  const v0 = motor.v0 * stretch;
  const v1 = motor.v1 * stretch;
  // The trapezoid of the two end speeds misses the distance by J T³/12.
  const excess = (v0 + v1) / 2 - (planned * RANGE) / ticks;
  const jerk = leg.isParabola ? 0 : Math.round((12 * excess) / (ticks * ticks));
  const accel = Math.round((v1 - v0 - (jerk * ticks * ticks) / 2) / ticks);
  const bent = (accel * ticks) / 2 + (jerk * ticks * ticks) / 6;
  return keptInRange({ rate: Math.round(distance / ticks - bent), accel, jerk }, ticks);
}

/** The planned rates are limited already. Rounding and correction may still exceed the range slightly. */
function keptInRange(a: Rates, ticks: number): Rates {
  const registers = registersFor("signed", a.rate, a.accel, a.jerk);
  const last = rateAt(ticks, registers);
  const first = rateAt(1, registers);
  const over = Math.max(first, last) - HIGHEST_RATE;
  const under = -HIGHEST_RATE - Math.min(first, last);
  if (over > 0) return { ...a, rate: a.rate - Math.ceil(over) };
  if (under > 0) return { ...a, rate: a.rate + Math.ceil(under) };
  return a;
}

function run(a: Rates, ticks: number, state: MotorState): void {
  const { net, acc } = stateAfter(ticks, registersFor("signed", a.rate, a.accel, a.jerk), state.acc);
  state.steps += net;
  state.acc = acc;
}
