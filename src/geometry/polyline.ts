/**
 * Many polylines in columns: the form in which strokes go through `prepare`.
 *
 * Line i has points [offsets[i], offsets[i+1]); a line with one point is a dot; a line is closed
 * when its last point equals its first. Each line carries a tag (the shape or the layer that it
 * belongs to), which every step hands on. Lengths in mm.
 */
import type { Affine } from "./affine.js";
import { grown } from "./growable.js";

export interface Lines {
  /** x, y, x, y … */
  readonly xy: Float64Array;
  /** lines + 1, counted in points. */
  readonly offsets: Uint32Array;
  readonly tag: Uint32Array;
}

/** Nearer than this two points are one: far below any machine's step, far above rounding. */
export const SAME_POINT = 1e-6;

/** Whether a point of the lines [from, to) repeats the one before it, so that a `LineBuilder` leaves it out. */
export function repeatsPoints({ xy, offsets }: Lines, from: number, to: number): boolean {
  for (let i = from; i < to; i++) {
    const end = 2 * offsets[i + 1];
    for (let at = 2 * offsets[i] + 2; at < end; at += 2) {
      const dx = xy[at] - xy[at - 2];
      const dy = xy[at + 1] - xy[at - 1];
      if (dx * dx + dy * dy <= SAME_POINT * SAME_POINT) return true;
    }
  }
  return false;
}

export const lineCount = (lines: Lines): number => lines.tag.length;

/** Collects lines point by point, leaving out points that repeat the one before. */
export class LineBuilder {
  private xy = new Float64Array(1024);
  /** Never shorter than the tags and one. */
  private offsets = new Uint32Array(512);
  private tags = new Uint32Array(256);
  private points = 0;
  private lines = 0;
  /** First point of the line that is being built. */
  private first = 0;
  private skipped = false;
  private skippedX = 0;
  private skippedY = 0;

  /** Points of the line that is being built. */
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

  /** Ends the line; one without points leaves no trace. */
  end(tag: number): void {
    if (this.points === this.first) return;
    // A line keeps its very last point, so that one closed in the input stays closed to the bit.
    if (this.skipped && this.points > this.first + 1) {
      this.xy[2 * this.points - 2] = this.skippedX;
      this.xy[2 * this.points - 1] = this.skippedY;
    }
    this.skipped = false;
    if (this.lines + 1 > this.tags.length) this.growLines();
    this.tags[this.lines] = tag;
    this.offsets[++this.lines] = this.first = this.points;
  }

  /** Forgets the line that is being built. */
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

  /** As a line of its own and without a call for each point. False, and nothing done, where a point would be left out. */
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
    if (this.points > this.first || repeatsPoints(lines, from, to)) {
      for (let i = from; i < to; i++) this.copy(lines, i, lines.tag[i]);
      return;
    }
    const { offsets } = lines;
    const begin = offsets[from];
    this.reserve(offsets[to] - begin);
    while (this.lines + to - from + 1 > this.tags.length) this.growLines();
    this.xy.set(lines.xy.subarray(2 * begin, 2 * offsets[to]), 2 * this.points);
    this.tags.set(lines.tag.subarray(from, to), this.lines);
    const shift = this.points - begin;
    for (let i = from; i < to; i++) this.offsets[++this.lines] = offsets[i + 1] + shift;
    this.points = this.first = offsets[to] + shift;
  }

  /**
   * Adds the mapped points coords[from], coords[from + 1] … before `to` as one line, without a call for each of them.
   * False, and nothing done, where one would be left out.
   */
  addMapped(coords: Float64Array, from: number, to: number, map: Affine, tag: number): boolean {
    if (this.points > this.first) return false;
    this.reserve((to - from) / 2);
    const { a, b, c, d, e, f } = map;
    const out = this.xy;
    let at = 2 * this.points;
    let x = Infinity;
    let y = Infinity;
    for (let k = from; k < to; k += 2) {
      const dx = a * coords[k] + c * coords[k + 1] + e - x;
      const dy = b * coords[k] + d * coords[k + 1] + f - y;
      if (dx * dx + dy * dy <= SAME_POINT * SAME_POINT) return false;
      x = out[at++] = a * coords[k] + c * coords[k + 1] + e;
      y = out[at++] = b * coords[k] + d * coords[k + 1] + f;
    }
    this.points = at / 2;
    this.end(tag);
    return true;
  }

  private reserve(points: number): void {
    while (2 * (this.points + points) > this.xy.length) this.xy = grown(this.xy);
  }

  private growLines(): void {
    this.offsets = grown(this.offsets);
    this.tags = grown(this.tags);
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

/** True when line `i` ends where it began and is more than a dot. */
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

/** Faster than Math.hypot, and as good at these sizes. */
export function distance(x0: number, y0: number, x1: number, y1: number): number {
  const dx = x1 - x0;
  const dy = y1 - y0;
  return Math.sqrt(dx * dx + dy * dy);
}
