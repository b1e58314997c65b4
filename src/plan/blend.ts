/**
 * Corner curves: every corner of the soft line (soft-line.ts) is one parabola, the motion under one constant
 * acceleration vector, which is also exactly one command to the board. Velocity is continuous everywhere,
 * |a| ≤ A truly, |v| ≤ V, and the line stays within δ of the drawing.
 *
 * Source: parabolic blends as in Oquam and Romi's planners; the two passes over entry and exit speeds, which
 * let the pen change its speed inside dense curves too, are ours.
 *
 *               u1 /      φ       turn angle; s = sin(φ/2)
 *                 /       L       longest tangent: min(2 room / s, half of the shorter segment), mm
 *        L1 →   ,´        v0, v1  speed where the curve begins and ends, mm/s
 *     u0      ,´          q       |v1 u1 − v0 u0|, mm/s
 *    -----·-´ corner      e       distance of corner and curve, at most L s / 2 ≤ room
 *        L0
 *
 * From v0 u0 to v1 u1 under |a| = A takes q/A; the curve is the quadratic Bézier with tangents L0 = v0 q/2A ≤ L and
 * L1 = v1 q/2A ≤ L. For v0 = v1 that is v² ≤ A L / s, the corner speed vc, and both speeds are kept ≤ vc. What the
 * tangents leave of a segment of length l is straight, and there v² changes by at most 2 A a mm. From a corner to the next
 * one (its values marked ') that reads
 *
 *     braking      v1² + v1 q ≤ v0'² − v0' q' + 2 A l
 *     speeding up  v0'² + v0' q' ≤ v1² − v1 q + 2 A l
 *
 * One backward and one forward pass (as in look-ahead.ts) take every corner as fast as that allows, which
 * corner-speeds.ts works out. Where the forward pass has to slow a corner down it has been sped up to from the one before,
 * which then can brake for it: v1 q + v0' q' ≤ 2 A l, since no tangent is longer than half of its segment.
 *
 * |v| ≤ V and the motors' limits hold inside a curve because velocity runs straight from v0 u0 to v1 u1 in it,
 * and both limits are convex.
 */
import type { BlockColumns } from "./block-columns.js";
import { CornerSpeeds } from "./corner-speeds.js";
import { capSegments, type RunLimits } from "./limits.js";
import type { RunPath } from "./run-path.js";
import { SoftLine } from "./soft-line.js";
import { writeStraight, type Straight } from "./straight.js";

/** Below this sin(φ/2) the way goes straight on: there is nothing to round. */
const STRAIGHT = 1e-12;

/** Above this sin(φ/2) a curve is no longer than A needs: speed dips to cos(φ/2) in the middle of it. */
const SHARP = 0.35;

/** A straight piece shorter than this, in mm, is what rounding left between two curves. */
const NO_PIECE = 1e-10;

export class BlendPlanner {
  /** L of each vertex, mm; 0 at the ends and where the way goes straight on. */
  private tangent = new Float64Array(0);
  /** s of each vertex, 0 where the way goes straight on. */
  private sine = new Float64Array(0);
  /** Largest speed at each vertex, mm/s. */
  private limit = new Float64Array(0);
  /** (mm/s)²: how much v1² + v1 q may be at each vertex, for braking. */
  private behind = new Float64Array(0);
  /** Speeds where each vertex's curve begins and ends, and its q, mm/s. */
  private vIn = new Float64Array(0);
  private vOut = new Float64Array(0);
  private change = new Float64Array(0);
  private readonly line = new SoftLine();
  private readonly corner = new CornerSpeeds();
  private readonly straight: Straight = { x: 0, y: 0, ux: 0, uy: 0, alongMm: 0, alongPerMm: 1, length: 0 };

  /** Writes one run from rest to rest. */
  write(path: RunPath, limits: RunLimits, out: BlockColumns): void {
    const n = path.segmentCount;
    if (n === 1) return this.writeSingle(path, limits, out);
    this.reserve(n + 1);
    const line = this.line.of(path, limits);
    this.roundCorners(line, limits.accel);
    this.lookAhead(line, limits.accel);
    out.reserve(2 * n, n);
    this.writeBlocks(line, limits, out);
  }

  /** One straight from rest to rest has no corner: what the steps of `write` would leave of it, without them. */
  private writeSingle(path: RunPath, limits: RunLimits, out: BlockColumns): void {
    const { x, y, ux, uy, length, cap2, startAlong } = path;
    capSegments(path, limits);
    out.reserve(2, 1);
    const l = length[0]!;
    if (!(l > NO_PIECE)) return;
    const { straight } = this;
    straight.x = x[0]!;
    straight.y = y[0]!;
    straight.ux = ux[0]!;
    straight.uy = uy[0]!;
    straight.alongMm = startAlong;
    straight.alongPerMm = 1;
    straight.length = l;
    writeStraight(straight, 0, 0, Math.sqrt(cap2[0]!), limits.accel, limits.floorS, out);
  }

  /** Geometry first: how far each corner's curve may reach, and how fast it may be taken. */
  private roundCorners(path: RunPath, accel: number): void {
    const { segmentCount: n, length, ux, uy, cap2 } = path;
    const { tangent, sine, limit } = this;
    const { room } = this.line;
    tangent[0] = tangent[n] = 0;
    sine[0] = sine[n] = 0;
    limit[0] = limit[n] = 0;
    for (let i = 1; i < n; i++) {
      const dx = ux[i]! - ux[i - 1]!;
      const dy = uy[i]! - uy[i - 1]!;
      const s = Math.sqrt(dx * dx + dy * dy) / 2;
      let v2 = Math.min(cap2[i - 1]!, cap2[i]!);
      let reach = 0;
      if (s > STRAIGHT) {
        reach = Math.min((2 * room[i]!) / s, Math.min(length[i - 1]!, length[i]!) / 2);
        v2 = Math.min(v2, (accel * reach) / s);
      }
      tangent[i] = reach;
      sine[i] = s > STRAIGHT ? s : 0;
      limit[i] = Math.sqrt(v2);
    }
  }

  /** Speed second: the greatest speeds that straights and curves can connect. */
  private lookAhead(path: RunPath, accel: number): void {
    const { segmentCount: n, length } = path;
    const { tangent, sine, limit, behind, vIn, vOut, change, corner } = this;
    const twoA = 2 * accel;
    vIn[0] = vOut[0] = change[0] = 0;
    vIn[n] = vOut[n] = change[n] = 0;
    let left = 0;
    for (let i = n - 1; i > 0; i--) {
      behind[i] = left + twoA * length[i]!;
      corner.solve(sine[i]!, twoA * tangent[i]!, limit[i]!, Infinity, behind[i]!);
      vIn[i] = corner.v0;
      vOut[i] = corner.v1;
      change[i] = corner.change;
      left = corner.v0 * (corner.v0 - corner.change);
    }
    left = 0;
    for (let i = 1; i < n; i++) {
      const before = left + twoA * length[i - 1]!;
      if (vIn[i]! * (vIn[i]! + change[i]!) > before) {
        corner.solve(sine[i]!, twoA * tangent[i]!, limit[i]!, before, behind[i]!);
        vIn[i] = corner.v0;
        vOut[i] = corner.v1;
        change[i] = corner.change;
      }
      left = vOut[i]! * (vOut[i]! - change[i]!);
    }
  }

  /** Pieces last: one parabola a corner, a trapezoid on each straight between. */
  private writeBlocks(path: RunPath, { accel, floorS }: RunLimits, out: BlockColumns): void {
    const { segmentCount: n, x, y, ux, uy, length, cap2 } = path;
    const { vIn, vOut, straight } = this;
    const { along: stands } = this.line;
    let along = path.startAlong;
    let used = 0;
    for (let i = 0; i < n; i++) {
      const v0 = vIn[i + 1]!;
      const v1 = vOut[i + 1]!;
      const tau = this.halfTime(i + 1, n, accel);
      const ex = ux[i]!;
      const ey = uy[i]!;
      const perMm = stands[i]! / length[i]!;
      straight.length = length[i]! - used - v0 * tau;
      if (straight.length > NO_PIECE) {
        straight.x = x[i]! + ex * used;
        straight.y = y[i]! + ey * used;
        straight.ux = ex;
        straight.uy = ey;
        straight.alongMm = along + used * perMm;
        straight.alongPerMm = perMm;
        writeStraight(straight, vOut[i]!, v0, Math.sqrt(cap2[i]!), accel, floorS, out);
      }
      along += stands[i]!;
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
        along - v0 * tau * perMm,
      );
    }
  }

  /**
   * Half of the time that the curve at a vertex takes, s: q/2A. Where speed is the same all the way from the corner before to
   * the one after it takes no longer if it is long and soft instead; unless it is sharp.
   */
  private halfTime(i: number, n: number, accel: number): number {
    const { tangent, sine, vIn, vOut, change } = this;
    const v = vIn[i]!;
    const isSteady = i < n && vOut[i] === v && vOut[i - 1] === v && vIn[i + 1] === v;
    if (isSteady && v > 0 && sine[i]! < SHARP) return tangent[i]! / v;
    return change[i]! / (2 * accel);
  }

  private reserve(points: number): void {
    if (this.tangent.length >= points) return;
    const size = Math.max(points, 2 * this.tangent.length);
    this.tangent = new Float64Array(size);
    this.sine = new Float64Array(size);
    this.limit = new Float64Array(size);
    this.behind = new Float64Array(size);
    this.vIn = new Float64Array(size);
    this.vOut = new Float64Array(size);
    this.change = new Float64Array(size);
  }
}
