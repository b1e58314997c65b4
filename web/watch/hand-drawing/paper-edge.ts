/** Splits a stroke that is drawn by hand at the edge of what the pen can draw: it goes on where it comes back. */
import { insideRange, type Box } from "../../../src/internal.js";

/** Takes a stroke that grows. */
interface GrowingStroke {
  lineTo(xMm: number, yMm: number): void;
  penUp(): void;
}

export class PaperEdge {
  private last: readonly [x: number, y: number] | null = null;
  private isDown = false;
  /** A part of the stroke lay outside. */
  hasLeft = false;

  constructor(
    private readonly box: Box,
    private readonly out: GrowingStroke,
  ) {}

  lineTo(x: number, y: number): void {
    const isFirst = this.last === null;
    const [fromX, fromY] = this.last ?? [x, y];
    this.last = [x, y];
    const [enters, leaves] = insideRange(fromX, fromY, x, y, this.box) ?? [1, 0];
    if (enters > 0) this.penUp();
    // A line that only touches the edge would become a dot.
    const isSeen = enters < leaves || (enters === leaves && (this.isDown || leaves === 1));
    const add = (t: number): void => {
      const { x0, y0, x1, y1 } = this.box;
      // Rounding must not put a point outside.
      this.out.lineTo(
        Math.min(x1, Math.max(x0, fromX + t * (x - fromX))),
        Math.min(y1, Math.max(y0, fromY + t * (y - fromY))),
      );
    };
    if (isSeen && !this.isDown) add(enters);
    this.isDown ||= isSeen;
    if (isSeen && leaves > enters && !isFirst) add(leaves);
    if (isSeen && leaves === 1) return;
    this.hasLeft = true;
    this.penUp();
  }

  /** The stroke is complete. */
  penUp(): void {
    if (this.isDown) this.out.penUp();
    this.isDown = false;
  }
}
