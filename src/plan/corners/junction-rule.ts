/**
 * Corner speeds of the mode `junction`, by junction deviation: the highest speed at each vertex of a polyline. The
 * velocity changes direction instantly there.
 *
 * Source: Sungeun K. Jeon (2011), as used in Grbl: replace the corner by a circle of radius R that is tangent
 * to both segments and passes the vertex at distance δ; then v² = A R. The second limit, the circle that is
 * tangent within the segments, is Klipper's. Without it a finely sampled curve would have no speed limit, since φ
 * goes to 0 as the segments shrink. Klipper's circle begins at half the shorter segment; here two vertices share
 * a segment as in `blend` (blend-rule.ts), so that uneven samples of a curve do not slow it.
 *
 *   u0, u1   unit directions before and after      φ   turn angle, cos φ = u0·u1 (0 straight on, π back)
 *   δ        deviation, mm                   A   acceleration, mm/s²
 *   L        share of the segments, mm
 *
 *                    u1 /          with c = cos(φ/2), s = sin(φ/2):
 *                      /             R = δ c / (1 − c) = δ c (1 + c) / s²
 *       u0           ,'              v² ≤ A R,  v² ≤ A L c / s
 *     ------------·´ φ
 *
 * s and c come from |u1 − u0| = 2 s and |u1 + u0| = 2 c. This keeps full precision for the tiny turns of
 * dense curves, where 1 − cos φ would cancel. A straight line has no limit; a reversal is a full stop.
 */
import { fillSines, shareOfSegments } from "./blend-rule.js";
import type { RunLimits } from "../limits.js";
import type { RunPath } from "../run-path.js";

/** cos²(φ/2) of a turn of 1 rad: anything sharper is a corner, not a sample of a curve. */
const CURVE = Math.cos(0.5) ** 2;

/**
 * Fills `path.v2` with the max speed² at every vertex (0 at both ends), and lowers `path.cap2`.
 *
 * A segment is a chord of a curve if the tangent circle limits both its ends and both turn in the same
 * direction. The curve's speed then applies inside the segment too; otherwise the pen would accelerate and
 * brake on every chord.
 */
export function limitJunctions(path: RunPath, { accel, corner }: RunLimits): void {
  const { segmentCount: n, ux, uy, v2, cap2, sine } = path;
  fillSines(path);
  path.tangent.fill(0, 0, n + 1);
  const accelDeviation = accel * corner;
  // The tangent limit of the previous vertex, signed by its turn direction, if it belongs to a curve;
  // otherwise 0.
  let curveBefore = 0;
  v2[0] = 0;
  for (let i = 1; i < n; i++) {
    const x0 = ux[i - 1];
    const y0 = uy[i - 1];
    const x1 = ux[i];
    const y1 = uy[i];
    const s = sine[i];
    let limit = cap2[i - 1] < cap2[i] ? cap2[i - 1] : cap2[i];
    let curve = 0;
    if (s > 0) {
      const c2 = ((x1 + x0) * (x1 + x0) + (y1 + y0) * (y1 + y0)) / 4;
      const c = Math.sqrt(c2);
      const deviationLimit = (accelDeviation * c * (1 + c)) / (s * s);
      if (deviationLimit < limit) limit = deviationLimit;
      const tangentLimit = (accel * shareOfSegments(path, i, corner) * c) / s;
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
  // No vertex is drawn as a curve.
  sine.fill(0, 0, n + 1);
}
