/**
 * Corner curves: every corner is one parabola, the motion under one constant acceleration vector, which is
 * also exactly one command to the board. Velocity is continuous everywhere, |a| ≤ A truly, |v| ≤ V,
 * and the line stays within δ of the drawing.
 *
 * Source: parabolic blends as in Oquam and Romi's planners; the two passes over entry and exit speeds, which
 * let the pen change its speed inside dense curves too, are ours.
 *
 *               u1 /      φ       turn angle; s = sin(φ/2), c = cos φ = u0·u1
 *                 /       L       longest tangent: min(2 δ / s, half of the shorter segment), mm
 *        L1 →   ,´        v0, v1  speed where the curve begins and ends, mm/s
 *     u0      ,´          τ       half the time that the curve takes, s
 *    -----·-´ corner      e       distance of corner and curve, at most L s / 2 ≤ δ
 *        L0
 *
 * From v0 u0 to v1 u1 in time 2 τ under constant acceleration:  a = (v1 u1 − v0 u0) / 2 τ, and the curve is the
 * quadratic Bézier with tangents L0 = v0 τ, L1 = v1 τ. The longer one may be L, so τ = L / max(v0, v1), and
 * |a| ≤ A reads, with w = max and v = min of the two speeds,
 *
 *     w² (w² + v² − 2 c v w) ≤ 4 L² A²                     (1)
 *
 * For v = w that is v² ≤ A L / s, the corner speed vc: the time-optimal way round a lone corner, since
 * |a| = A throughout. Both speeds are kept ≤ vc; then the fastest w for a given v never falls when v rises, so one
 * backward and one forward pass (as in look-ahead.ts) find the greatest speeds that satisfy (1) at
 * every corner and v² ≤ v² + 2 A d on every straight piece between.
 *
 * |v| ≤ V and the motors' limits hold inside a curve because velocity runs straight from v0 u0 to v1 u1 in it,
 * and both limits are convex.
 */
import type { BlockColumns } from "./block-columns.js";
import { capSegments, type RunLimits } from "./limits.js";
import type { RunPath } from "./run-path.js";
import { writeStraight, type Straight } from "./straight.js";

/** Below this sin²(φ/2) the way goes straight on: there is nothing to round. */
const STRAIGHT = 1e-24;

/**
 * cos φ of a turn so sharp that the curve is made no longer than A needs when V keeps the pen slower than vc:
 * speed dips to cos(φ/2) in the middle of a curve. Gentler turns stay long and soft, as in a dense curve.
 */
const SHARP = 0.755;

/** A straight piece shorter than this, in mm, is what rounding left between two curves. */
const NO_PIECE = 1e-10;

export class BlendPlanner {
  /** L of each vertex, mm; 0 at the ends and where the way goes straight on. */
  private tangent = new Float64Array(0);
  /** cos φ of each vertex. */
  private cosine = new Float64Array(0);
  /** Largest speed at each vertex, mm/s. */
  private limit = new Float64Array(0);
  /** Speeds where each vertex's curve begins and ends, mm/s. */
  private vIn = new Float64Array(0);
  private vOut = new Float64Array(0);
  private readonly straight: Straight = { x: 0, y: 0, ux: 0, uy: 0, alongMm: 0, length: 0 };

  /** Writes one run from rest to rest. */
  write(path: RunPath, limits: RunLimits, out: BlockColumns): void {
    const n = path.segmentCount;
    this.reserve(n + 1);
    capSegments(path, limits);
    this.roundCorners(path, limits);
    this.lookAhead(path, limits.accel);
    out.reserve(2 * n, n);
    this.writeBlocks(path, limits, out);
  }

  /** Geometry first: how far each corner's curve may reach, and how fast it may be taken. */
  private roundCorners(path: RunPath, limits: RunLimits): void {
    const { segmentCount: n, length, ux, uy, cap2 } = path;
    const { tangent, cosine, limit } = this;
    tangent[0] = tangent[n] = 0;
    cosine[0] = cosine[n] = 1;
    limit[0] = limit[n] = 0;
    for (let i = 1; i < n; i++) {
      const dx = ux[i]! - ux[i - 1]!;
      const dy = uy[i]! - uy[i - 1]!;
      const s2 = (dx * dx + dy * dy) / 4;
      let v2 = cap2[i]! < cap2[i - 1]! ? cap2[i]! : cap2[i - 1]!;
      let reach = 0;
      if (s2 > STRAIGHT) {
        const s = Math.sqrt(s2);
        const half = (length[i - 1]! < length[i]! ? length[i - 1]! : length[i]!) / 2;
        reach = (2 * limits.corner) / s < half ? (2 * limits.corner) / s : half;
        const curve2 = (limits.accel * reach) / s;
        if (curve2 < v2) v2 = curve2;
      }
      tangent[i] = reach;
      cosine[i] = 1 - 2 * s2;
      limit[i] = Math.sqrt(v2);
    }
  }

  /** Speed second: the greatest speeds that straights and curves can connect. */
  private lookAhead(path: RunPath, accel: number): void {
    const { segmentCount: n, length } = path;
    const { tangent, cosine, limit, vIn, vOut } = this;
    vIn[n] = vOut[n] = 0;
    for (let i = n - 1; i > 0; i--) {
      const next = vIn[i + 1]!;
      const straight = length[i]! - tangent[i]! - tangent[i + 1]!;
      const reached = straight > 0 ? Math.sqrt(next * next + 2 * accel * straight) : next;
      const v = reached < limit[i]! ? reached : limit[i]!;
      vOut[i] = v;
      vIn[i] = fastestAcross(v, limit[i]!, cosine[i]!, tangent[i]! * accel);
    }
    vIn[0] = vOut[0] = 0;
    for (let i = 1; i <= n; i++) {
      const before = vOut[i - 1]!;
      const straight = length[i - 1]! - tangent[i - 1]! - tangent[i]!;
      const reached = straight > 0 ? Math.sqrt(before * before + 2 * accel * straight) : before;
      if (reached < vIn[i]!) vIn[i] = reached;
      if (i === n || vOut[i]! <= vIn[i]!) continue;
      const across = fastestAcross(vIn[i]!, limit[i]!, cosine[i]!, tangent[i]! * accel);
      if (across < vOut[i]!) vOut[i] = across;
    }
  }

  /** Pieces last: one parabola a corner, a trapezoid on each straight between. */
  private writeBlocks(path: RunPath, { accel, floorS }: RunLimits, out: BlockColumns): void {
    const { segmentCount: n, x, y, ux, uy, length, cap2 } = path;
    const { tangent, cosine, vIn, vOut, straight } = this;
    let along = path.startAlong;
    let used = 0;
    for (let i = 0; i < n; i++) {
      const v0 = vIn[i + 1]!;
      const v1 = vOut[i + 1]!;
      let tau = tangent[i + 1]! > 0 ? tangent[i + 1]! / (v0 > v1 ? v0 : v1) : 0;
      if (cosine[i + 1]! < SHARP) {
        const change2 = v0 * v0 + v1 * v1 - 2 * v0 * v1 * cosine[i + 1]!;
        tau = Math.min(tau, Math.sqrt(change2) / (2 * accel));
      }
      const ex = ux[i]!;
      const ey = uy[i]!;
      straight.length = length[i]! - used - v0 * tau;
      if (straight.length > NO_PIECE) {
        straight.x = x[i]! + ex * used;
        straight.y = y[i]! + ey * used;
        straight.ux = ex;
        straight.uy = ey;
        straight.alongMm = along + used;
        writeStraight(straight, vOut[i]!, v0, Math.sqrt(cap2[i]!), accel, floorS, out);
      }
      along += length[i]!;
      used = v1 * tau;
      if (tau === 0) continue;
      out.push(
        2 * tau,
        x[i + 1]! - ex * v0 * tau,
        y[i + 1]! - ey * v0 * tau,
        ex * v0,
        ey * v0,
        (ux[i + 1]! * v1 - ex * v0) / (2 * tau),
        (uy[i + 1]! * v1 - ey * v0) / (2 * tau),
        along - v0 * tau,
      );
    }
  }

  private reserve(points: number): void {
    if (this.tangent.length >= points) return;
    const size = Math.max(points, 2 * this.tangent.length);
    this.tangent = new Float64Array(size);
    this.cosine = new Float64Array(size);
    this.limit = new Float64Array(size);
    this.vIn = new Float64Array(size);
    this.vOut = new Float64Array(size);
  }
}

/**
 * The greatest w in [v, limit] for which (1) holds, given the other speed v ≤ limit; `LA` is L A, mm²/s².
 * For c = 1 (1) reads w (w − v) ≤ 2 L A, whose root is never below the true one; from there Newton's steps fall
 * towards it without passing it, since the left side is convex in w.
 */
function fastestAcross(v: number, limit: number, c: number, LA: number): number {
  if (LA === 0) return v;
  const most = 4 * LA * LA;
  if (limit * limit * (limit * limit + v * v - 2 * c * v * limit) <= most) return limit;
  let w = (v + Math.sqrt(v * v + 8 * LA)) / 2;
  if (w > limit) w = limit;
  for (let i = 0; i < 50; i++) {
    const excess = w * w * (w * w + v * v - 2 * c * v * w) - most;
    const slope = 2 * w * (2 * w * w - 3 * c * v * w + v * v);
    const step = excess / slope;
    w -= step;
    if (!(step > 1e-13 * w)) break;
  }
  return w > v ? w : v;
}
