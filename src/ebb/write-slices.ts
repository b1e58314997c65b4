/**
 * Legs for firmware before 2.5.3: SM at constant rates, in slices short enough to follow a ramp.
 *
 * SM takes whole milliseconds and whole steps and works out the rate itself, rounded down. The counts are the
 * nearest steps to the plan's place, from the board's true count; how long the slice really takes is known to the
 * tick, and the next one starts from there.
 */
import { ACCUMULATOR_RANGE, TICKS_PER_S } from "../units.js";
import type { CommandText } from "./commands.js";
import type { FirmwareFeatures } from "./firmware.js";
import type { Leg, LegWriter, MotorPlace } from "./leg.js";
import { HIGHEST_RATE } from "./limits.js";
import { slowRate } from "./slow-rate.js";

const RANGE = ACCUMULATOR_RANGE;
const TICKS_PER_MS = TICKS_PER_S / 1_000;

export class SliceWriter implements LegWriter {
  readonly minTicks = 10 * TICKS_PER_MS + 1;
  readonly maxTicks = 14 * TICKS_PER_MS;
  readonly turnTicks = 120;
  readonly idleTicks = 0;
  readonly joinsAnySpeeds = true;

  constructor(
    private readonly text: CommandText,
    private readonly features: FirmwareFeatures,
  ) {}

  longestWithin(ticks: number): number {
    const { idleTicks } = this.features;
    return Math.max(1, Math.floor((ticks - idleTicks) / TICKS_PER_MS)) * TICKS_PER_MS + idleTicks;
  }

  maxTicksForJerk(): number {
    return Infinity;
  }

  write(leg: Leg, m1: MotorPlace, m2: MotorPlace): number {
    const steps1 = Math.round(leg.m1.p1) - m1.steps;
    const steps2 = Math.round(leg.m2.p1) - m2.steps;
    if (steps1 === 0 && steps2 === 0) return 0;
    const { arithmetic, idleTicks } = this.features;
    let ms = Math.max(1, Math.floor((leg.ticks - idleTicks) / TICKS_PER_MS));
    const most = Math.max(Math.abs(steps1), Math.abs(steps2));
    while (slowRate(arithmetic, ms, most) > HIGHEST_RATE) ms++;
    this.text.name("SM");
    this.text.number(ms);
    this.text.number(steps1);
    this.text.number(steps2);
    this.text.end();
    const ticks1 = run(slowRate(arithmetic, ms, Math.abs(steps1)), steps1, m1);
    const ticks2 = run(slowRate(arithmetic, ms, Math.abs(steps2)), steps2, m2);
    return Math.max(ticks1, ticks2) + idleTicks;
  }
}

function run(rate: number, steps: number, place: MotorPlace): number {
  if (steps === 0) return 0;
  const way = Math.abs(steps) * RANGE - place.acc;
  const ticks = Math.ceil(way / rate);
  place.acc = ticks * rate - way;
  place.steps += steps;
  return ticks;
}
