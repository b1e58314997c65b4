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
  const { x, y, ux, uy, length, v0, v1, cap2, alongMm, alongPerMm } = straight;
  const start2 = v0 * v0;
  const end2 = v1 * v1;
  const peak2 = Math.min((start2 + end2) / 2 + accel * length, Math.max(cap2, start2, end2));
  const negligible2 = NEGLIGIBLE * peak2;
  const rise = peak2 - start2 > negligible2 ? (peak2 - start2) / (2 * accel) : 0;
  const fall = peak2 - end2 > negligible2 ? (peak2 - end2) / (2 * accel) : 0;
  const peak = Math.sqrt(peak2);
  const rest = length - rise - fall;
  const cruises = rest > Math.max(NEGLIGIBLE * length, negligible2 / (2 * accel));
  // Lengths of the blocks, mm; 0: missing. The last one ends at v1, whichever phase it is. Of two phases without a cruise
  // between them, the rounding error goes to the first.
  const first = cruises ? rise : rise > 0 && fall > 0 ? length - fall : 0;
  const cruise = cruises && fall > 0 ? rest : 0;
  const last = first + cruise === 0 ? length : fall > 0 ? fall : rest;
  let from = 0;
  let w0 = v0;
  for (let block = 0; block < 3; block++) {
    const d = block === 0 ? first : block === 1 ? cruise : last;
    if (d === 0) continue;
    const w1 = block === 2 ? v1 : peak;
    const a = ((w1 - w0) * (w1 + w0)) / (2 * d);
    const k = out.add((2 * d) / (w0 + w1));
    out.x[k] = x + ux * from;
    out.y[k] = y + uy * from;
    out.vx[k] = ux * w0;
    out.vy[k] = uy * w0;
    out.ax[k] = ux * a;
    out.ay[k] = uy * a;
    out.alongMm[k] = alongMm + from * alongPerMm;
    from += d;
    w0 = w1;
  }
}
