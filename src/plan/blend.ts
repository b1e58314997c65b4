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
import { lesser } from "./branchless.js";
import { CornerSpeeds } from "./corner-speeds.js";
import type { RunLimits } from "./limits.js";
import type { RunPath } from "./run-path.js";
import { keepFloor, type Phases } from "./floor-phases.js";
import { SoftLine } from "./soft-line.js";
import { NEGLIGIBLE } from "./straight.js";

/** Below this sin(φ/2) the way goes straight on: there is nothing to round. */
const STRAIGHT = 1e-12;

/** Above this sin(φ/2) a curve is no longer than A needs: speed dips to cos(φ/2) in the middle of it. */
const SHARP = 0.35;

/** A straight piece shorter than this, in mm, is what rounding left between two curves. */
const NO_PIECE = 1e-10;

/** The shorter of segments not as long as this, mm, may be rounded in the other one's last place. */
const LONG = 1e5;

/**
 * Segments written at a time, for which there is room then; and how many blocks each of them makes at most. Few, so that V8 does not
 * enter compiled code in the middle of a long first call: such code boxes what the loop carries, and is kept.
 */
const SLICE = 256;
const MOST_BLOCKS = 4;

export class BlendPlanner {
  private readonly line = new SoftLine();
  private readonly corners = new CornerSpeeds();
  /** Filled anew for every straight. */
  private readonly phases: Phases = { peak: 0, rise: 0, fall: 0 };
  /** While blocks are written: mm of the drawing at the last point, and of the next segment that its corner takes. */
  private along = 0;
  private used = 0;

  /** Writes one run from rest to rest; one of a single straight is for `writeSingle`. */
  write(path: RunPath, limits: RunLimits, out: BlockColumns): void {
    const n = path.segmentCount;
    this.corners.reserve(n + 1);
    const line = this.line.of(path, limits);
    this.roundCorners(line, limits.accel);
    this.lookAhead(line, limits.accel);
    this.writeBlocks(line, limits, out);
  }

  /** Geometry first: how far each corner's curve may reach, and how fast it may be taken. */
  private roundCorners(path: RunPath, accel: number): void {
    const { segmentCount: n, length, ux, uy, cap2 } = path;
    const { tangent, sine, most } = this.corners;
    const { line } = this;
    tangent[0] = tangent[n] = 0;
    sine[0] = sine[n] = 0;
    most[0] = most[n] = 0;
    let x0 = ux[0]!;
    let y0 = uy[0]!;
    let before = length[0]!;
    let cap0 = cap2[0]!;
    for (let i = 1; i < n; i++) {
      const x1 = ux[i]!;
      const y1 = uy[i]!;
      const after = length[i]!;
      const cap1 = cap2[i]!;
      const bx = x1 - x0;
      const by = y1 - y0;
      const s = Math.sqrt(bx * bx + by * by) / 2;
      const cap = lesser(cap0, cap1);
      if (s > STRAIGHT) {
        const half = (before + after < LONG ? lesser(before, after) : Math.min(before, after)) / 2;
        const reach = line.reach(i, bx, by, s, half);
        tangent[i] = reach;
        sine[i] = s;
        most[i] = Math.sqrt(lesser(cap, (accel * reach) / s));
      } else {
        tangent[i] = sine[i] = 0;
        most[i] = Math.sqrt(cap);
      }
      x0 = x1;
      y0 = y1;
      before = after;
      cap0 = cap1;
    }
  }

  /** Speed second: the greatest speeds that straights and curves can connect. */
  private lookAhead(path: RunPath, accel: number): void {
    const { segmentCount: n, length } = path;
    const { corners } = this;
    const { sine, most, vIn, vOut, change } = corners;
    const twoA = 2 * accel;
    vIn[0] = vOut[0] = change[0] = 0;
    vIn[n] = vOut[n] = change[n] = 0;
    let left = 0;
    for (let i = n - 1; i > 0; i--) {
      // What `solve` does where nothing ahead is known yet, and nothing behind holds back.
      const v = most[i]!;
      const q = 2 * sine[i]! * v;
      const behind = left + twoA * length[i]!;
      if (v * (v + q) <= behind) {
        vIn[i] = vOut[i] = v;
        change[i] = q;
        left = v * (v - q);
      } else {
        corners.solve(i, Infinity, behind, accel);
        left = vIn[i]! * (vIn[i]! - change[i]!);
      }
    }
    left = 0;
    for (let i = 1; i < n; i++) {
      const ahead = left + twoA * length[i - 1]!;
      if (vIn[i]! * (vIn[i]! + change[i]!) > ahead) {
        const behind = vIn[i + 1]! * (vIn[i + 1]! - change[i + 1]!) + twoA * length[i]!;
        corners.solve(i, ahead, behind, accel);
      }
      left = vOut[i]! * (vOut[i]! - change[i]!);
    }
  }

  /** Pieces last: one parabola a corner, a trapezoid on each straight between. */
  private writeBlocks(path: RunPath, limits: RunLimits, out: BlockColumns): void {
    const { segmentCount: n } = path;
    this.along = path.startAlong;
    this.used = 0;
    for (let from = 0; from < n; from += SLICE) {
      const end = Math.min(n, from + SLICE);
      out.reserve(MOST_BLOCKS * (end - from), end - from);
      this.writeSlice(path, from, end, limits, out);
    }
  }

  /**
   * Segments [from, end), each with the corner after it. The straights are those of straight.ts, written here because a
   * call for each of them and for each of their blocks takes longer than what it does.
   */
  private writeSlice(
    path: RunPath,
    from: number,
    end: number,
    { accel, floorS }: RunLimits,
    out: BlockColumns,
  ): void {
    const { segmentCount: n, x, y, ux, uy, length, cap2 } = path;
    const { phases } = this;
    const { tangent, sine, vIn, vOut, change } = this.corners;
    const { along: stands } = this.line;
    const { durationS, x: bx, y: by, vx, vy, ax, ay, startS, alongMm } = out;
    const twoA = 2 * accel;
    const perTwoA = 1 / twoA;
    let k = out.count;
    let clock = out.clockS;
    let along = this.along;
    let used = this.used;
    let v0 = vOut[from]!;
    for (let i = from; i < end; i++) {
      const ex = ux[i]!;
      const ey = uy[i]!;
      const whole = length[i]!;
      const stand = stands[i]!;
      const perMm = stand / whole;
      const v1 = vIn[i + 1]!;
      const after = vOut[i + 1]!;
      // Half of the time that the corner's curve takes: q/2A. Where speed is the same all the way from the corner before to
      // the one after it takes no longer if it is long and soft instead; unless it is sharp.
      let tau = change[i + 1]! * perTwoA;
      if (v1 === v0 && v1 === after && v1 > 0 && i + 1 < n && vIn[i + 2] === v1 && sine[i + 1]! < SHARP) {
        tau = tangent[i + 1]! / v1;
      }
      const l = whole - used - v1 * tau;
      if (l > NO_PIECE) {
        const start2 = v0 * v0;
        const cap = cap2[i]!;
        let rise = 0;
        let fall = 0;
        let peak = v0;
        let cruises = true;
        // As fast as may be from end to end, mostly; else up and down again.
        if (v0 !== v1 || start2 < cap) {
          const end2 = v1 * v1;
          const peak2 = Math.min((start2 + end2) / 2 + accel * l, Math.max(cap, start2, end2));
          const least2 = NEGLIGIBLE * peak2;
          if (peak2 - start2 > least2) rise = (peak2 - start2) * perTwoA;
          if (peak2 - end2 > least2) fall = (peak2 - end2) * perTwoA;
          if (rise > 0 || fall > 0) {
            peak = Math.sqrt(peak2);
            if (floorS > 0) {
              phases.peak = peak;
              phases.rise = rise;
              phases.fall = fall;
              keepFloor(l, v0, v1, accel, floorS, phases);
              ({ peak, rise, fall } = phases);
            }
          }
          cruises = l - rise - fall > Math.max(NEGLIGIBLE * l, least2 * perTwoA);
        }
        // Each phase begins where the one before ended, and the last one ends where the straight does: rounding opens no gap.
        let isUp = rise > 0 && (fall > 0 || cruises);
        let isSteady = fall > 0 && cruises;
        const px = x[i]! + ex * used;
        const py = y[i]! + ey * used;
        const alongStart = along + used * perMm;
        let at = 0;
        let w0 = v0;
        for (;;) {
          let d = l - at;
          let w1 = v1;
          if (isUp) {
            d = cruises ? rise : l - fall;
            w1 = peak;
          } else if (isSteady) {
            d -= fall;
            w1 = peak;
          }
          const sum = w0 + w1;
          const t = (2 * d) / sum;
          const a = ((w1 - w0) * sum) / (2 * d);
          durationS[k] = t;
          bx[k] = px + ex * at;
          by[k] = py + ey * at;
          vx[k] = ex * w0;
          vy[k] = ey * w0;
          ax[k] = ex * a;
          ay[k] = ey * a;
          startS[k] = clock;
          alongMm[k] = alongStart + at * perMm;
          clock += t;
          k++;
          if (isUp) isUp = false;
          else if (isSteady) isSteady = false;
          else break;
          at += d;
          w0 = w1;
        }
      }
      along += stand;
      used = after * tau;
      v0 = after;
      if (tau === 0) continue;
      const wx = ex * v1;
      const wy = ey * v1;
      const t = 2 * tau;
      const per = 1 / t;
      durationS[k] = t;
      bx[k] = x[i + 1]! - wx * tau;
      by[k] = y[i + 1]! - wy * tau;
      vx[k] = wx;
      vy[k] = wy;
      ax[k] = (ux[i + 1]! * after - wx) * per;
      ay[k] = (uy[i + 1]! * after - wy) * per;
      startS[k] = clock;
      alongMm[k] = along - v1 * tau * perMm;
      clock += t;
      k++;
    }
    out.count = k;
    out.clockS = clock;
    this.along = along;
    this.used = used;
  }
}
