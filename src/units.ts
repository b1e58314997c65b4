/**
 * All conversions between units. The constants 25.4, 96, 25 000 and 2^31 are defined only here.
 *
 *   mm, s        what geometry, prepare and plan work in
 *   px           CSS pixel, 1/96 in
 *   ticks        board interrupts of 40 µs
 *   steps        microsteps of one motor
 *   rate         accumulator counts per tick: steps/s × 2^31 / 25 000   (EBB firmware, ebb.c)
 */
export const MM_PER_INCH = 25.4;
export const PX_PER_INCH = 96;
export const MM_PER_PX = MM_PER_INCH / PX_PER_INCH;

/** Interrupts per second; also the max steps per second of one motor. */
export const TICKS_PER_S = 25_000;
export const S_PER_TICK = 1 / TICKS_PER_S;
export const TICKS_PER_MS = TICKS_PER_S / 1_000;

/** The motor makes one step each time the 31-bit accumulator overflows. */
export const ACCUMULATOR_RANGE = 2 ** 31;

export const mmFromPx = (px: number): number => px * MM_PER_PX;
export const mmFromInch = (inch: number): number => inch * MM_PER_INCH;
export const ticksFromS = (s: number): number => s * TICKS_PER_S;
export const sFromTicks = (ticks: number): number => ticks / TICKS_PER_S;

/** Accumulator counts per tick from a step rate in steps/s (not rounded). */
export const rateFromStepsPerS = (stepsPerS: number): number => (stepsPerS * ACCUMULATOR_RANGE) / TICKS_PER_S;
export const stepsPerSFromRate = (rate: number): number => (rate * TICKS_PER_S) / ACCUMULATOR_RANGE;
/** Accumulator counts per tick² from steps/s² (not rounded). */
export const accelFromStepsPerS2 = (stepsPerS2: number): number =>
  (stepsPerS2 * ACCUMULATOR_RANGE) / (TICKS_PER_S * TICKS_PER_S);
/** Accumulator counts per tick³ from steps/s³ (not rounded). */
export const jerkFromStepsPerS3 = (stepsPerS3: number): number =>
  (stepsPerS3 * ACCUMULATOR_RANGE) / (TICKS_PER_S * TICKS_PER_S * TICKS_PER_S);
