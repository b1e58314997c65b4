/**
 * Fewer, longer pieces: a run's blocks are covered greedily by pieces as long as ε and the limits allow, so that
 * the board gets a command every 50 to 200 ms on a curve instead of one every few ms.
 *
 * A stretch of time T is replaced by pieces that hit its end state exactly, so no error is carried on:
 *
 *   constant acceleration: two pieces of T/2, matching place and velocity at both ends
 *       a1 = 4 (Δp − v0 T)/T² − Δv/T          a2 = 2 Δv/T − a1
 *   constant jerk: three pieces of h = T/3, matching place, velocity and acceleration at both ends
 *       j1 = C − B    j2 = B − 2 j1    j3 = Sa − j1 − j2, where
 *       Sa = Δa/h     B = (Δv − 3 a0 h)/h² − Sa/2     C = (Δp − 3 v0 h − 9 a0 h²/2)/h³ − Sa/6
 *
 * Kept: |p − planned| ≤ ε at every end and middle of a replaced block, at equal time; |a| ≤ A, |v| ≤ V (|j| ≤ J)
 * within 0.1 %. Where nothing longer fits (a sharp corner is a short block by its nature) blocks stay as
 * they are. Jumps of velocity at the vertices of `junction` plans stay at the ends of pieces only.
 */
import type { BlockColumns } from "./block-columns.js";
import type { RunLimits } from "./limits.js";
import type { FitSettings } from "./settings.js";

/** Limits may be passed by this much. */
const SLACK = 1.0009;

/** The search for the longest stretch ends within one part in so many of it. */
const FINENESS = 8;

/** Share of ε that the places looked at may use: between them the distance can be a little more. */
const BETWEEN = 0.85;

/** Longest stretch, s: older boards cannot be stopped within a piece, so pieces stay below a quarter second. */
const LONGEST_S = 0.48;

export class PieceFitter {
  private from!: BlockColumns;
  private limits!: RunLimits;
  private endX = 0;
  private endY = 0;
  private endAlong = 0;
  /** The stretch that `fits` looked at last: state at its beginning, and its pieces' accelerations or jerks. */
  private length = 0;
  private a0x = 0;
  private a0y = 0;
  private readonly px = new Float64Array(3);
  private readonly py = new Float64Array(3);

  constructor(
    private readonly settings: FitSettings,
    private readonly jerky: boolean,
  ) {}

  /** Appends the run in `from` (all of its blocks, ending at the given place) to `out` in fewer pieces. */
  write(
    from: BlockColumns,
    limits: RunLimits,
    endX: number,
    endY: number,
    endAlong: number,
    segments: number,
    out: BlockColumns,
  ): void {
    this.from = from;
    this.limits = limits;
    this.endX = endX;
    this.endY = endY;
    this.endAlong = endAlong;
    out.reserve(Math.min(from.count, segments), segments);
    const pieces = this.jerky ? 3 : 2;
    let guess = 2 * pieces;
    for (let k = 0; k < from.count;) {
      const m = this.longest(k, guess);
      const isShort = (this.startOf(m) - this.startOf(k)) / (m - k) < this.settings.floorMs / 1000;
      if (m - k > pieces || (m - k === pieces && isShort)) {
        this.fits(k, m);
        this.writePieces(k, m, out);
        guess = m - k;
        k = m;
      } else {
        this.copy(k, out);
        k++;
      }
    }
  }

  /** The greatest m found for which blocks [k, m) can be replaced; k + 1 when none. */
  private longest(k: number, guess: number): number {
    const last = this.from.count;
    let low = k + 1;
    let high = Math.min(k + guess, last);
    while (high > low && this.fits(k, high)) {
      low = high;
      high = Math.min(k + 2 * (high - k), last);
    }
    // `high` does not fit, or is `low` itself at the end of the run.
    while (high - low > 1 + (low - k) / FINENESS) {
      const middle = (low + high) >> 1;
      if (this.fits(k, middle)) low = middle;
      else high = middle;
    }
    return low;
  }

  /** Whether blocks [k, m) can be replaced; leaves the pieces for `writePieces`. */
  private fits(k: number, m: number): boolean {
    const length = this.startOf(m) - this.startOf(k);
    if (length > LONGEST_S) return false;
    this.length = length;
    return (this.jerky ? this.solveJerks(k, m) : this.solveAccelerations(k, m)) && this.isNear(k, m);
  }

  private solveAccelerations(k: number, m: number): boolean {
    const { from, length: T, px, py } = this;
    const { accel, speed } = this.limits;
    const last = m - 1;
    const d = from.durationS[last]!;
    const dvx = from.vx[last]! + d * from.ax[last]! - from.vx[k]!;
    const dvy = from.vy[last]! + d * from.ay[last]! - from.vy[k]!;
    px[0] = (4 * (this.xOf(m) - from.x[k]! - from.vx[k]! * T)) / (T * T) - dvx / T;
    py[0] = (4 * (this.yOf(m) - from.y[k]! - from.vy[k]! * T)) / (T * T) - dvy / T;
    px[1] = (2 * dvx) / T - px[0];
    py[1] = (2 * dvy) / T - py[0];
    this.a0x = this.a0y = 0;
    const most = (accel * SLACK) ** 2;
    const vx = from.vx[k]! + (px[0] * T) / 2;
    const vy = from.vy[k]! + (py[0] * T) / 2;
    return (
      px[0] * px[0] + py[0] * py[0] <= most &&
      px[1] * px[1] + py[1] * py[1] <= most &&
      vx * vx + vy * vy <= (speed * SLACK) ** 2
    );
  }

  private solveJerks(k: number, m: number): boolean {
    const { from, px, py } = this;
    const h = this.length / 3;
    const last = m - 1;
    const d = from.durationS[last]!;
    const jx = from.jx![last]!;
    const jy = from.jy![last]!;
    this.a0x = from.ax[k]!;
    this.a0y = from.ay[k]!;
    solveAxis(
      h,
      this.xOf(m) - from.x[k]!,
      from.vx[k]!,
      from.vx[last]! + d * (from.ax[last]! + (d * jx) / 2),
      this.a0x,
      from.ax[last]! + d * jx,
      px,
    );
    solveAxis(
      h,
      this.yOf(m) - from.y[k]!,
      from.vy[k]!,
      from.vy[last]! + d * (from.ay[last]! + (d * jy) / 2),
      this.a0y,
      from.ay[last]! + d * jy,
      py,
    );
    return this.keepsLimits(k, h);
  }

  private keepsLimits(k: number, h: number): boolean {
    const { from, px, py } = this;
    const { accel, speed, jerk } = this.limits;
    let vx = from.vx[k]!;
    let vy = from.vy[k]!;
    let ax = this.a0x;
    let ay = this.a0y;
    for (let i = 0; i < 3; i++) {
      const jx = px[i]!;
      const jy = py[i]!;
      if (jx * jx + jy * jy > (jerk * SLACK) ** 2) return false;
      // Between two of four places in a piece, speed is at most |j| (h/4)²/8 above the greater of theirs.
      const most = speed * SLACK - (Math.sqrt(jx * jx + jy * jy) * h * h) / 128;
      for (let q = 1; q <= 4; q++) {
        const u = (h * q) / 4;
        const wx = vx + u * (ax + (u * jx) / 2);
        const wy = vy + u * (ay + (u * jy) / 2);
        if (most < 0 || wx * wx + wy * wy > most * most) return false;
      }
      vx += h * (ax + (h * jx) / 2);
      vy += h * (ay + (h * jy) / 2);
      ax += h * jx;
      ay += h * jy;
      if (ax * ax + ay * ay > (accel * SLACK) ** 2) return false;
    }
    return true;
  }

  /** Compares the pieces with the plan at the end and middle of every block that they replace. */
  private isNear(k: number, m: number): boolean {
    const { from } = this;
    const most = (BETWEEN * this.settings.toleranceMm) ** 2;
    const start = this.startOf(k);
    for (let i = k; i < m; i++) {
      const half = from.durationS[i]! / 2;
      const t = this.startOf(i) - start;
      if (i > k && this.distance2(k, t, from.x[i]!, from.y[i]!) > most) return false;
      const jx = from.jx ? from.jx[i]! : 0;
      const jy = from.jy ? from.jy[i]! : 0;
      const x = from.x[i]! + half * (from.vx[i]! + half * (from.ax[i]! / 2 + (half * jx) / 6));
      const y = from.y[i]! + half * (from.vy[i]! + half * (from.ay[i]! / 2 + (half * jy) / 6));
      if (this.distance2(k, t + half, x, y) > most) return false;
    }
    return true;
  }

  /** Distance² of (x, y) from the pieces, `t` seconds after the beginning of block k. */
  private distance2(k: number, t: number, x: number, y: number): number {
    const { from, px, py } = this;
    let qx: number;
    let qy: number;
    if (this.jerky) {
      const h = this.length / 3;
      const u1 = t > h ? t - h : 0;
      const u2 = t > 2 * h ? t - 2 * h : 0;
      // Each change of jerk adds its own cubic from where it happens.
      const cx = px[0]! * t ** 3 + (px[1]! - px[0]!) * u1 ** 3 + (px[2]! - px[1]!) * u2 ** 3;
      const cy = py[0]! * t ** 3 + (py[1]! - py[0]!) * u1 ** 3 + (py[2]! - py[1]!) * u2 ** 3;
      qx = t * (from.vx[k]! + (t * this.a0x) / 2) + cx / 6;
      qy = t * (from.vy[k]! + (t * this.a0y) / 2) + cy / 6;
    } else {
      const u = t > this.length / 2 ? t - this.length / 2 : 0;
      qx = t * from.vx[k]! + (px[0]! * t * t + (px[1]! - px[0]!) * u * u) / 2;
      qy = t * from.vy[k]! + (py[0]! * t * t + (py[1]! - py[0]!) * u * u) / 2;
    }
    const dx = from.x[k]! + qx - x;
    const dy = from.y[k]! + qy - y;
    return dx * dx + dy * dy;
  }

  private writePieces(k: number, m: number, out: BlockColumns): void {
    const { from, px, py, jerky } = this;
    const pieces = jerky ? 3 : 2;
    const h = this.length / pieces;
    let x = from.x[k]!;
    let y = from.y[k]!;
    let vx = from.vx[k]!;
    let vy = from.vy[k]!;
    let ax = this.a0x;
    let ay = this.a0y;
    let at = k;
    for (let i = 0; i < pieces; i++) {
      const jx = jerky ? px[i]! : 0;
      const jy = jerky ? py[i]! : 0;
      if (!jerky) {
        ax = px[i]!;
        ay = py[i]!;
      }
      const begin = this.startOf(k) + i * h;
      while (at + 1 < m && this.startOf(at + 1) <= begin) at++;
      out.pushJerk(h, x, y, vx, vy, ax, ay, jx, jy, this.alongAt(at, begin));
      x += h * (vx + h * (ax / 2 + (h * jx) / 6));
      y += h * (vy + h * (ay / 2 + (h * jy) / 6));
      vx += h * (ax + (h * jx) / 2);
      vy += h * (ay + (h * jy) / 2);
      ax += h * jx;
      ay += h * jy;
    }
  }

  private copy(k: number, out: BlockColumns): void {
    const { from: f } = this;
    const jx = f.jx ? f.jx[k]! : 0;
    const jy = f.jy ? f.jy[k]! : 0;
    out.pushJerk(
      f.durationS[k]!,
      f.x[k]!,
      f.y[k]!,
      f.vx[k]!,
      f.vy[k]!,
      f.ax[k]!,
      f.ay[k]!,
      jx,
      jy,
      f.alongMm[k]!,
    );
  }

  private alongAt(k: number, clock: number): number {
    const { from } = this;
    const next = k + 1 < from.count ? from.alongMm[k + 1]! : this.endAlong;
    const share = (clock - this.startOf(k)) / from.durationS[k]!;
    return from.alongMm[k]! + (next - from.alongMm[k]!) * Math.min(1, Math.max(0, share));
  }

  private startOf(k: number): number {
    return k < this.from.count ? this.from.startS[k]! : this.from.clockS;
  }

  private xOf(k: number): number {
    return k < this.from.count ? this.from.x[k]! : this.endX;
  }

  private yOf(k: number): number {
    return k < this.from.count ? this.from.y[k]! : this.endY;
  }
}

/** The three jerks of one axis that lead from (v0, a0) over `dp` to (v1, a1) in time 3 h. */
function solveAxis(
  h: number,
  dp: number,
  v0: number,
  v1: number,
  a0: number,
  a1: number,
  jerks: Float64Array,
): void {
  const sa = (a1 - a0) / h;
  const b = (v1 - v0 - 3 * a0 * h) / (h * h) - sa / 2;
  const c = (dp - 3 * v0 * h - 4.5 * a0 * h * h) / (h * h * h) - sa / 6;
  jerks[0] = c - b;
  jerks[1] = b - 2 * jerks[0];
  jerks[2] = sa - jerks[0] - jerks[1];
}
