/**
 * Fewer, longer pieces of constant jerk: the fit of `scurve` plans. A run's blocks are covered greedily by stretches
 * as long as ε and the limits allow. A stretch of time T becomes three pieces of T/3 that match place, velocity and
 * acceleration of the plan at both ends (three-jerks.ts), so that no error is carried on.
 *
 * Kept: wherever it is looked at (`isNear`) the pieces are within ε of the planned line, beside it; along the line
 * they may run ahead or behind a little (`isBeside`). |a| ≤ A, |v| ≤ V and |j| ≤ J within 0.1 %. Where nothing longer
 * fits (a sharp corner is a few short blocks by its nature) blocks stay as they are.
 */
import type { BlockColumns } from "./block-columns.js";
import { FitSource, isBeside } from "./fit-source.js";
import type { RunLimits } from "./limits.js";
import type { RunEnd } from "./run-path.js";
import type { FitSettings } from "../settings/motion.js";
import { keepsJerkLimits, solveAxis } from "./three-jerks.js";

/** The search for the longest stretch ends within one part in so many of it. */
const FINENESS = 8;

/** Share of ε that the places looked at may use: between them the distance can be a little more. */
const BETWEEN = 0.95;

/** Longest stretch, s: older boards cannot be stopped within a piece. */
const LONGEST_S = 0.8;

/** The distance is looked at so many times a stretch, and twice in every block that it replaces. */
const LOOKS = 16;

const PIECES = 3;

export class JerkFitter {
  private readonly source = new FitSource();
  private limits!: RunLimits;
  /** The stretch that `fits` looked at last: state at its beginning, seconds, and its pieces' jerks. */
  private k = 0;
  private length = 0;
  private readonly jx = new Float64Array(PIECES);
  private readonly jy = new Float64Array(PIECES);

  constructor(private readonly settings: FitSettings) {}

  /** Appends the run in `from`, all of its blocks up to `end`, to `out` in fewer pieces. */
  write(from: BlockColumns, end: RunEnd, limits: RunLimits, out: BlockColumns): void {
    this.source.open(from, end);
    out.reserve(Math.min(from.count, end.segmentCount), end.segmentCount);
    this.limits = limits;
    let guess = 4;
    for (let k = 0; k < from.count;) {
      let m = this.longest(k, guess);
      if (this.isWorth(k, m)) {
        const { source } = this;
        const rest = from.clockS - source.startOf(m);
        if (rest > 0 && rest < source.startOf(m) - source.startOf(k)) m = this.balanced(k, m);
        this.fits(k, m);
        this.writePieces(m, out);
        guess = m - k;
        k = m;
      } else this.source.copy(k++, out);
    }
  }

  /** Whether pieces for [k, m) are fewer than its blocks; or as many, where that leaves fewer short ones. */
  private isWorth(k: number, m: number): boolean {
    if (m - k !== PIECES) return m - k > PIECES;
    const floor = this.settings.floorMs / 1000;
    return this.source.startOf(m) - this.source.startOf(k) < PIECES * floor;
  }

  /** The greatest m found for which blocks [k, m) can be replaced; k + 1 when none. */
  private longest(k: number, guess: number): number {
    const last = this.source.blocks.count;
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

  /** The middle of what is left of the run, when blocks up to there can be replaced; else m. */
  private balanced(k: number, m: number): number {
    const half = (this.source.startOf(k) + this.source.blocks.clockS) / 2;
    let i = m;
    while (i > k + 2 && this.source.startOf(i) > half) i--;
    return i > k + 2 && this.fits(k, i) ? i : m;
  }

  /** Whether blocks [k, m) can be replaced; leaves the pieces for `writePieces`. */
  private fits(k: number, m: number): boolean {
    this.k = k;
    this.length = this.source.startOf(m) - this.source.startOf(k);
    return this.length <= LONGEST_S && this.solve(k, m) && this.isNear(k, m);
  }

  private solve(k: number, m: number): boolean {
    const { source, jx, jy } = this;
    const { x, y, vx, vy, ax, ay, jx: fromJx, jy: fromJy, durationS } = source.blocks;
    const h = this.length / PIECES;
    const last = m - 1;
    const d = durationS[last]!;
    const gx = fromJx![last]!;
    const gy = fromJy![last]!;
    const vx1 = vx[last]! + d * (ax[last]! + (d * gx) / 2);
    const vy1 = vy[last]! + d * (ay[last]! + (d * gy) / 2);
    solveAxis(h, source.xOf(m) - x[k]!, vx[k]!, vx1, ax[k]!, ax[last]! + d * gx, jx);
    solveAxis(h, source.yOf(m) - y[k]!, vy[k]!, vy1, ay[k]!, ay[last]! + d * gy, jy);
    return keepsJerkLimits(vx[k]!, vy[k]!, ax[k]!, ay[k]!, jx, jy, h, this.limits);
  }

  /** Compares the pieces with the plan: twice in every block that they replace, and about LOOKS times at least. */
  private isNear(k: number, m: number): boolean {
    const { blocks } = this.source;
    const most = BETWEEN * this.settings.toleranceMm;
    const often = LOOKS / this.length;
    // Roughly first: most stretches that are too long leave the line early.
    for (let i = k + 2; i < m; i += 4) {
      if (!this.isBeside(blocks.startS[i]!, blocks.x[i]!, blocks.y[i]!, blocks.vx[i]!, blocks.vy[i]!, most))
        return false;
    }
    for (let i = k; i < m; i++) {
      const t = blocks.startS[i]!;
      const d = blocks.durationS[i]!;
      const looks = Math.max(2, Math.round(d * often));
      const jx = blocks.jx![i]!;
      const jy = blocks.jy![i]!;
      for (let look = 0; look < looks; look++) {
        const u = (d * look) / looks;
        const vx = blocks.vx[i]! + u * (blocks.ax[i]! + (u * jx) / 2);
        const vy = blocks.vy[i]! + u * (blocks.ay[i]! + (u * jy) / 2);
        const x = blocks.x[i]! + u * (blocks.vx[i]! + u * (blocks.ax[i]! / 2 + (u * jx) / 6));
        const y = blocks.y[i]! + u * (blocks.vy[i]! + u * (blocks.ay[i]! / 2 + (u * jy) / 6));
        if (!this.isBeside(t + u, x, y, vx, vy, most)) return false;
      }
    }
    return true;
  }

  /** Whether the pieces at an instant of the plan are near enough to (x, y), which moves at (vx, vy) there. */
  private isBeside(clock: number, x: number, y: number, vx: number, vy: number, most: number): boolean {
    const { k, jx, jy, source } = this;
    const { blocks } = source;
    const t = clock - blocks.startS[k]!;
    const h = this.length / PIECES;
    const u1 = t > h ? t - h : 0;
    const u2 = t > 2 * h ? t - 2 * h : 0;
    // Each change of jerk adds its own cubic from where it happens.
    const cx = jx[0]! * t ** 3 + (jx[1]! - jx[0]!) * u1 ** 3 + (jx[2]! - jx[1]!) * u2 ** 3;
    const cy = jy[0]! * t ** 3 + (jy[1]! - jy[0]!) * u1 ** 3 + (jy[2]! - jy[1]!) * u2 ** 3;
    const dx = blocks.x[k]! + t * (blocks.vx[k]! + (t * blocks.ax[k]!) / 2) + cx / 6 - x;
    const dy = blocks.y[k]! + t * (blocks.vy[k]! + (t * blocks.ay[k]!) / 2) + cy / 6 - y;
    return isBeside(dx, dy, vx, vy, most, this.limits.accel);
  }

  private writePieces(m: number, out: BlockColumns): void {
    const { k, source } = this;
    const { blocks } = source;
    const h = this.length / PIECES;
    let x = blocks.x[k]!;
    let y = blocks.y[k]!;
    let vx = blocks.vx[k]!;
    let vy = blocks.vy[k]!;
    let ax = blocks.ax[k]!;
    let ay = blocks.ay[k]!;
    let at = k;
    for (let i = 0; i < PIECES; i++) {
      const jx = this.jx[i]!;
      const jy = this.jy[i]!;
      const begin = source.startOf(k) + i * h;
      while (at + 1 < m && source.startOf(at + 1) <= begin) at++;
      out.pushJerk(h, x, y, vx, vy, ax, ay, jx, jy, source.alongAt(at, begin));
      x += h * (vx + h * (ax / 2 + (h * jx) / 6));
      y += h * (vy + h * (ay / 2 + (h * jy) / 6));
      vx += h * (ax + (h * jx) / 2);
      vy += h * (ay + (h * jy) / 2);
      ax += h * jx;
      ay += h * jy;
    }
  }
}
