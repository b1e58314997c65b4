/** A stack of pieces that may have to be taken back: where each began, and how much was written by then. */
import type { BlockColumns } from "./block-columns.js";
import type { PieceStart } from "./steady-piece.js";

/** k, τ, x, y, vx, vy, blocks, clock. */
const FIELDS = 8;

export class PieceChain {
  count = 0;
  private values = new Float64Array(64 * FIELDS);

  /** Before a piece that begins at `start` is written to `out`. */
  push(start: PieceStart, out: BlockColumns): void {
    const i = this.count++ * FIELDS;
    if (i === this.values.length) {
      const longer = new Float64Array(2 * i);
      longer.set(this.values);
      this.values = longer;
    }
    const { values } = this;
    values[i] = start.k;
    values[i + 1] = start.tau;
    values[i + 2] = start.x;
    values[i + 3] = start.y;
    values[i + 4] = start.vx;
    values[i + 5] = start.vy;
    values[i + 6] = out.count;
    values[i + 7] = out.clockS;
  }

  /** Takes the last piece back: `start` and `out` are as before it. There must be one. */
  pop(start: PieceStart, out: BlockColumns): void {
    const { values } = this;
    const i = --this.count * FIELDS;
    start.k = values[i]!;
    start.tau = values[i + 1]!;
    start.x = values[i + 2]!;
    start.y = values[i + 3]!;
    start.vx = values[i + 4]!;
    start.vy = values[i + 5]!;
    out.count = values[i + 6]!;
    out.clockS = values[i + 7]!;
  }

  /** The block in which the first piece begins; `none` without one. */
  firstBlock(none: number): number {
    return this.count > 0 ? this.values[0]! : none;
  }
}
