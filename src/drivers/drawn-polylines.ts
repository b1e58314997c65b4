/** The line that a virtual machine has drawn: one polyline between consecutive pen moves. */
import { PointBuffer } from "../geometry/growable.js";

export interface DrawnPolyline {
  readonly penDown: boolean;
  /** mm from home: x, y, x, y … */
  readonly xy: Float64Array;
}

export class DrawnPolylines {
  private readonly points = new PointBuffer();
  private readonly lines: { readonly penDown: boolean; readonly from: number }[] = [];

  /** Starts a new polyline. */
  begin(penDown: boolean): void {
    this.lines.push({ penDown, from: this.points.length });
  }

  add(x: number, y: number): void {
    this.points.push(x, y);
  }

  replaceLast(x: number, y: number): void {
    this.points.length -= 2;
    this.add(x, y);
  }

  /** Without the polylines of a single point at which the pen was up. */
  list(): DrawnPolyline[] {
    const { lines, points } = this;
    return lines.flatMap(({ penDown, from }, i) => {
      const to = lines[i + 1]?.from ?? points.length;
      return penDown || to - from > 2 ? [{ penDown, xy: points.data.slice(from, to) }] : [];
    });
  }
}
