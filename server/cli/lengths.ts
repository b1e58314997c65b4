/** Lengths as people type them: mm, or with a unit. */
import { InvalidArgumentError } from "commander";

const MM_PER_UNIT: Readonly<Record<string, number>> = { "": 1, mm: 1, cm: 10, in: 25.4, '"': 25.4 };
const UNITS = "mm, or with a unit as in 2cm or 1in";

/** "12", "12mm", "1.2cm", "1in"; NaN for anything else. */
function toMm(text: string): number {
  const [, amount, unit] = /^([-+]?(?:\d+\.?\d*|\.\d+))\s*(mm|cm|in|"|)$/i.exec(text.trim()) ?? [];
  if (amount === undefined || unit === undefined) return NaN;
  const mm = Number(amount) * (MM_PER_UNIT[unit.toLowerCase()] ?? NaN);
  // An inch is not a round number of binary mm: 8.5in must be 215.9, not 215.89999999999998.
  return Number(mm.toFixed(9));
}

export function length(text: string): number {
  const mm = toMm(text);
  if (!Number.isFinite(mm)) throw new InvalidArgumentError(`It must be a length in ${UNITS}.`);
  return mm;
}

/** "210x297", "20x20cm", "8.5x11in": a unit at the end applies to both. Null if malformed. */
export function sizeMm(text: string): { readonly widthMm: number; readonly heightMm: number } | null {
  const [width, height, ...more] = text.trim().split(/\s*[x×]\s*/i);
  if (width === undefined || height === undefined || more.length > 0) return null;
  const unit = /[a-z"]*$/i.exec(height)?.[0] ?? "";
  const widthMm = toMm(/[a-z"]$/i.test(width) ? width : `${width}${unit}`);
  const heightMm = toMm(height);
  return widthMm > 0 && heightMm > 0 ? { widthMm, heightMm } : null;
}
