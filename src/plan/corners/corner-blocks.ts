/**
 * Writes a run whose corners have their speeds: a trapezoid on each straight, and one parabola for each corner that
 * is a curve (blend-rule.ts). At a corner without a curve (junction-rule.ts) the velocity jumps.
 *
 *     ______·-´        · ends of the curve, v τ from the corner, with τ = v s/A
 *   straight  curve
 */
import type { BlockColumns } from "../block-columns.js";
import type { RunPath } from "../run-path.js";
import { newStraight, writeStraight } from "../trapezoid.js";

/** Above this sin(φ/2) a curve is only as long as A requires, because the speed in its middle is only v cos(φ/2). */
const SHARP = 0.35;

/** A shorter straight between two curves is a rounding error, mm. */
const SHORTEST_STRAIGHT_MM = 1e-10;

export function writeCornerBlocks(path: RunPath, accel: number, out: BlockColumns): void {
  const { segmentCount: n, x, y, ux, uy, length, drawn, cap2, v2, sine, tangent } = path;
  const straight = newStraight();
  let along = path.startAlong;
  // mm of the segment used by the curve of the previous corner.
  let used = 0;
  for (let i = 0; i < n; i++) {
    const v1 = Math.sqrt(v2[i + 1]);
    const s = sine[i + 1];
    const perMm = drawn[i] / length[i];
    // At constant speed a longer, softer curve takes no more time, so use the full tangent. Sharp corners are
    // excluded, because the pen is slower in their middle.
    const isSteady = v1 > 0 && v2[i] === v2[i + 1] && v2[i + 2] === v2[i + 1];
    const tau = isSteady && s < SHARP ? tangent[i + 1] / v1 : (v1 * s) / accel;
    const rest = length[i] - used - v1 * tau;
    if (rest > SHORTEST_STRAIGHT_MM) {
      straight.x = x[i] + ux[i] * used;
      straight.y = y[i] + uy[i] * used;
      straight.ux = ux[i];
      straight.uy = uy[i];
      straight.length = rest;
      straight.v0 = Math.sqrt(v2[i]);
      straight.v1 = v1;
      straight.cap2 = cap2[i];
      straight.alongMm = along + used * perMm;
      straight.alongPerMm = perMm;
      writeStraight(straight, accel, out);
    }
    along += drawn[i];
    used = v1 * tau;
    if (tau === 0) continue;
    const k = out.add(2 * tau);
    out.x[k] = x[i + 1] - ux[i] * used;
    out.y[k] = y[i + 1] - uy[i] * used;
    out.vx[k] = ux[i] * v1;
    out.vy[k] = uy[i] * v1;
    out.ax[k] = ((ux[i + 1] - ux[i]) * v1) / (2 * tau);
    out.ay[k] = ((uy[i + 1] - uy[i]) * v1) / (2 * tau);
    out.alongMm[k] = along - used * perMm;
  }
}
