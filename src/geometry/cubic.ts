/**
 * Flattens cubic Bézier curves to polylines within a tolerance in mm.
 *
 * Method: if the curve's acceleration B″ is roughly uniform, split the curve at n equal steps of t; if not,
 * halve it first. Both tests are bounds, not samples, so every curve stays within the tolerance.
 *
 *        p1 ·-------· p2           d1, d2  signed distance of p1, p2 from the chord p0 p3
 *          /         \             s1, s2  how far along the chord they lie, 0 … L
 *      d1 /           \ d2         a0, a1  second differences p0 − 2p1 + p2 and p1 − 2p2 + p3;
 *        /             \                   B″ runs linearly from 6 a0 to 6 a1
 *   p0 ·-----------------· p3
 *
 * Flat test: with s1, s2 inside 0 … L the curve runs along the chord from end to end and is at most
 * (3/4) max(|d1|, |d2|) away from it, or (4/9) max(|d1|, |d2|) when p1 and p2 lie on opposite sides
 * (maximum of 3t(1−t)² d1 + 3t²(1−t) d2). A straight line written as a curve stays one segment.
 *
 * Step count: a chord over a step h of t is within h²/8 · max|B″| of the curve (linear interpolation
 * error), so n = ⌈√(6/8 · max(|a0|, |a1|) / tolerance)⌉ equal steps suffice (Wang, Wu, Chen 1984).
 *
 * Invariants: max gap between curve and chords ≤ tolerance, up to MAX_STEPS; the last point is
 * p3 exactly; at most 2n + 1 points; the only allocation is the buffer's growth.
 */
import type { PointBuffer } from "./growable.js";

/** More than any paper needs: 65 536 steps keep 1 µm on a curve with control points 5 km apart. */
const MAX_STEPS = 65_536;
/** A curve is halved at most this often. */
const MAX_DEPTH = 16;
/** If the accelerations at the two ends differ by more than this factor, equal steps are wasteful. */
const UNEVEN = 3;

/**
 * Appends the points of the curve p0 p1 p2 p3 after p0, up to and including p3 (p0 itself is not written).
 * Coordinates and `tolerance` in the same unit, usually mm; tolerance > 0. `depth`: how often the curve has been
 * halved already.
 */
export function flattenCubic(
  out: PointBuffer,
  x0: number,
  y0: number,
  x1: number,
  y1: number,
  x2: number,
  y2: number,
  x3: number,
  y3: number,
  tolerance: number,
  depth = 0,
): void {
  if (!(tolerance > 0)) throw new RangeError(`flattenCubic: tolerance must be > 0, got ${tolerance}`);
  if (isFlat(x0, y0, x1, y1, x2, y2, x3, y3, tolerance)) return out.push(x3, y3);
  // Second differences at both ends.
  const ax = x0 - 2 * x1 + x2;
  const ay = y0 - 2 * y1 + y2;
  const bx = x1 - 2 * x2 + x3;
  const by = y1 - 2 * y2 + y3;
  const n = stepCount(Math.max(Math.hypot(ax, ay), Math.hypot(bx, by)), tolerance);
  const canHalve = n > 2 && n < MAX_STEPS && depth < MAX_DEPTH;
  if (canHalve && isUneven(ax, ay, bx, by)) {
    // de Casteljau at t = 1/2.
    const x01 = (x0 + x1) / 2;
    const y01 = (y0 + y1) / 2;
    const x12 = (x1 + x2) / 2;
    const y12 = (y1 + y2) / 2;
    const x23 = (x2 + x3) / 2;
    const y23 = (y2 + y3) / 2;
    const x012 = (x01 + x12) / 2;
    const y012 = (y01 + y12) / 2;
    const x123 = (x12 + x23) / 2;
    const y123 = (y12 + y23) / 2;
    const xm = (x012 + x123) / 2;
    const ym = (y012 + y123) / 2;
    flattenCubic(out, x0, y0, x01, y01, x012, y012, xm, ym, tolerance, depth + 1);
    flattenCubic(out, xm, ym, x123, y123, x23, y23, x3, y3, tolerance, depth + 1);
    return;
  }
  // The curve at t = 1/n, 2/n, … from its power form, and p3 unchanged.
  const vx = 3 * (x1 - x0);
  const vy = 3 * (y1 - y0);
  const jx = x3 - x0 - vx - 3 * ax;
  const jy = y3 - y0 - vy - 3 * ay;
  out.reserve(n);
  for (let i = 1; i < n; i++) {
    const t = i / n;
    out.push(x0 + t * (vx + t * (3 * ax + t * jx)), y0 + t * (vy + t * (3 * ay + t * jy)));
  }
  out.push(x3, y3);
}

/** Whether the chord is within the tolerance of the curve. */
function isFlat(
  x0: number,
  y0: number,
  x1: number,
  y1: number,
  x2: number,
  y2: number,
  x3: number,
  y3: number,
  tolerance: number,
): boolean {
  const cx = x3 - x0;
  const cy = y3 - y0;
  const chord2 = cx * cx + cy * cy;
  const s1 = (x1 - x0) * cx + (y1 - y0) * cy;
  const s2 = (x2 - x0) * cx + (y2 - y0) * cy;
  if (!(chord2 > 0 && s1 >= 0 && s2 >= 0 && s1 <= chord2 && s2 <= chord2)) return false;
  const d1 = (x1 - x0) * cy - (y1 - y0) * cx;
  const d2 = (x2 - x0) * cy - (y2 - y0) * cx;
  const factor = d1 * d2 >= 0 ? 3 / 4 : 4 / 9;
  const gap = factor * Math.max(Math.abs(d1), Math.abs(d2));
  return gap * gap <= tolerance * tolerance * chord2;
}

/** Number of equal steps of t needed for the tolerance, with this largest second difference. */
function stepCount(difference: number, tolerance: number): number {
  const n = Math.ceil(Math.sqrt((0.75 * difference) / tolerance));
  return n >= 1 ? Math.min(n, MAX_STEPS) : 1;
}

/** Whether the second differences (ax, ay) and (bx, by) are too different for equal steps. */
function isUneven(ax: number, ay: number, bx: number, by: number): boolean {
  const a2 = ax * ax + ay * ay;
  const b2 = bx * bx + by * by;
  const limit = UNEVEN * UNEVEN;
  // Opposite accelerations mean an inflection: after halving, the flat middle can become one chord.
  return a2 > limit * b2 || b2 > limit * a2 || ax * bx + ay * by < 0;
}
