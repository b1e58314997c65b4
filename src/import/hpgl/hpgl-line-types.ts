/** The line types of LT and UL: dashes and dots in percent of a pattern's length (HP, "PCL 5 Technical Reference", 22). */
import type { DashPattern } from "../../drawing/drawing.js";

/** By number, from 1: dash, gap, dash … A dash of length 0 is a dot. */
const USUAL_PATTERNS: readonly (readonly number[])[] = [
  [0, 100],
  [50, 50],
  [70, 30],
  [80, 10, 0, 10],
  [70, 10, 10, 10],
  [50, 10, 10, 10, 10, 10],
  [70, 10, 0, 10, 0, 10],
  [50, 10, 0, 10, 10, 10, 0, 10],
];
/** Percent of the distance between P1 and P2. */
const USUAL_LENGTH = 4;
/** Length of the pattern is in mm. */
const IN_MM = 1;
const PREVIOUS = 99;

export class HpglLineTypes {
  private patterns = [...USUAL_PATTERNS];
  /** Null: a solid line. 0: dots at the points of the file. */
  private type: number | null = null;
  private previous: number | null = null;
  private length = USUAL_LENGTH;
  private isInMm = false;

  /** DF and IN. */
  reset(): void {
    this.patterns = [...USUAL_PATTERNS];
    this.type = this.previous = null;
    this.length = USUAL_LENGTH;
    this.isInMm = false;
  }

  /** LT. Returns false for a type that does not exist. */
  select(numbers: readonly number[]): boolean {
    const [type = null, length, mode] = numbers;
    if (type === PREVIOUS) {
      this.type = this.previous;
      return true;
    }
    if (type !== null && !(Math.abs(type) <= this.patterns.length)) return false;
    if (this.type !== null) this.previous = this.type;
    this.type = type === null ? null : Math.trunc(type);
    if (length !== undefined && length > 0) this.length = length;
    if (mode !== undefined) this.isInMm = mode === IN_MM;
    return true;
  }

  /** UL. Returns false for lengths that make no pattern. */
  define(numbers: readonly number[]): boolean {
    const [type, ...lengths] = numbers;
    const index = Math.abs(type ?? 0) - 1;
    if (type === undefined) this.patterns = [...USUAL_PATTERNS];
    else if (!Number.isInteger(index) || index < 0 || index >= this.patterns.length) return false;
    else if (lengths.length === 0) this.patterns[index] = USUAL_PATTERNS[index];
    else {
      const sum = lengths.reduce((total, length) => total + length, 0);
      if (!(Math.min(...lengths) >= 0 && sum > 0)) return false;
      const shares = lengths.map((length) => (100 * length) / sum);
      // An odd number of lengths alternates: what is a dash the first time is a gap the second.
      this.patterns[index] =
        shares.length % 2 === 0 ? shares : [...shares, ...shares].map((share) => share / 2);
    }
    return true;
  }

  get isSolid(): boolean {
    return this.type === null;
  }

  /** Whether the pattern should be fitted to each line, which is not done. */
  get isAdaptive(): boolean {
    return this.type !== null && this.type < 0;
  }

  /** Only dots at the points of the file. */
  get isDotted(): boolean {
    return this.type === 0;
  }

  /** `diagonalMm`: distance between P1 and P2. */
  dash(diagonalMm: number): DashPattern | null {
    if (this.type === null || this.type === 0) return null;
    const length = this.isInMm ? this.length : (this.length / 100) * diagonalMm;
    const lengths = this.patterns[Math.abs(this.type) - 1].map((share) => (share / 100) * length);
    const isUsable = lengths.every(Number.isFinite) && lengths.some((mm) => mm > 0);
    return isUsable ? { lengths, offset: 0 } : null;
  }
}
