/** The columns of `DrawingPaths` that hold one number for each shape: of one length, they grow together. */
import { grown } from "../geometry/growable.js";
import { expectedLength } from "./coord-column.js";

export class ShapeColumns {
  count = 0;
  /** Share of the file that has been drawn, 0 … 1. */
  share = 0;
  /** One more than shapes. */
  verbOffsets = new Uint32Array(256);
  coordOffsets = new Uint32Array(256);
  group = new Uint32Array(256);
  stroke = new Int32Array(256);
  fill = new Int32Array(256);
  fillRule = new Uint8Array(256);
  strokeWidth = new Float32Array(256);
  dash = new Int32Array(256);
  clip = new Int32Array(256);

  /** Makes room for so many more shapes: their numbers go to `count`, and their ends, among the offsets, behind that. */
  reserve(shapes: number): void {
    const needed = this.count + shapes + 1;
    if (needed <= this.group.length) return;
    const expected = Math.max(needed, expectedLength(this.count, this.share));
    this.verbOffsets = grown(this.verbOffsets, expected);
    this.coordOffsets = grown(this.coordOffsets, expected);
    this.group = grown(this.group, expected);
    this.stroke = grown(this.stroke, expected);
    this.fill = grown(this.fill, expected);
    this.fillRule = grown(this.fillRule, expected);
    this.strokeWidth = grown(this.strokeWidth, expected);
    this.dash = grown(this.dash, expected);
    this.clip = grown(this.clip, expected);
  }
}
