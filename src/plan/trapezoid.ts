/**
 * Straight segments between known speeds, as blocks: accelerate, cruise, brake; any may be missing.
 *
 *   v ^      ______           peak² = min(cap², (v0² + v1²)/2 + A ℓ)
 *     |     /      \          accelerate over (peak² − v0²)/2A, brake over (peak² − v1²)/2A,
 *  v0 |____/        \____ v1  cruise over the rest
 *     +-----------------> s
 *
 * Each block takes its acceleration from its own end speeds and exact length, (w1² − w0²)/2d, not
 * from A: rounding then never opens a gap between blocks.
 */
import type { BlockColumns } from "./block-columns.js";
import type { RunPath } from "./run-path.js";

/** A change of speed² below this share of it, or a cruise below this share of its segment, is rounding. */
const NEGLIGIBLE = 1e-11;

/** Writes the whole run; `path.v2` holds the speeds² found by the look-ahead, `path.cap2` the segments' limits. */
export function writeTrapezoids(path: RunPath, accel: number, out: BlockColumns): void {
  const { segmentCount: n, x, y, length, ux, uy, v2, cap2 } = path;
  out.reserve(countTrapezoidBlocks(path, accel), n);
  const { durationS, x: bx, y: by, vx, vy, ax, ay, startS, alongMm } = out;
  const twoA = 2 * accel;
  let k = out.count;
  let clock = out.clockS;
  let along = path.startAlong;
  let w0 = 0;
  for (let i = 0; i < n; i++) {
    const l = length[i]!;
    const ex = ux[i]!;
    const ey = uy[i]!;
    const start2 = v2[i]!;
    const end2 = v2[i + 1]!;
    const end = Math.sqrt(end2);
    const free2 = (start2 + end2) / 2 + accel * l;
    const peak2 = free2 < cap2[i]! ? free2 : cap2[i]!;
    const least = NEGLIGIBLE * l;
    const least2 = NEGLIGIBLE * peak2;
    const rise = peak2 - start2 > least2 ? (peak2 - start2) / twoA : 0;
    const fall = peak2 - end2 > least2 ? (peak2 - end2) / twoA : 0;
    const cruise = l - rise - fall;
    let done = 0;
    if (rise > 0 && (fall > 0 || cruise > least)) {
      const w1 = Math.sqrt(peak2);
      const d = fall > 0 && cruise <= least ? l - fall : rise;
      const a = (peak2 - start2) / (2 * d);
      const t = (2 * d) / (w0 + w1);
      durationS[k] = t;
      bx[k] = x[i]!;
      by[k] = y[i]!;
      vx[k] = ex * w0;
      vy[k] = ey * w0;
      ax[k] = ex * a;
      ay[k] = ey * a;
      startS[k] = clock;
      alongMm[k] = along;
      clock += t;
      k++;
      done = d;
      w0 = w1;
    }
    if (fall > 0 && cruise > least) {
      const w1 = Math.sqrt(peak2);
      const d = l - done - fall;
      const t = (2 * d) / (w0 + w1);
      durationS[k] = t;
      bx[k] = x[i]! + ex * done;
      by[k] = y[i]! + ey * done;
      vx[k] = ex * w0;
      vy[k] = ey * w0;
      const a = (w1 - w0) / t;
      ax[k] = ex * a;
      ay[k] = ey * a;
      startS[k] = clock;
      alongMm[k] = along + done;
      clock += t;
      k++;
      done += d;
      w0 = w1;
    }
    const d = l - done;
    const a = (end2 - w0 * w0) / (2 * d);
    const t = (2 * d) / (w0 + end);
    durationS[k] = t;
    bx[k] = x[i]! + ex * done;
    by[k] = y[i]! + ey * done;
    vx[k] = ex * w0;
    vy[k] = ey * w0;
    ax[k] = ex * a;
    ay[k] = ey * a;
    startS[k] = clock;
    alongMm[k] = along + done;
    clock += t;
    k++;
    along += l;
    w0 = end;
  }
  out.count = k;
  out.clockS = clock;
}

/** How many blocks `writeTrapezoids` makes: the same choices, without the writing. */
function countTrapezoidBlocks(path: RunPath, accel: number): number {
  const { segmentCount: n, length, v2, cap2 } = path;
  const twoA = 2 * accel;
  let count = n;
  for (let i = 0; i < n; i++) {
    const l = length[i]!;
    const free2 = (v2[i]! + v2[i + 1]!) / 2 + accel * l;
    const peak2 = free2 < cap2[i]! ? free2 : cap2[i]!;
    const least2 = NEGLIGIBLE * peak2;
    const rise = peak2 - v2[i]! > least2 ? (peak2 - v2[i]!) / twoA : 0;
    const fall = peak2 - v2[i + 1]! > least2 ? (peak2 - v2[i + 1]!) / twoA : 0;
    const cruises = l - rise - fall > NEGLIGIBLE * l;
    if (rise > 0 && (fall > 0 || cruises)) count++;
    if (fall > 0 && cruises) count++;
  }
  return count;
}
