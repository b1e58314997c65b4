/**
 * Coordinates in blocks instead of one array that doubles: a large drawing is copied once, at the end,
 * and never held three times over while it grows. A shape lies in one block.
 */
import { EMPTY_BOX, boxOfPoints, uniteBoxes, type Box } from "../geometry/box.js";

const BLOCK_LENGTH = 1 << 16;

export class CoordBlocks {
  /** Numbers held. */
  length = 0;
  private readonly blocks: Float64Array[] = [];
  private readonly used: number[] = [];
  /** The block that is written to, and its first free place. */
  block = new Float64Array(0);
  at = 0;

  /** Makes room in `block` from `at` on; the caller writes there and then calls `commit`. */
  reserve(count: number): void {
    if (this.at + count <= this.block.length) return;
    this.block = new Float64Array(Math.max(BLOCK_LENGTH, count));
    this.at = 0;
    this.blocks.push(this.block);
    this.used.push(0);
  }

  commit(count: number): void {
    this.at += count;
    this.length += count;
    this.used[this.used.length - 1] = this.at;
  }

  translate(dx: number, dy: number): void {
    this.blocks.forEach((block, index) => {
      for (let i = 0; i < this.used[index]; i += 2) {
        block[i] += dx;
        block[i + 1] += dy;
      }
    });
  }

  /** The box of the numbers [from, to). */
  boxOf(from: number, to: number): Box {
    let box = EMPTY_BOX;
    let start = 0;
    this.blocks.forEach((block, index) => {
      const end = start + this.used[index];
      if (from < end && to > start) {
        box = uniteBoxes(box, boxOfPoints(block, Math.max(from, start) - start, Math.min(to, end) - start));
      }
      start = end;
    });
    return box;
  }

  /** The block that holds the number at `offset`, and where in it. */
  find(offset: number): { readonly block: Float64Array; readonly at: number } {
    let index = 0;
    while (offset >= this.used[index]) offset -= this.used[index++];
    return { block: this.blocks[index], at: offset };
  }

  /** Everything as one array; the blocks are given up as they are copied. */
  take(): Float64Array {
    const all = new Float64Array(this.length);
    let at = 0;
    for (let i = 0; i < this.blocks.length; i++) {
      all.set(this.blocks[i].subarray(0, this.used[i]), at);
      at += this.used[i];
      this.blocks[i] = new Float64Array(0);
    }
    this.block = new Float64Array(0);
    return all;
  }
}
