/** The columns of `DrawingPaths` that hold one number for each shape: of one length, they grow together. */
import { grown } from "../geometry/growable.js";

export class ShapeColumns {
  count = 0;
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
    while (this.count + shapes >= this.group.length) this.grow();
  }

  private grow(): void {
    this.verbOffsets = grown(this.verbOffsets);
    this.coordOffsets = grown(this.coordOffsets);
    this.group = grown(this.group);
    this.stroke = grown(this.stroke);
    this.fill = grown(this.fill);
    this.fillRule = grown(this.fillRule);
    this.strokeWidth = grown(this.strokeWidth);
    this.dash = grown(this.dash);
    this.clip = grown(this.clip);
  }
}
