/**
 * Many polylines in columns: the form in which strokes pass through `prepare`.
 *
 * Line i has points [offsets[i], offsets[i+1]). A line with one point is a dot. A line is closed
 * if its last point equals its first. Each line carries a tag (the shape or layer that it
 * belongs to), which every step passes on. Lengths in mm.
 */
import { boxOfPoints, type Box } from "./box.js";
import { ColumnBuffer, PointBuffer } from "./growable.js";

export interface Lines {
  /** x, y, x, y … */
  readonly xy: Float64Array;
  /** lines + 1 entries, in points. */
  readonly offsets: Uint32Array;
  readonly tag: Uint32Array;
}

/** Points closer than this, mm, are the same point. Far below any machine's step, far above rounding errors. */
export const SAME_POINT_MM = 1e-6;

export const lineCount = (lines: Lines): number => lines.tag.length;

/** Collects lines point by point, dropping points that repeat the previous one. */
export class LineBuilder {
  private readonly xy = new PointBuffer(512);
  private readonly offsets = new ColumnBuffer(Uint32Array, 512);
  private readonly tags = new ColumnBuffer(Uint32Array, 256);
  /** First point of the line being built. */
  private first = 0;
  private skipped = false;
  private skippedX = 0;
  private skippedY = 0;

  constructor() {
    this.offsets.push(0);
  }

  /** Number of points in the line being built. */
  get openPoints(): number {
    return this.xy.pointCount - this.first;
  }

  point(x: number, y: number): void {
    const { data, length } = this.xy;
    if (length > 2 * this.first) {
      const dx = x - data[length - 2];
      const dy = y - data[length - 1];
      if (dx * dx + dy * dy <= SAME_POINT_MM * SAME_POINT_MM) {
        this.skippedX = x;
        this.skippedY = y;
        this.skipped = true;
        return;
      }
    }
    this.skipped = false;
    this.xy.push(x, y);
  }

  /** Ends the line. A line without points is not added. */
  end(tag: number): void {
    const { data, length } = this.xy;
    if (this.openPoints === 0) return;
    // Keep the exact last point, so that a line closed in the input stays exactly closed.
    if (this.skipped && this.openPoints > 1) {
      data[length - 2] = this.skippedX;
      data[length - 1] = this.skippedY;
    }
    this.skipped = false;
    this.first = this.xy.pointCount;
    this.offsets.push(this.first);
    this.tags.push(tag);
  }

  /** Ends the line as the outline of an area: back at its first point, or discarded if it has fewer than three. */
  endArea(tag: number): void {
    const { data } = this.xy;
    if (this.openPoints > 2) this.point(data[2 * this.first], data[2 * this.first + 1]);
    if (this.openPoints > 2) this.end(tag);
    else this.drop();
  }

  /** Discards the line being built. */
  drop(): void {
    this.skipped = false;
    this.xy.length = 2 * this.first;
  }

  /** Adds line `i` of `lines`; backwards if `reversed`. */
  copy(lines: Lines, i: number, tag: number, reversed = false): void {
    this.extend(lines, i, reversed);
    this.end(tag);
  }

  /** Adds a closed line, which then begins at its point number `start`. */
  copyFrom({ xy, offsets, tag }: Lines, i: number, start: number): void {
    const first = offsets[i];
    const segments = offsets[i + 1] - 1 - first;
    for (let k = 0; k <= segments; k++) {
      const p = first + ((start + k) % segments);
      this.point(xy[2 * p], xy[2 * p + 1]);
    }
    this.end(tag[i]);
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
    return { xy: this.xy.toArray(), offsets: this.offsets.toArray(), tag: this.tags.toArray() };
  }
}

/** Bounding box of line `i`. */
export const lineBox = ({ xy, offsets }: Lines, i: number): Box =>
  boxOfPoints(xy, 2 * offsets[i], 2 * offsets[i + 1]);

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

/** The lines for which `isKept` is true. */
export function filterLines(lines: Lines, isKept: (i: number) => boolean): Lines {
  const kept: number[] = [];
  for (let i = 0; i < lineCount(lines); i++) if (isKept(i)) kept.push(i);
  return pickLines(lines, kept);
}

/** Ranges [first, end) of lines that share a tag; lines of one tag are contiguous. */
export const tagRanges = (lines: Lines): [number, number][] => rangesBy(lines, (tag) => tag);

/** Ranges [first, end) of neighbouring lines whose tags have the same key. */
export function rangesBy({ tag }: Lines, keyOf: (tag: number) => number): [number, number][] {
  const ranges: [number, number][] = [];
  for (let first = 0, end = 0; first < tag.length; first = end) {
    const key = keyOf(tag[first]);
    while (end < tag.length && keyOf(tag[end]) === key) end++;
    ranges.push([first, end]);
  }
  return ranges;
}

/** Faster than Math.hypot, and as accurate at these magnitudes. */
export function distance(x0: number, y0: number, x1: number, y1: number): number {
  const dx = x1 - x0;
  const dy = y1 - y0;
  return Math.sqrt(dx * dx + dy * dy);
}

export const clamp = (value: number, low: number, high: number): number =>
  Math.min(Math.max(value, low), high);

/** The number at the share `t` between two numbers; exactly the second one for 1. */
export const mix = (from: number, to: number, t: number): number => (t === 1 ? to : from + t * (to - from));

/** Where on a segment it is nearest to (x, y): the share of its length before that point, 0 … 1. */
export function nearestShare(x0: number, y0: number, x1: number, y1: number, x: number, y: number): number {
  const dx = x1 - x0;
  const dy = y1 - y0;
  const length2 = dx * dx + dy * dy;
  return length2 > 0 ? clamp(((x - x0) * dx + (y - y0) * dy) / length2, 0, 1) : 0;
}
