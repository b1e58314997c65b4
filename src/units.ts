/**
 * All conversions between units. The constants 25.4, 96, 25 000 and 2^31 are defined only here.
 *
 *   mm, s        units of geometry, prepare and plan
 *   px           CSS pixel, 1/96 in
 *   rad          angles; degrees only in files and settings
 *   ticks        board interrupts of 40 µs
 *   steps        microsteps of one motor
 *   rate         accumulator counts per tick: steps/s × 2^31 / 25 000   (EBB firmware, ebb.c)
 */
export const MM_PER_INCH = 25.4;
export const PX_PER_INCH = 96;
export const MM_PER_PX = MM_PER_INCH / PX_PER_INCH;

export const RAD_PER_DEG = Math.PI / 180;

/** Interrupts per second; also the max steps per second of one motor. */
export const TICKS_PER_S = 25_000;
export const S_PER_TICK = 1 / TICKS_PER_S;
export const TICKS_PER_MS = TICKS_PER_S / 1_000;

/** The motor makes one step each time the 31-bit accumulator overflows. */
export const ACCUMULATOR_RANGE = 2 ** 31;

export const sFromTicks = (ticks: number): number => ticks / TICKS_PER_S;

/** Accumulator counts per tick from a step rate in steps/s (not rounded). */
export const rateFromStepsPerS = (stepsPerS: number): number => (stepsPerS * ACCUMULATOR_RANGE) / TICKS_PER_S;
export const stepsPerSFromRate = (rate: number): number => (rate * TICKS_PER_S) / ACCUMULATOR_RANGE;

const MM_PER_UNIT = { mm: 1, cm: 10, m: 1_000, in: MM_PER_INCH, '"': MM_PER_INCH } as const;
export const LENGTH_UNITS = ["mm", "in"] as const;
/** The unit in which lengths are shown. */
export type LengthUnit = (typeof LENGTH_UNITS)[number];

/** Rounded, because 8.5 in must be 215.9 mm, not 215.89999999999998. */
export const mmFromLength = (length: number, unit: keyof typeof MM_PER_UNIT): number =>
  Number((length * MM_PER_UNIT[unit]).toFixed(9));
/** Rounded to 0.1 mm, for messages. */
export const mmInWords = (mm: number): string => String(Math.round(mm * 10) / 10);
export const lengthFromMm = (mm: number, unit: LengthUnit): number => mm / MM_PER_UNIT[unit];

const isUnit = (word: string): word is keyof typeof MM_PER_UNIT => Object.hasOwn(MM_PER_UNIT, word);

/** "12", "12mm", "1.2 cm", "8.5in"; null for anything else. */
export function parseLength(text: string): number | null {
  const [, amount, unit] =
    /^([-+]?(?:\d+\.?\d*|\.\d+)(?:e[-+]?\d+)?)\s*([a-z"]*)$/.exec(text.trim().toLowerCase()) ?? [];
  const word = unit === "" ? "mm" : unit;
  if (amount === undefined || word === undefined || !isUnit(word)) return null;
  const mm = mmFromLength(Number(amount), word);
  return Number.isFinite(mm) ? mm : null;
}

/** "210x297", "20x20cm", "8.5x11in": a unit at the end applies to both. Null if malformed. */
export function parseSize(text: string): { readonly widthMm: number; readonly heightMm: number } | null {
  const [width, height, ...more] = text.trim().split(/\s*[x×]\s*/i);
  if (width === undefined || height === undefined || more.length > 0) return null;
  const unit = /[a-z"]*$/i.exec(height)?.[0] ?? "";
  const widthMm = parseLength(/[a-z"]$/i.test(width) ? width : `${width}${unit}`);
  const heightMm = parseLength(height);
  if (widthMm === null || heightMm === null) return null;
  return widthMm > 0 && heightMm > 0 ? { widthMm, heightMm } : null;
}
