/**
 * Corner speeds by junction deviation: how fast a polyline's vertices may be passed.
 *
 * Source: Sungeun K. Jeon (2011), as used in Grbl: pretend that the corner is a circle of radius R
 * that is tangent to both segments and passes the vertex at distance δ; then v² = A R. The second
 * bound, the circle tangent at half the shorter segment, is Klipper's: without it a finely sampled
 * curve is taken at any speed, since φ goes to 0 as the segments shrink.
 *
 *   u0, u1   unit directions in and out      φ   turn angle, cos φ = u0·u1 (0 straight on, π back)
 *   δ        deviation, mm                   A   acceleration, mm/s²
 *   ℓ        shorter of the two segments, mm
 *
 *                    u1 /          with c = cos(φ/2), s = sin(φ/2):
 *                      /             R = δ c / (1 − c) = δ c (1 + c) / s²
 *       u0           ,'              v² ≤ A R,  v² ≤ A (ℓ/2) c / s
 *     ------------·´ φ
 *
 * s and c come from |u1 − u0| = 2 s and |u1 + u0| = 2 c, which keeps full precision for the tiny turns
 * of dense curves, where 1 − cos φ would cancel. No trigonometry, no NaN: straight on gives no
 * limit and a reversal a full stop.
 */
import type { RunPath } from "./run-path.js";

/** Below this sin²(φ/2) a vertex is straight: no limit that a speed limit would not undercut. */
const STRAIGHT = 1e-24;

/** cos²(φ/2) of a turn of 1 rad: a sharper one is a corner, not a sample of a curve. */
const CURVE = Math.cos(0.5) ** 2;

/**
 * Fills `path.v2` with the largest speed² at every vertex (the ends are at rest), and lowers `path.cap2`.
 *
 * Where the tangent circle is what limits both ends of a segment, and both turn the same way, the segment
 * is a chord of a curve and that curve's speed holds inside it too: else the pen would speed up and brake
 * on every chord.
 */
export function limitJunctions(path: RunPath, accel: number, deviation: number): void {
  const { segmentCount: n, length, ux, uy, v2, cap2 } = path;
  const accelDeviation = accel * deviation;
  const halfAccel = accel / 2;
  // The tangent limit of the vertex before, signed by its turn, where it is a curve's; else 0.
  let curveBefore = 0;
  v2[0] = 0;
  for (let i = 1; i < n; i++) {
    const x0 = ux[i - 1]!;
    const y0 = uy[i - 1]!;
    const x1 = ux[i]!;
    const y1 = uy[i]!;
    const s2 = ((x1 - x0) * (x1 - x0) + (y1 - y0) * (y1 - y0)) / 4;
    let limit = cap2[i - 1]! < cap2[i]! ? cap2[i - 1]! : cap2[i]!;
    let curve = 0;
    if (s2 > STRAIGHT) {
      const c2 = ((x1 + x0) * (x1 + x0) + (y1 + y0) * (y1 + y0)) / 4;
      const c = Math.sqrt(c2);
      const deviationLimit = (accelDeviation * c * (1 + c)) / s2;
      if (deviationLimit < limit) limit = deviationLimit;
      const shorter = length[i - 1]! < length[i]! ? length[i - 1]! : length[i]!;
      const tangentLimit = (halfAccel * shorter * c) / Math.sqrt(s2);
      if (tangentLimit < limit) {
        limit = tangentLimit;
        if (c2 > CURVE) curve = x0 * y1 - y0 * x1 > 0 ? limit : -limit;
      }
    }
    v2[i] = limit;
    if (curve * curveBefore > 0) cap2[i - 1] = Math.max(Math.abs(curve), Math.abs(curveBefore));
    curveBefore = curve;
  }
  v2[n] = 0;
}
