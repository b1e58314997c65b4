/**
 * Coordinates in one array that is made about as large as it will be, once a part of the file shows how much that
 * is: a large drawing is then never held twice, neither while it grows nor at the end.
 *
 * What is reserved beyond the need costs address space only: the system gives memory to pages that are written.
 */
import { PlotwrightError } from "../errors.js";
import { boxOfPoints, type Box } from "../geometry/box.js";

const FIRST_LENGTH = 1 << 12;
/** 400 MB. A file of 200 MB seldom has more; blocks and copies in a few bytes may come to any number. */
const MAX_LENGTH = 50_000_000;
/** From this share of the file on, what it has brought so far tells what is to come. */
const TELLING_SHARE = 0.01;
/** The rest of the file may be denser than what has been seen. */
const MARGIN = 1.25;

/** How long a column is likely to become that is of this length after a share of the file; 0 while that tells nothing. */
export const expectedLength = (length: number, share: number): number =>
  share >= TELLING_SHARE ? Math.ceil((MARGIN * length) / share) : 0;

export class CoordColumn {
  /** Replaced when it grows. */
  data = new Float64Array(FIRST_LENGTH);
  /** Numbers held. */
  length = 0;
  /** Share of the file that has been drawn, 0 … 1. */
  share = 0;

  /** Makes room for `count` more: the caller writes them to `data` from `length` on, then adds to `length`. */
  reserve(count: number): void {
    const needed = this.length + count;
    if (needed <= this.data.length) return;
    if (needed > MAX_LENGTH) {
      throw new PlotwrightError(
        "bad-file",
        `The drawing comes to more than ${MAX_LENGTH / 2_000_000} million points. Simplify it, or plot it in parts.`,
      );
    }
    const expected = expectedLength(this.length, this.share);
    const wanted = Math.max(needed, 2 * this.data.length, expected);
    const grown = new Float64Array(Math.min(MAX_LENGTH, wanted));
    grown.set(this.data.subarray(0, this.length));
    this.data = grown;
  }

  translate(dx: number, dy: number): void {
    const { data, length } = this;
    for (let i = 0; i < length; i += 2) {
      data[i] += dx;
      data[i + 1] += dy;
    }
  }

  /** The box of the numbers [from, to). */
  boxOf(from: number, to: number): Box {
    return boxOfPoints(this.data, from, to);
  }
}
