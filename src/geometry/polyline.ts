/**
 * Many polylines in columns: the form in which strokes pass through `prepare`.
 *
 * Line i has points [offsets[i], offsets[i+1]). A line with one point is a dot. A line is closed
 * if its last point equals its first. Each line carries a tag (the shape or layer that it
 * belongs to), which every step passes on. Lengths in mm.
 */
import { grown } from "./growable.js";

export interface Lines {
  /** x, y, x, y … */
  readonly xy: Float64Array;
  /** lines + 1 entries, in points. */
  readonly offsets: Uint32Array;
  readonly tag: Uint32Array;
}

/**
 * Points closer than this, mm, are the same point. Far below any machine's step, far above rounding errors.
 */
export const SAME_POINT = 1e-6;

export const lineCount = (lines: Lines): number => lines.tag.length;

/** Collects lines point by point, dropping points that repeat the previous one. */
export class LineBuilder {
  private xy = new Float64Array(1024);
  /** At least one entry longer than the tags. */
  private offsets = new Uint32Array(512);
  private tags = new Uint32Array(256);
  private points = 0;
  private lines = 0;
  /** First point of the line being built. */
  private first = 0;
  private skipped = false;
  private skippedX = 0;
  private skippedY = 0;

  /** Number of points in the line being built. */
  get openPoints(): number {
    return this.points - this.first;
  }

  point(x: number, y: number): void {
    const at = 2 * this.points;
    if (this.points > this.first) {
      const dx = x - this.xy[at - 2];
      const dy = y - this.xy[at - 1];
      if (dx * dx + dy * dy <= SAME_POINT * SAME_POINT) {
        this.skippedX = x;
        this.skippedY = y;
        this.skipped = true;
        return;
      }
    }
    this.skipped = false;
    if (at + 2 > this.xy.length) this.xy = grown(this.xy);
    this.xy[at] = x;
    this.xy[at + 1] = y;
    this.points++;
  }

  /** Ends the line. A line without points is not added. */
  end(tag: number): void {
    if (this.points === this.first) return;
    // Keep the exact last point, so that a line closed in the input stays exactly closed.
    if (this.skipped && this.points > this.first + 1) {
      this.xy[2 * this.points - 2] = this.skippedX;
      this.xy[2 * this.points - 1] = this.skippedY;
    }
    this.skipped = false;
    if (this.lines === this.tags.length) {
      this.tags = grown(this.tags);
      this.offsets = grown(this.offsets);
    }
    this.tags[this.lines] = tag;
    this.offsets[++this.lines] = this.first = this.points;
  }

  /** Discards the line being built. */
  drop(): void {
    this.skipped = false;
    this.points = this.first;
  }

  /** Adds line `i` of `lines`; backwards if `reversed`. */
  copy(lines: Lines, i: number, tag: number, reversed = false): void {
    this.extend(lines, i, reversed);
    this.end(tag);
  }

  /** Adds the points of line `i` of `lines` to the line being built. */
  extend({ xy, offsets }: Lines, i: number, reversed: boolean): void {
    const first = offsets[i];
    const last = offsets[i + 1] - 1;
    if (reversed) for (let p = last; p >= first; p--) this.point(xy[2 * p], xy[2 * p + 1]);
    else for (let p = first; p <= last; p++) this.point(xy[2 * p], xy[2 * p + 1]);
  }

  finish(): Lines {
    this.drop();
    return {
      xy: this.xy.slice(0, 2 * this.points),
      offsets: this.offsets.slice(0, this.lines + 1),
      tag: this.tags.slice(0, this.lines),
    };
  }
}

/** Length of line `i`, mm. */
export function lineLength(lines: Lines, i: number): number {
  const { xy, offsets } = lines;
  let length = 0;
  for (let p = offsets[i] + 1; p < offsets[i + 1]; p++) {
    length += distance(xy[2 * p - 2], xy[2 * p - 1], xy[2 * p], xy[2 * p + 1]);
  }
  return length;
}

export function totalLength(lines: Lines): number {
  let length = 0;
  for (let i = 0; i < lineCount(lines); i++) length += lineLength(lines, i);
  return length;
}

/** True if line `i` ends at its first point and is more than a dot. */
export function isClosedLine(lines: Lines, i: number): boolean {
  const { xy, offsets } = lines;
  const first = offsets[i];
  const last = offsets[i + 1] - 1;
  return last > first + 1 && xy[2 * first] === xy[2 * last] && xy[2 * first + 1] === xy[2 * last + 1];
}

/** The lines at `indices`, in that order. */
export function pickLines(lines: Lines, indices: ArrayLike<number>): Lines {
  const builder = new LineBuilder();
  for (let k = 0; k < indices.length; k++) builder.copy(lines, indices[k], lines.tag[indices[k]]);
  return builder.finish();
}

/** Faster than Math.hypot, and as accurate at these magnitudes. */
export function distance(x0: number, y0: number, x1: number, y1: number): number {
  const dx = x1 - x0;
  const dy = y1 - y0;
  return Math.sqrt(dx * dx + dy * dy);
}

/** Where on a segment it is nearest to (x, y): the share of its length before that point, 0 … 1. */
export function nearestShare(x0: number, y0: number, x1: number, y1: number, x: number, y: number): number {
  const dx = x1 - x0;
  const dy = y1 - y0;
  const length2 = dx * dx + dy * dy;
  return length2 > 0 ? Math.min(1, Math.max(0, ((x - x0) * dx + (y - y0) * dy) / length2)) : 0;
}
