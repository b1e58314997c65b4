/**
 * Fewer, longer pieces: a run's blocks are covered greedily by pieces as long as ε and the limits allow, so that
 * the board gets a command every 50 to 300 ms on a curve instead of one every few ms.
 *
 * A stretch of time T is replaced by pieces that hit a chosen end state exactly, so no error is carried on:
 *
 *   constant acceleration: two pieces of T/2, matching place and velocity at both ends; with the velocity
 *       in the middle  m = 2 Δp/T − (v0 + v1)/2:   a1 = 2 (m − v0)/T,  a2 = 2 (v1 − m)/T
 *   constant jerk: three pieces, see three-jerks.ts
 *
 * The end state is the plan's or, for constant acceleration, one with an evened velocity (even-state.ts). A block
 * can be kept as it is only from a state of the plan's: where nothing goes on from an evened state, the stretch
 * before is made again to end as planned. Two parabolas for an arc are slower in the middle of each than at
 * their ends; at full speed T may therefore be up to LATER of the plan's, so that |m| ≤ V.
 *
 * Kept: wherever it is looked at (`isNear`) the pieces are within ε of the planned line, beside it; along
 * the line they may run ahead or behind a little (`isBeside`). |a| ≤ A, |v| ≤ V (|j| ≤ J) within 0.1 %. Where
 * nothing longer fits (a sharp corner is a short block by its nature) blocks stay as they are. Jumps of
 * velocity at the vertices of `junction` plans stay at the ends of pieces only.
 */
import type { BlockColumns } from "./block-columns.js";
import { EvenState } from "./even-state.js";
import type { RunLimits } from "./limits.js";
import type { FitSettings, MotionMode } from "./settings.js";
import { keepsJerkLimits, SLACK, solveAxis } from "./three-jerks.js";

/** The search for the longest stretch ends within one part in so many of it. */
const FINENESS = 8;

/** Share of ε that the places looked at may use: between them the distance can be a little more. */
const BETWEEN = 0.95;

/** Longest stretch, s: older boards cannot be stopped within a piece, so pieces stay below half a second. */
const LONGEST_S = 0.8;

/** The distance is looked at so many times a stretch, and once in every block that it replaces. */
const LOOKS = 16;

/** What rounding may add to V. */
const HARDLY = 1 + 1e-9;

/** Pieces may take so much more time than the plan: on curves at full speed, V holds at their ends only. */
const LATER = 1.02;

/** Pieces may run ahead or behind by so much that the line's bend on that way is within half of this of ε. */
const AHEAD = 0.1;

/** After so many stretches that end in evened states one must end as planned: bounds what is done twice. */
const LONGEST_CHAIN = 16;

/** A stretch that ended in an evened state: where it began, and what `out` held then. */
interface ChainLink {
  readonly k: number;
  readonly count: number;
  readonly clockS: number;
  readonly state: readonly [x: number, y: number, vx: number, vy: number];
}

export class PieceFitter {
  private readonly jerky: boolean;
  private from!: BlockColumns;
  private limits!: RunLimits;
  private endX = 0;
  private endY = 0;
  private endAlong = 0;
  /** The stretch that `fits` looked at last: state at its beginning, and its pieces' accelerations or jerks. */
  private length = 0;
  /** The pieces' time by the plan's. */
  private stretch = 1;
  private a0x = 0;
  private a0y = 0;
  /** Place and velocity where the stretch begins and ends: the plan's, or evened ones. */
  private x0 = 0;
  private y0 = 0;
  private vx0 = 0;
  private vy0 = 0;
  private x1 = 0;
  private y1 = 0;
  private vx1 = 0;
  private vy1 = 0;
  /** Whether the end is an evened state, and whether one may be tried. */
  private isEven = false;
  private mayEven = false;
  private readonly even = new EvenState();
  private readonly chain: ChainLink[] = [];
  private readonly px = new Float64Array(3);
  private readonly py = new Float64Array(3);

  constructor(
    private readonly settings: FitSettings,
    private readonly mode: MotionMode,
  ) {
    this.jerky = mode === "scurve";
  }

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
    const chain = this.chain;
    chain.length = 0;
    this.startPlanned(0);
    let guess = this.jerky ? 6 : 4;
    let evenStart = false;
    let planOnly = false;
    for (let k = 0; k < from.count;) {
      this.mayEven = !this.jerky && !planOnly && chain.length < LONGEST_CHAIN;
      let m = this.longest(k, guess);
      if (this.isWorth(k, m, evenStart)) {
        const rest = this.from.clockS - this.startOf(m);
        if (rest > 0 && rest < this.startOf(m) - this.startOf(k)) m = this.balanced(k, m);
        this.fits(k, m);
        if (this.isEven)
          chain.push({
            k,
            count: out.count,
            clockS: out.clockS,
            state: [this.x0, this.y0, this.vx0, this.vy0],
          });
        else chain.length = 0;
        this.writePieces(k, m, out);
        guess = m - k;
        k = m;
        evenStart = this.isEven;
        planOnly = false;
        if (evenStart) this.startAt(this.x1, this.y1, this.vx1, this.vy1);
        else this.startPlanned(k);
      } else if (evenStart) {
        // Nothing goes on from this evened state: the stretch before it must end as planned.
        const last = chain.pop()!;
        out.count = last.count;
        out.clockS = last.clockS;
        guess = k - last.k;
        k = last.k;
        evenStart = chain.length > 0;
        planOnly = true;
        this.startAt(...last.state);
      } else {
        this.copy(k, out);
        k++;
        planOnly = false;
        this.startPlanned(k);
      }
    }
  }

  /** Whether pieces for [k, m) are fewer than its blocks; or as many, where that leaves fewer short ones. */
  private isWorth(k: number, m: number, evenStart: boolean): boolean {
    const pieces = this.jerky ? 3 : 2;
    if (m - k !== pieces) return m - k > pieces || (evenStart && m - k >= 2);
    if (evenStart) return true;
    const floor = this.settings.floorMs / 1000;
    return this.startOf(m) - this.startOf(k) < pieces * floor;
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
    this.isEven = false;
    if (this.jerky) {
      this.length = length;
      this.stretch = 1;
      return this.solveJerks(k, m) && this.isNear(k, m);
    }
    if (this.mayEven && m < this.from.count && this.fitsEven(k, m, length)) return true;
    this.endPlanned(m);
    return this.solveAccelerations(length) && this.isNear(k, m);
  }

  private solveAccelerations(length: number): boolean {
    const { px, py, vx0, vy0 } = this;
    const dx = this.x1 - this.x0;
    const dy = this.y1 - this.y0;
    const sx = (vx0 + this.vx1) / 2;
    const sy = (vy0 + this.vy1) / 2;
    let T = length;
    let mx = (2 * dx) / T - sx;
    let my = (2 * dy) / T - sy;
    const most2 = (this.limits.speed * HARDLY) ** 2;
    if (mx * mx + my * my > most2) {
      // The latest T for which |2 Δp / T − s| = V.
      const d2 = dx * dx + dy * dy;
      const along = dx * sx + dy * sy;
      const root = along * along - d2 * (sx * sx + sy * sy - most2);
      if (!(root >= 0)) return false;
      T = (2 * d2) / (along + Math.sqrt(root));
      if (!(T <= length * LATER)) return false;
      mx = (2 * dx) / T - sx;
      my = (2 * dy) / T - sy;
    }
    this.length = T;
    this.stretch = T / length;
    if (!this.keepsSpeed(mx, my) || !this.keepsSpeed(this.vx1, this.vy1)) return false;
    px[0] = (mx - vx0) * (2 / T);
    py[0] = (my - vy0) * (2 / T);
    px[1] = (this.vx1 - mx) * (2 / T);
    py[1] = (this.vy1 - my) * (2 / T);
    this.a0x = this.a0y = 0;
    const most = (this.limits.accel * SLACK) ** 2;
    return px[0] * px[0] + py[0] * py[0] <= most && px[1] * px[1] + py[1] * py[1] <= most;
  }

  /** Speed runs straight between a piece's ends, and both limits are convex: the ends tell. */
  private keepsSpeed(vx: number, vy: number): boolean {
    const { speed, motorSpeed, mixed } = this.limits;
    const ax = Math.abs(vx);
    const ay = Math.abs(vy);
    const motor = mixed ? ax + ay : ax > ay ? ax : ay;
    return vx * vx + vy * vy <= (speed * SLACK) ** 2 && motor <= motorSpeed * SLACK;
  }

  private startAt(x: number, y: number, vx: number, vy: number): void {
    this.x0 = x;
    this.y0 = y;
    this.vx0 = vx;
    this.vy0 = vy;
  }

  private startPlanned(k: number): void {
    const { from } = this;
    if (k < from.count) this.startAt(from.x[k]!, from.y[k]!, from.vx[k]!, from.vy[k]!);
  }

  private endPlanned(m: number): void {
    const { from } = this;
    const d = from.durationS[m - 1]!;
    this.x1 = this.xOf(m);
    this.y1 = this.yOf(m);
    this.vx1 = from.vx[m - 1]! + d * from.ax[m - 1]!;
    this.vy1 = from.vy[m - 1]! + d * from.ay[m - 1]!;
  }

  private fitsEven(k: number, m: number, length: number): boolean {
    const { even, from } = this;
    even.find(from, m, length / 2);
    const { vx, vy } = even;
    const less = Math.min(1, this.limits.speed / Math.sqrt(vx * vx + vy * vy));
    this.isEven = true;
    this.x1 = from.x[m]!;
    this.y1 = from.y[m]!;
    this.vx1 = less * vx;
    this.vy1 = less * vy;
    if (this.solveAccelerations(length) && this.isNear(k, m)) return true;
    this.isEven = false;
    return false;
  }

  /** The middle of what is left of the run, when blocks up to there can be replaced; else m. */
  private balanced(k: number, m: number): number {
    const half = (this.startOf(k) + this.from.clockS) / 2;
    let i = m;
    while (i > k + 2 && this.startOf(i) > half) i--;
    return i > k + 2 && this.fits(k, i) ? i : m;
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
    return keepsJerkLimits(from.vx[k]!, from.vy[k]!, this.a0x, this.a0y, px, py, h, this.limits);
  }

  /** Compares the pieces with the plan: in every block that they replace, and about LOOKS times at least. */
  private isNear(k: number, m: number): boolean {
    const { from, stretch } = this;
    const most = (BETWEEN * this.settings.toleranceMm) ** 2;
    const start = this.startOf(k);
    const often = (LOOKS * stretch) / this.length;
    // Roughly first: most stretches that are too long leave the line early.
    for (let i = k + 2; i < m; i += 4) {
      const t = (this.startOf(i) - start) * stretch;
      if (!this.isBeside(t, from.x[i]!, from.y[i]!, from.vx[i]!, from.vy[i]!, most)) return false;
    }
    for (let i = k; i < m; i++) {
      const t = this.startOf(i) - start;
      const d = from.durationS[i]!;
      const looks = d * often > 1.5 ? Math.round(d * often) : 1;
      const ax = from.ax[i]!;
      const ay = from.ay[i]!;
      const jx = from.jx ? from.jx[i]! : 0;
      const jy = from.jy ? from.jy[i]! : 0;
      for (let look = 0; look < looks; look++) {
        const u = (d * (look + 0.5)) / looks;
        const vx = from.vx[i]! + u * (ax + (u * jx) / 2);
        const vy = from.vy[i]! + u * (ay + (u * jy) / 2);
        const x = from.x[i]! + u * (from.vx[i]! + u * (ax / 2 + (u * jx) / 6));
        const y = from.y[i]! + u * (from.vy[i]! + u * (ay / 2 + (u * jy) / 6));
        if (!this.isBeside((t + u) * stretch, x, y, vx, vy, most)) return false;
      }
    }
    return true;
  }

  /** Whether the pieces `t` seconds after their start are near enough to (x, y), which moves at (vx, vy). */
  private isBeside(t: number, x: number, y: number, vx: number, vy: number, most: number): boolean {
    const { px, py } = this;
    let qx: number;
    let qy: number;
    if (this.jerky) {
      const h = this.length / 3;
      const u1 = t > h ? t - h : 0;
      const u2 = t > 2 * h ? t - 2 * h : 0;
      // Each change of jerk adds its own cubic from where it happens.
      const cx = px[0]! * t ** 3 + (px[1]! - px[0]!) * u1 ** 3 + (px[2]! - px[1]!) * u2 ** 3;
      const cy = py[0]! * t ** 3 + (py[1]! - py[0]!) * u1 ** 3 + (py[2]! - py[1]!) * u2 ** 3;
      qx = t * (this.vx0 + (t * this.a0x) / 2) + cx / 6;
      qy = t * (this.vy0 + (t * this.a0y) / 2) + cy / 6;
    } else {
      const u = t > this.length / 2 ? t - this.length / 2 : 0;
      qx = t * this.vx0 + (px[0]! * t * t + (px[1]! - px[0]!) * u * u) / 2;
      qy = t * this.vy0 + (py[0]! * t * t + (py[1]! - py[0]!) * u * u) / 2;
    }
    const dx = this.x0 + qx - x;
    const dy = this.y0 + qy - y;
    const d2 = dx * dx + dy * dy;
    if (d2 <= most) return true;
    if (this.mode === "junction") return false;
    // Early or late on the same line: there the line bends by no more than A / v² a mm.
    const v2 = vx * vx + vy * vy;
    const across = dx * vy - dy * vx;
    const { accel } = this.limits;
    return d2 * accel <= AHEAD * this.settings.toleranceMm * v2 && across * across <= most * v2;
  }

  private writePieces(k: number, m: number, out: BlockColumns): void {
    const { px, py, jerky } = this;
    const pieces = jerky ? 3 : 2;
    const h = this.length / pieces;
    let x = this.x0;
    let y = this.y0;
    let vx = this.vx0;
    let vy = this.vy0;
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
      const begin = this.startOf(k) + (i * h) / this.stretch;
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
