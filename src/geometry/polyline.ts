/**
 * Many polylines in columns: the form in which strokes go through `prepare`.
 *
 * Line i has points [offsets[i], offsets[i+1]); a line with one point is a dot; a line is closed
 * when its last point equals its first. Each line carries a tag (the shape or the layer that it
 * belongs to), which every step hands on. Lengths in mm.
 */
export interface Lines {
  /** x, y, x, y … */
  readonly xy: Float64Array;
  /** lines + 1, counted in points. */
  readonly offsets: Uint32Array;
  readonly tag: Uint32Array;
}

/** Nearer than this two points are one: far below any machine's step, far above rounding. */
export const SAME_POINT = 1e-6;

export const lineCount = (lines: Lines): number => lines.tag.length;

/** Collects lines point by point, leaving out points that repeat the one before. */
export class LineBuilder {
  private xy = new Float64Array(1024);
  private offsets = new Uint32Array(257);
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
    if (at + 2 > this.xy.length) this.xy = grownFloats(this.xy);
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
    if (this.lines + 2 > this.offsets.length) {
      this.offsets = grownIndices(this.offsets);
      this.tags = grownIndices(this.tags);
    }
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
    while (at + 2 * (last - first + 1) > this.xy.length) this.xy = grownFloats(this.xy);
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

  finish(): Lines {
    this.drop();
    return {
      xy: this.xy.slice(0, 2 * this.points),
      offsets: this.offsets.slice(0, this.lines + 1),
      tag: this.tags.slice(0, this.lines),
    };
  }
}

const grownFloats = (old: Float64Array<ArrayBuffer>): Float64Array<ArrayBuffer> => {
  const grown = new Float64Array(2 * old.length);
  grown.set(old);
  return grown;
};

const grownIndices = (old: Uint32Array<ArrayBuffer>): Uint32Array<ArrayBuffer> => {
  const grown = new Uint32Array(2 * old.length);
  grown.set(old);
  return grown;
};

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
