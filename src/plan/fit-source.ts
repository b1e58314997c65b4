/** A planned run as the fit reads it: its blocks in columns, and where it ends at rest. */
import type { BlockColumns } from "./block-columns.js";
import type { RunEnd } from "./run-path.js";

/** Longer blocks are kept as they are. */
const KEPT_S = 0.2;

/** So are blocks that turn the velocity by more than this (41°), by its cosine: sharp corners, which no curve has. */
export const SHARP = 0.755;

export class FitSource {
  blocks!: BlockColumns;
  /** How much later, s, the plan is where it is nearest to the place that `leftOf` was asked for. */
  aheadS = 0;
  private end!: RunEnd;

  /** Reads all of `blocks`, which start their clock at 0, from now on. */
  open(blocks: BlockColumns, end: RunEnd): void {
    this.blocks = blocks;
    this.end = end;
  }

  /** Start of block k, s; of the one after the last: the run's end. */
  startOf(k: number): number {
    return k < this.blocks.count ? this.blocks.startS[k]! : this.blocks.clockS;
  }

  xOf(k: number): number {
    return k < this.blocks.count ? this.blocks.x[k]! : this.end.x;
  }

  yOf(k: number): number {
    return k < this.blocks.count ? this.blocks.y[k]! : this.end.y;
  }

  /** mm along the source polyline at an instant of block k. Lengths are by Simpson's rule: exact where it is straight. */
  alongAt(k: number, clock: number): number {
    const { alongMm, durationS, count } = this.blocks;
    const next = k + 1 < count ? alongMm[k + 1]! : this.end.alongMm;
    const d = durationS[k]!;
    const t = Math.min(d, Math.max(0, clock - this.startOf(k)));
    const v0 = this.speedAt(k, 0);
    const whole = d * (v0 + 4 * this.speedAt(k, d / 2) + this.speedAt(k, d));
    const done = t * (v0 + 4 * this.speedAt(k, t / 2) + this.speedAt(k, t));
    return alongMm[k]! + (next - alongMm[k]!) * (done < whole ? done / whole : whole > 0 ? 1 : 0);
  }

  /** mm/s, `u` seconds after the beginning of block k. */
  private speedAt(k: number, u: number): number {
    const { vx, vy, ax, ay, jx, jy } = this.blocks;
    const wx = vx[k]! + u * (ax[k]! + (u / 2) * (jx ? jx[k]! : 0));
    const wy = vy[k]! + u * (ay[k]! + (u / 2) * (jy ? jy[k]! : 0));
    return Math.sqrt(wx * wx + wy * wy);
  }

  /** The first block from k on to be kept whatever happens: a long one or a sharp corner. */
  nextKept(k: number): number {
    const { durationS, vx, vy, ax, ay, count } = this.blocks;
    for (; k < count; k++) {
      const d = durationS[k]!;
      if (d >= KEPT_S) break;
      const wx = vx[k]! + d * ax[k]!;
      const wy = vy[k]! + d * ay[k]!;
      const along = vx[k]! * wx + vy[k]! * wy;
      const both2 = (vx[k]! * vx[k]! + vy[k]! * vy[k]!) * (wx * wx + wy * wy);
      if (along < 0 || along * along < SHARP * SHARP * both2) break;
    }
    return k;
  }

  /** How far to the left of the line (x, y) is, seen from the instant τ in block k or later. */
  leftOf(x: number, y: number, k: number, tau: number): number {
    const { startS, count, x: px, y: py, vx, vy, ax, ay } = this.blocks;
    while (k + 1 < count && startS[k + 1]! <= tau) k++;
    const d = tau - startS[k]!;
    const wx = vx[k]! + d * ax[k]!;
    const wy = vy[k]! + d * ay[k]!;
    const dx = x - px[k]! - (d * (vx[k]! + wx)) / 2;
    const dy = y - py[k]! - (d * (vy[k]! + wy)) / 2;
    const w2 = wx * wx + wy * wy;
    this.aheadS = w2 > 0 ? (wx * dx + wy * dy) / w2 : 0;
    return w2 > 0 ? (wx * dy - wy * dx) / Math.sqrt(w2) : 0;
  }

  /** Appends block k as it is. */
  copy(k: number, out: BlockColumns): void {
    const { blocks: f } = this;
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
}

/** Pieces may run ahead or behind by so much that the line's bend on that way is within half of this share of ε. */
const AHEAD = 0.3;

/**
 * Whether a place (dx, dy) away from one on the line, which is passed at (vx, vy) under at most `accel`, is within
 * `most` mm of the line: at once, or early or late on it, where the line bends by no more than A/v² a mm.
 */
export function isBeside(
  dx: number,
  dy: number,
  vx: number,
  vy: number,
  most: number,
  accel: number,
): boolean {
  const d2 = dx * dx + dy * dy;
  const v2 = vx * vx + vy * vy;
  const across = dx * vy - dy * vx;
  // In this order each answer is the same nearly always.
  if (across * across > most * most * v2) return false;
  return d2 * accel <= AHEAD * most * v2 || d2 <= most * most;
}
