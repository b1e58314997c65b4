/**
 * A straight between known end speeds, as blocks: accelerate, cruise, brake; any may be missing.
 *
 *   v ^      ______           peak² = min(cap², (v0² + v1²)/2 + A ℓ)
 *     |     /      \          accelerate over (peak² − v0²)/2A, brake over (peak² − v1²)/2A,
 *  v0 |____/        \____ v1  cruise over the rest
 *     +-----------------> s
 *
 * The caller's look-ahead guarantees |v1² − v0²| ≤ 2 A ℓ. The acceleration of each block is computed from its
 * own end speeds and exact length, (w1² − w0²)/2d, not from A, so that rounding never opens a gap between
 * blocks.
 */
import type { BlockColumns } from "./block-columns.js";

/** A change of speed² below this share of the peak is a rounding error, as is a cruise below this share of the straight. */
const NEGLIGIBLE = 1e-11;

export interface Straight {
  /** Start, mm; unit direction; length, mm. */
  x: number;
  y: number;
  ux: number;
  uy: number;
  length: number;
  /** Speeds at both ends, mm/s, and the max speed² between them. */
  v0: number;
  v1: number;
  cap2: number;
  /** mm along the drawing at the start, and per mm of the straight. */
  alongMm: number;
  alongPerMm: number;
}

export const newStraight = (): Straight => ({
  x: 0,
  y: 0,
  ux: 0,
  uy: 0,
  length: 0,
  v0: 0,
  v1: 0,
  cap2: 0,
  alongMm: 0,
  alongPerMm: 1,
});

/** Appends the blocks of a straight under |a| ≤ `accel`. */
export function writeStraight(straight: Straight, accel: number, out: BlockColumns): void {
  const { length, v0, v1, cap2 } = straight;
  const start2 = v0 * v0;
  const end2 = v1 * v1;
  const peak2 = Math.min((start2 + end2) / 2 + accel * length, Math.max(cap2, start2, end2));
  const negligible2 = NEGLIGIBLE * peak2;
  const rise = peak2 - start2 > negligible2 ? (peak2 - start2) / (2 * accel) : 0;
  const fall = peak2 - end2 > negligible2 ? (peak2 - end2) / (2 * accel) : 0;
  const peak = Math.sqrt(peak2);
  const cruise = length - rise - fall;
  const cruises = cruise > Math.max(NEGLIGIBLE * length, negligible2 / (2 * accel));
  let from = 0;
  let speed = v0;
  if (rise > 0 && (fall > 0 || cruises)) {
    const d = cruises ? rise : length - fall;
    writePhase(straight, 0, d, v0, peak, out);
    from = d;
    speed = peak;
  }
  if (fall > 0 && cruises) {
    const d = length - from - fall;
    writePhase(straight, from, d, speed, peak, out);
    from += d;
    speed = peak;
  }
  // After another phase, `length - from` would be too inexact on a very long straight: a short phase would break A.
  const last = fall > 0 && from > 0 ? fall : length - from;
  writePhase(straight, length - last, last, speed, v1, out);
}

/** `d` mm from speed w0 to speed w1. */
function writePhase(
  { x, y, ux, uy, alongMm, alongPerMm }: Straight,
  from: number,
  d: number,
  w0: number,
  w1: number,
  out: BlockColumns,
): void {
  const a = ((w1 - w0) * (w1 + w0)) / (2 * d);
  const along = alongMm + from * alongPerMm;
  out.push((2 * d) / (w0 + w1), x + ux * from, y + uy * from, ux * w0, uy * w0, ux * a, uy * a, along);
}
