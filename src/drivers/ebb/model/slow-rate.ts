/**
 * The rate that the board computes for SM and XM from a number of steps and milliseconds.
 * Source: ebb.c of firmware 2.x and 3.x (evil-mad/EggBot).
 */
import { TICKS_PER_MS } from "../../../units.js";
import type { TickArithmetic } from "../protocol/firmware.js";

const SLOWEST_SHORT_MS = 30;

/**
 * Accumulator counts per tick for `steps` ≥ 0 in `ms` > 0 milliseconds. Rounded down, so a move may end
 * late, never early. Firmware 3 computes in single precision; older ones with integers, with only 15
 * bits up to 30 ms.
 */
export function slowRate(arithmetic: TickArithmetic, ms: number, steps: number): number {
  if (arithmetic === "signed") {
    const perMs = Math.fround(Math.fround(85_899_345.92) / Math.fround(ms));
    return Math.trunc(Math.fround(Math.fround(steps) * perMs));
  }
  const ticks = TICKS_PER_MS * ms;
  if (ms <= SLOWEST_SHORT_MS) return Math.floor((steps * 2 ** 15) / ticks) * 2 ** 16;
  const whole = Math.floor((Math.floor(steps / ms) * 2 ** 15) / 25);
  const rest = Math.floor(((steps % ms) * 2 ** 15) / 25);
  return whole * 2 ** 16 + Math.floor((rest * 2 ** 16) / ms);
}
