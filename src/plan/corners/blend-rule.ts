/**
 * Corner speeds of the modes `blend` and `scurve`: every corner of the polyline becomes one parabola. A parabola is
 * the motion under one constant acceleration vector, and also exactly one command to the board. Velocity is
 * continuous, the acceleration vector obeys |a| ≤ A, |v| ≤ V, and the path stays within δ of the polyline.
 *
 * Source: parabolic blends as in Oquam and in Romi's planners.
 *
 *   u0, u1   unit directions before and after      φ   turn angle; s = sin(φ/2) = |u1 − u0|/2
 *   δ        max distance of the curve from the corner, mm      v   speed at both ends of the curve, mm/s
 *   L        longest tangent, mm                                τ   half of the time in the curve, s
 *
 *               u1 /      The velocity changes from v u0 to v u1, by 2 v s. Under |a| = A this takes
 *                 /
 *          L    ,´            2 τ = 2 v s/A
 *     u0      ,´
 *    -----·-´ corner      The curve is the quadratic Bézier with tangents v τ = v² s/A. At its middle it passes
 *        L                the corner at v τ s/2. So tangents up to 2 δ/s keep within δ, and
 *
 *                             v² ≤ A L/s
 *
 * Two corners (s, s') share the segment between them, of length ℓ. At one speed they need it in the ratio s : s', so
 * each gets ℓ s/(s + s') of it, or what the other one cannot use. On a dense curve, whose segments change length
 * gradually, this makes v² = A/κ with κ the curvature, however the curve is sampled.
 *
 * |v| ≤ V and the motor limits hold inside a curve, because the velocity changes linearly from v u0 to v u1 and
 * both limits are convex.
 */
import type { RunLimits } from "../limits.js";
import type { RunPath } from "../run-path.js";

/** Below this s the path is straight and there is nothing to round. */
const STRAIGHT = 1e-12;

/** Fills `path.v2` with the max speed² at every corner (0 at both ends), and its `sine` and `tangent`. */
export function limitBlends(path: RunPath, { accel, corner }: RunLimits): void {
  const { segmentCount: n, cap2, v2, sine, tangent } = path;
  v2[0] = tangent[0] = 0;
  v2[n] = tangent[n] = 0;
  fillSines(path);
  for (let i = 1; i < n; i++) {
    const s = sine[i];
    v2[i] = Math.min(cap2[i - 1], cap2[i]);
    tangent[i] = 0;
    if (s === 0) continue;
    tangent[i] = Math.min((2 * corner) / s, shareOfSegments(path, i, corner));
    v2[i] = Math.min(v2[i], (accel * tangent[i]) / s);
  }
}

/** Fills `path.sine`; 0 at both ends and where the line is straight. */
export function fillSines({ segmentCount: n, ux, uy, sine }: RunPath): void {
  sine[0] = sine[n] = 0;
  for (let i = 1; i < n; i++) {
    const bx = ux[i] - ux[i - 1];
    const by = uy[i] - uy[i - 1];
    const s = Math.sqrt(bx * bx + by * by) / 2;
    sine[i] = s > STRAIGHT ? s : 0;
  }
}

/** mm that corner i may use of each segment beside it. */
export function shareOfSegments({ length, sine }: RunPath, i: number, corner: number): number {
  const before = partOf(length[i - 1], sine[i], sine[i - 1], corner);
  const after = partOf(length[i], sine[i], sine[i + 1], corner);
  return Math.min(before, after);
}

/** mm of a segment for the corner with sine `s`; the corner at the segment's other end has sine `other`. */
const partOf = (length: number, s: number, other: number, corner: number): number =>
  Math.max((length * s) / (s + other), length - (2 * corner) / other);
