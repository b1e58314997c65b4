/**
 * Many polylines in columns: the form in which strokes pass through `prepare`.
 *
 * Line i has points [offsets[i], offsets[i+1]). A line with one point is a dot. A line is closed
 * if its last point equals its first. Each line carries a tag (the shape or layer that it
 * belongs to), which every step passes on. Lengths in mm.
 */
import type { Affine } from "./affine.js";
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
    if (at + 2 > this.xy.length) this.reserve(1);
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
    this.reserveLines(1);
    this.tags[this.lines] = tag;
    this.offsets[++this.lines] = this.first = this.points;
  }

  /** Discards the line being built. */
  drop(): void {
    this.skipped = false;
    this.points = this.first;
  }

  /** Adds line `i` of `lines`, backwards if asked. */
  copy(lines: Lines, i: number, tag: number, reversed = false): void {
    const first = lines.offsets[i];
    const last = lines.offsets[i + 1] - 1;
    if (this.copyWhole(lines.xy, first, last, reversed)) return this.end(tag);
    if (reversed) for (let p = last; p >= first; p--) this.point(lines.xy[2 * p], lines.xy[2 * p + 1]);
    else for (let p = first; p <= last; p++) this.point(lines.xy[2 * p], lines.xy[2 * p + 1]);
    this.end(tag);
  }

  /**
   * Adds a whole line without a call per point. Returns false and adds nothing if a point would be dropped.
   */
  private copyWhole(xy: Float64Array, first: number, last: number, reversed: boolean): boolean {
    if (this.points > this.first) return false;
    let at = 2 * this.points;
    this.reserve(last - first + 1);
    const out = this.xy;
    const step = reversed ? -2 : 2;
    let from = 2 * (reversed ? last : first);
    let x = (out[at] = xy[from]);
    let y = (out[at + 1] = xy[from + 1]);
    for (let left = last - first; left > 0; left--) {
      from += step;
      at += 2;
      const dx = xy[from] - x;
      const dy = xy[from + 1] - y;
      if (dx * dx + dy * dy <= SAME_POINT * SAME_POINT) return false;
      x = out[at] = xy[from];
      y = out[at + 1] = xy[from + 1];
    }
    this.points += last - first + 1;
    return true;
  }

  /** Adds lines [from, to), each with its own tag. */
  copyRange(lines: Lines, from: number, to: number): void {
    for (let i = from; i < to; i++) {
      i = this.copyWholeLines(lines, i, to);
      if (i < to) this.copy(lines, i, lines.tag[i]);
    }
  }

  /**
   * Adds lines from `from` on, up to the first in which a point would be dropped. Returns its index, or `to`.
   */
  private copyWholeLines({ xy, offsets, tag }: Lines, from: number, to: number): number {
    if (this.points > this.first) return from;
    this.reserve(offsets[to] - offsets[from]);
    this.reserveLines(to - from);
    const { xy: out, offsets: outOffsets, tags } = this;
    let { points, lines } = this;
    let i = from;
    for (; i < to; i++) {
      const end = 2 * offsets[i + 1];
      let at = 2 * points;
      let x = Infinity;
      let y = Infinity;
      let k = 2 * offsets[i];
      for (; k < end; k += 2) {
        const dx = xy[k] - x;
        const dy = xy[k + 1] - y;
        if (dx * dx + dy * dy <= SAME_POINT * SAME_POINT) break;
        x = out[at++] = xy[k];
        y = out[at++] = xy[k + 1];
      }
      if (k < end) break;
      points = at / 2;
      tags[lines] = tag[i];
      outOffsets[++lines] = points;
    }
    this.points = this.first = points;
    this.lines = lines;
    return i;
  }

  /**
   * Adds polylines as separate lines, mapped by `map`, without a call per point. Polyline i in [from, to) has
   * the numbers [offsets[i], offsets[i + 1]) of `coords` and gets the tag i. Stops at the first polyline in
   * which a point would be dropped and returns its index; it is not added. Returns `to` if all were added.
   */
  addMapped(coords: Float64Array, offsets: Uint32Array, from: number, to: number, map: Affine): number {
    if (this.points > this.first) return from;
    this.reserve((offsets[to] - offsets[from]) / 2);
    this.reserveLines(to - from);
    const { a, b, c, d, e, f } = map;
    const { xy: out, offsets: outOffsets, tags } = this;
    let { points, lines } = this;
    let i = from;
    for (; i < to; i++) {
      const end = offsets[i + 1];
      let at = 2 * points;
      let x = Infinity;
      let y = Infinity;
      let k = offsets[i];
      for (; k < end; k += 2) {
        const px = a * coords[k] + c * coords[k + 1] + e;
        const py = b * coords[k] + d * coords[k + 1] + f;
        const dx = px - x;
        const dy = py - y;
        if (dx * dx + dy * dy <= SAME_POINT * SAME_POINT) break;
        x = out[at++] = px;
        y = out[at++] = py;
      }
      if (k < end) break;
      points = at / 2;
      tags[lines] = i;
      outOffsets[++lines] = points;
    }
    this.points = this.first = points;
    this.lines = lines;
    return i;
  }

  private reserve(points: number): void {
    const needed = 2 * (this.points + points);
    if (needed > this.xy.length) this.xy = grown(this.xy, needed);
  }

  private reserveLines(lines: number): void {
    const needed = this.lines + lines;
    if (needed <= this.tags.length) return;
    this.offsets = grown(this.offsets, needed + 1);
    this.tags = grown(this.tags, needed);
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
