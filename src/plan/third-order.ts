/**
 * Straights and corners under bounded jerk: every straight an S-curve of at most seven blocks, every corner a
 * curve of two or three blocks whose acceleration rises from zero and falls back to zero. So
 * acceleration is continuous throughout, |a| ≤ A, |j| ≤ J, |v| ≤ V, and the line stays within δ.
 *
 *   a ^       corner       Δv = 2 v s = J T²/4        (T its duration; J T / 2 ≤ A)
 *     |     /\             L  = v T / 2               tangent length
 *     |____/  \____        e  = L s / 3               distance of curve and corner
 *     +-------------> t    with a flat top (peak A):  T = Δv/A + A/J,  L = v T / 2,  e ≤ L s / 2
 *
 *   s = sin(φ/2) of the turn φ;  v the corner's speed, the same where its curve begins and ends
 *
 * Corner speeds: v³ ≤ Lm² J / 2s with Lm = min(longest tangent, 3 δ / s); where that needs more than A, the root
 * of v² s/A + v A/2J = min(longest tangent, 2 δ / s). Look-ahead: two passes over v with the reach of ramp.ts.
 *
 * At its best between sharp corners. On a finely sampled curve there is no straight left to change speed
 * on; smooth.ts does that case.
 */
import type { BlockColumns } from "./block-columns.js";
import { capSegments, type RunLimits } from "./limits.js";
import { heldHump, rampLength, rampPeak, rampReach, rampTime, steadyReach } from "./ramp.js";
import type { RunPath } from "./run-path.js";

/** Share of a segment that each of its two corners may use: the rest is left for ramps. */
const CORNER_SHARE = 0.35;
const STRAIGHT = 1e-24;
const NO_PIECE = 1e-10;
const ROUNDING = 1e-12;

export class ThirdOrderPlanner {
  /** sin(φ/2) of each vertex. */
  private sine = new Float64Array(0);
  /** Longest tangent that look-ahead counts on, mm. */
  private tangent = new Float64Array(0);
  private speed = new Float64Array(0);
  /** The place that is being written: mm and mm/s. */
  private x = 0;
  private y = 0;
  private along = 0;

  /** Limits the speed at every corner; `leastTime`, and `write` for the whole run, come after. */
  prepare(path: RunPath, limits: RunLimits): void {
    this.reserve(path.segmentCount + 1);
    capSegments(path, limits);
    this.limitCorners(path, limits);
  }

  /** A time, s, that the prepared run cannot beat: its corners, and its straights as if jerk were free. */
  leastTime(path: RunPath, limits: RunLimits): number {
    const { speed, sine } = this;
    let time = 0;
    let used = 0;
    for (let i = 0; i < path.segmentCount; i++) {
      const v0 = speed[i]!;
      const v1 = speed[i + 1]!;
      const turn = sine[i + 1]! > 0 ? rampTime(2 * v1 * sine[i + 1]!, limits.accel, limits.jerk) : 0;
      const next = (v1 / 2) * turn;
      const straight = path.length[i]! - used - next;
      const peak2 = Math.min(path.cap2[i]!, (v0 * v0 + v1 * v1) / 2 + limits.accel * straight);
      time += turn + straight / Math.sqrt(peak2);
      used = next;
    }
    return time;
  }

  private limitCorners(path: RunPath, limits: RunLimits): void {
    const { segmentCount: n, length, ux, uy, cap2 } = path;
    this.sine[0] = this.sine[n] = this.tangent[0] = this.tangent[n] = this.speed[0] = this.speed[n] = 0;
    for (let i = 1; i < n; i++) {
      const s2 = ((ux[i]! - ux[i - 1]!) ** 2 + (uy[i]! - uy[i - 1]!) ** 2) / 4;
      const cap = Math.sqrt(Math.min(cap2[i - 1]!, cap2[i]!));
      const s = s2 > STRAIGHT ? Math.sqrt(s2) : 0;
      const longest = CORNER_SHARE * Math.min(length[i - 1]!, length[i]!);
      const v = s > 0 ? Math.min(cap, cornerSpeed(s, longest, limits)) : cap;
      this.sine[i] = s;
      this.speed[i] = v;
      this.tangent[i] = tangentOf(v, s, limits);
    }
  }

  private lookAhead(path: RunPath, limits: RunLimits): void {
    const { segmentCount: n, length } = path;
    const { tangent, speed } = this;
    const { accel, jerk } = limits;
    const reach = (from: number, segment: number, atRest: boolean): number => {
      const straight = length[segment]! - tangent[segment]! - tangent[segment + 1]!;
      return atRest ? rampReach(0, straight, accel, jerk) : steadyReach(from, straight, accel, jerk);
    };
    for (let i = n - 1; i > 0; i--) {
      if (speed[i]! > speed[i + 1]!) speed[i] = Math.min(speed[i]!, reach(speed[i + 1]!, i, i === n - 1));
    }
    for (let i = 1; i < n; i++) {
      if (speed[i]! > speed[i - 1]!) speed[i] = Math.min(speed[i]!, reach(speed[i - 1]!, i - 1, i === 1));
    }
  }

  /** Writes the prepared run from rest to rest. */
  write(path: RunPath, limits: RunLimits, out: BlockColumns): void {
    this.lookAhead(path, limits);
    const { segmentCount: n, x, y, ux, uy, length, cap2 } = path;
    const { sine, speed } = this;
    let along = path.startAlong;
    let used = 0;
    out.reserve(9 * n, n);
    for (let i = 0; i < n; i++) {
      const next = tangentOf(speed[i + 1]!, sine[i + 1]!, limits);
      const straight = length[i]! - used - next;
      if (straight > NO_PIECE) {
        this.x = x[i]! + ux[i]! * used;
        this.y = y[i]! + uy[i]! * used;
        this.along = along + used;
        this.writeStraight(
          ux[i]!,
          uy[i]!,
          straight,
          speed[i]!,
          speed[i + 1]!,
          Math.sqrt(cap2[i]!),
          limits,
          out,
        );
      }
      along += length[i]!;
      used = next;
      if (sine[i + 1]! === 0) continue;
      this.x = x[i + 1]! - ux[i]! * next;
      this.y = y[i + 1]! - uy[i]! * next;
      this.along = along - next;
      const v = speed[i + 1]!;
      this.writeChange(ux[i]! * v, uy[i]! * v, ux[i + 1]! * v, uy[i + 1]! * v, v, limits, out);
    }
  }

  private writeStraight(
    ux: number,
    uy: number,
    length: number,
    v0: number,
    v1: number,
    most: number,
    limits: RunLimits,
    out: BlockColumns,
  ): void {
    const { jerk, floorS } = limits;
    const fastest = rampPeak(v0, v1, most, length, limits.accel, jerk);
    const even = floorS > 0 && v0 === v1;
    const hump = even ? heldHump(v0, fastest - v0, length, limits.accel, jerk, floorS) : null;
    const peak = hump ? v0 + hump.change : fastest;
    const accel = hump ? hump.accel : limits.accel;
    const own = accel < limits.accel ? { ...limits, accel } : limits;
    // A ramp too small to be written must not be given way either: √Δ in its time makes way of rounding.
    const rise = isRounding(peak - v0, peak) ? 0 : rampLength(v0, peak, accel, jerk);
    const fall = isRounding(peak - v1, peak) ? 0 : rampLength(peak, v1, accel, jerk);
    if (rise > 0) this.writeChange(ux * v0, uy * v0, ux * peak, uy * peak, 0, own, out);
    const cruise = length - rise - fall;
    if (cruise > NO_PIECE) {
      out.push(cruise / peak, this.x, this.y, ux * peak, uy * peak, 0, 0, this.along);
      this.x += ux * cruise;
      this.y += uy * cruise;
      this.along += cruise;
    }
    if (fall > 0) this.writeChange(ux * peak, uy * peak, ux * v1, uy * v1, 0, own, out);
  }

  /** From one velocity vector to another in two or three blocks. `speed`: along the drawing, round a corner of it; 0 where the way is the drawing's own. */
  private writeChange(
    vx0: number,
    vy0: number,
    vx1: number,
    vy1: number,
    speed: number,
    limits: RunLimits,
    out: BlockColumns,
  ): void {
    const change = Math.hypot(vx1 - vx0, vy1 - vy0);
    if (change === 0) return;
    const total = rampTime(change, limits.accel, limits.jerk);
    const hold =
      change * limits.jerk <= limits.accel * limits.accel ? 0 : total - 2 * (limits.accel / limits.jerk);
    const rise = (total - hold) / 2;
    // The jerk that makes exactly this change in exactly this time: J up to rounding.
    const j = change / (rise * (rise + hold));
    const jx = (j * (vx1 - vx0)) / change;
    const jy = (j * (vy1 - vy0)) / change;
    const step = (
      t: number,
      vx: number,
      vy: number,
      ax: number,
      ay: number,
      kx: number,
      ky: number,
    ): void => {
      out.pushJerk(t, this.x, this.y, vx, vy, ax, ay, kx, ky, this.along);
      const dx = t * (vx + t * (ax / 2 + (t * kx) / 6));
      const dy = t * (vy + t * (ay / 2 + (t * ky) / 6));
      this.x += dx;
      this.y += dy;
      this.along += speed > 0 ? speed * t : Math.sqrt(dx * dx + dy * dy);
    };
    const gain = (rise * rise) / 2;
    step(rise, vx0, vy0, 0, 0, jx, jy);
    if (hold > 0) step(hold, vx0 + jx * gain, vy0 + jy * gain, jx * rise, jy * rise, 0, 0);
    step(rise, vx1 - jx * gain, vy1 - jy * gain, jx * rise, jy * rise, -jx, -jy);
  }

  private reserve(points: number): void {
    if (this.sine.length >= points) return;
    const size = Math.max(points, 2 * this.sine.length);
    this.sine = new Float64Array(size);
    this.tangent = new Float64Array(size);
    this.speed = new Float64Array(size);
  }
}

/** Whether a change of speed is no more than what rounding leaves. */
const isRounding = (change: number, speed: number): boolean => !(change > ROUNDING * speed);

function tangentOf(v: number, s: number, limits: RunLimits): number {
  return s > 0 ? (v / 2) * rampTime(2 * v * s, limits.accel, limits.jerk) : 0;
}

/** The greatest speed whose corner curve has tangents ≤ `longest` and stays within δ. */
function cornerSpeed(s: number, longest: number, limits: RunLimits): number {
  const { accel, jerk, corner } = limits;
  const tangent = Math.min(longest, (3 * corner) / s);
  const triangle = Math.cbrt((tangent * tangent * jerk) / (2 * s));
  const flat = (accel * accel) / (2 * s * jerk);
  if (triangle <= flat) return triangle;
  // v² s/A + v A/2J = tangent, in the form that does not cancel.
  const b = accel / (2 * jerk);
  const least = Math.min(longest, (2 * corner) / s);
  return Math.max(flat, (2 * least) / (b + Math.sqrt(b * b + (4 * s * least) / accel)));
}
