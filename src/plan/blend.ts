/**
 * Corner curves: every corner of the softened polyline (soft-line.ts) becomes one parabola. A parabola is the
 * motion under one constant acceleration vector, and also exactly one command to the board. Velocity is
 * continuous, the acceleration vector obeys |a| ≤ A, |v| ≤ V, and the path stays within δ of the drawing.
 *
 * Source: parabolic blends as in Oquam and in Romi's planners. They use one speed per corner. Here each corner
 * has an entry and an exit speed, so the pen can change its speed inside dense curves too.
 *
 *               u1 /      φ       turn angle; s = sin(φ/2)
 *                 /       L       longest tangent: min(2 room / s, half the shorter segment), mm
 *        L1 →   ,´        v0, v1  speed at the start and end of the curve, mm/s
 *     u0      ,´          q       |v1 u1 − v0 u0|, mm/s
 *    -----·-´ corner      e       distance from corner to curve, at most L s / 2 ≤ room
 *        L0
 *
 * Going from v0 u0 to v1 u1 under |a| = A takes q/A. The curve is the quadratic Bézier with tangents L0 = v0
 * q/2A ≤ L and L1 = v1 q/2A ≤ L. For v0 = v1 this means v² ≤ A L / s, the corner speed vc; both speeds stay ≤
 * vc. The part of a segment between two tangents is straight, and v² changes there by at most 2 A per mm.
 * From one corner (values marked ') to the next, with a segment of length l:
 *
 *     braking      v1² + v1 q ≤ v0'² − v0' q' + 2 A l
 *     speeding up  v0'² + v0' q' ≤ v1² − v1 q + 2 A l
 *
 * One backward and one forward pass (as in junction.ts) find the highest speeds within these limits;
 * corner-speeds.ts solves one corner. If the forward pass slows a corner down, the pen accelerates all the way
 * to it from the previous corner. The braking condition between the two still holds: it becomes
 * v1 q + v0' q' ≤ 2 A l, which is true because no tangent is longer than half its segment.
 *
 * |v| ≤ V and the motor limits hold inside a curve, because the velocity changes linearly from v0 u0 to v1 u1
 * and both limits are convex.
 */
import type { BlockColumns } from "./block-columns.js";
import { CornerSpeeds } from "./corner-speeds.js";
import type { RunLimits } from "./limits.js";
import type { RunPath } from "./run-path.js";
import { SoftLine } from "./soft-line.js";
import { newStraight, writeStraight } from "./trapezoid.js";

/** Below this sin(φ/2) the path is straight and there is nothing to round. */
const STRAIGHT = 1e-12;

/** Above this sin(φ/2) a curve is only as long as A requires, because the speed in its middle is only v cos(φ/2). */
const SHARP = 0.35;

/** A shorter straight between two curves is a rounding error, mm. */
const SHORTEST_STRAIGHT_MM = 1e-10;

export class BlendPlanner {
  private readonly line = new SoftLine();
  private readonly corners = new CornerSpeeds();

  /** Writes one run from rest to rest. */
  write(path: RunPath, limits: RunLimits, out: BlockColumns): void {
    const n = path.segmentCount;
    this.corners.reserve(n + 1);
    const line = this.line.of(path, limits);
    this.roundCorners(line, limits.accel);
    this.lookAhead(line, limits.accel);
    this.writeBlocks(line, limits, out);
  }

  /** Step 1, geometry: how far each corner's curve may reach, and the highest speed through it. */
  private roundCorners(path: RunPath, accel: number): void {
    const { segmentCount: n, length, ux, uy, cap2 } = path;
    const { tangent, sine, maxSpeed } = this.corners;
    const { line } = this;
    tangent[0] = tangent[n] = 0;
    sine[0] = sine[n] = 0;
    maxSpeed[0] = maxSpeed[n] = 0;
    for (let i = 1; i < n; i++) {
      const bx = ux[i] - ux[i - 1];
      const by = uy[i] - uy[i - 1];
      const s = Math.sqrt(bx * bx + by * by) / 2;
      const cap = Math.min(cap2[i - 1], cap2[i]);
      if (s > STRAIGHT) {
        const half = Math.min(length[i - 1], length[i]) / 2;
        tangent[i] = line.reach(i, bx, by, s, half);
        sine[i] = s;
        maxSpeed[i] = Math.sqrt(Math.min(cap, (accel * tangent[i]) / s));
      } else {
        tangent[i] = sine[i] = 0;
        maxSpeed[i] = Math.sqrt(cap);
      }
    }
  }

  /** Step 2, speed: the highest speeds that the straights and curves between corners can connect. */
  private lookAhead(path: RunPath, accel: number): void {
    const { segmentCount: n, length } = path;
    const { corners } = this;
    const { vIn, vOut, change } = corners;
    const twoA = 2 * accel;
    vIn[0] = vOut[0] = change[0] = 0;
    vIn[n] = vOut[n] = change[n] = 0;
    let left = 0;
    for (let i = n - 1; i > 0; i--) {
      // No limit from before the corner is known yet.
      corners.solve(i, Infinity, left + twoA * length[i], accel);
      left = vIn[i] * (vIn[i] - change[i]);
    }
    left = 0;
    for (let i = 1; i < n; i++) {
      const ahead = left + twoA * length[i - 1];
      if (vIn[i] * (vIn[i] + change[i]) > ahead) {
        const behind = vIn[i + 1] * (vIn[i + 1] - change[i + 1]) + twoA * length[i];
        corners.solve(i, ahead, behind, accel);
      }
      left = vOut[i] * (vOut[i] - change[i]);
    }
  }

  /** Step 3, blocks: one parabola per corner, and a trapezoid on each straight between them. */
  private writeBlocks(path: RunPath, { accel }: RunLimits, out: BlockColumns): void {
    const { segmentCount: n, x, y, ux, uy, length, drawn, cap2 } = path;
    const { tangent, sine, vIn, vOut, change } = this.corners;
    const straight = newStraight();
    let along = path.startAlong;
    // mm of the segment used by the curve of the previous corner.
    let used = 0;
    for (let i = 0; i < n; i++) {
      const v0 = vOut[i];
      const v1 = vIn[i + 1];
      const after = vOut[i + 1];
      const perMm = drawn[i] / length[i];
      // Half the duration of the corner's curve: q/2A. At constant speed a longer, softer curve takes no more
      // time, so use the full tangent. Sharp corners are excluded, because the pen is slower in their middle.
      const isSteady = v1 === v0 && v1 === after && v1 > 0 && i + 1 < n && vIn[i + 2] === v1;
      const tau = isSteady && sine[i + 1] < SHARP ? tangent[i + 1] / v1 : change[i + 1] / (2 * accel);
      const rest = length[i] - used - v1 * tau;
      if (rest > SHORTEST_STRAIGHT_MM) {
        straight.x = x[i] + ux[i] * used;
        straight.y = y[i] + uy[i] * used;
        straight.ux = ux[i];
        straight.uy = uy[i];
        straight.length = rest;
        straight.v0 = v0;
        straight.v1 = v1;
        straight.cap2 = cap2[i];
        straight.alongMm = along + used * perMm;
        straight.alongPerMm = perMm;
        writeStraight(straight, accel, out);
      }
      along += drawn[i];
      used = after * tau;
      if (tau === 0) continue;
      const wx = ux[i] * v1;
      const wy = uy[i] * v1;
      const k = out.add(2 * tau);
      out.x[k] = x[i + 1] - wx * tau;
      out.y[k] = y[i + 1] - wy * tau;
      out.vx[k] = wx;
      out.vy[k] = wy;
      out.ax[k] = (ux[i + 1] * after - wx) / (2 * tau);
      out.ay[k] = (uy[i + 1] * after - wy) / (2 * tau);
      out.alongMm[k] = along - v1 * tau * perMm;
    }
  }
}
