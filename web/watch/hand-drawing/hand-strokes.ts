/** The strokes of a drawing by hand, mm, and places along them. */
import type { Line, StrokePosition, StrokeSet } from "../../../src/index.js";

/** A point nearer than this to the one before it is the same point, as for the plotter. */
const SAME_POINT_MM = 1e-6;

interface HandStroke {
  readonly points: [x: number, y: number][];
  /** mm along the stroke at each point. */
  readonly along: number[];
}

export class HandStrokes {
  /** The last stroke may get more points. */
  isOpen = false;
  private readonly strokes: HandStroke[] = [];

  get count(): number {
    return this.strokes.length;
  }

  /** As a drawing with one layer. */
  get drawing(): StrokeSet {
    const lines = this.strokes.map(({ points }) => points);
    const offsets = new Uint32Array(lines.length + 1);
    for (const [k, { length }] of lines.entries()) offsets[k + 1] = offsets[k] + length;
    return {
      xy: Float64Array.from(lines.flat(2)),
      offsets,
      layer: new Uint16Array(lines.length),
      layers: [{ id: "live", name: "Live", color: null }],
    };
  }

  pointsOf(stroke: number): Line {
    return this.strokes[stroke].points;
  }

  lengthOf(stroke: number): number {
    return this.strokes[stroke].along.at(-1)!;
  }

  /** Adds a point to the stroke that grows, or begins one. False: it is the same as the last one, and not added. */
  lineTo(x: number, y: number): boolean {
    const last = this.strokes.at(-1);
    if (!this.isOpen || !last) {
      this.strokes.push({ points: [[x, y]], along: [0] });
      this.isOpen = true;
      return true;
    }
    const [beforeX, beforeY] = last.points.at(-1)!;
    const mm = Math.hypot(x - beforeX, y - beforeY);
    if (mm < SAME_POINT_MM) return false;
    last.points.push([x, y]);
    last.along.push(last.along.at(-1)! + mm);
    return true;
  }

  /** The stroke that grows is complete. */
  penUp(): void {
    this.isOpen = false;
  }

  /** Takes back the last stroke, except its first `left` points; it is then complete. */
  takeBack(left: number): void {
    this.isOpen = false;
    const last = this.strokes.at(-1);
    if (!last) return;
    if (left === 0) this.strokes.pop();
    else last.points.length = last.along.length = Math.min(left, last.along.length);
  }

  /** The number of the first point beyond a place of a stroke. */
  firstBeyond({ stroke, alongMm }: StrokePosition): number {
    const { along } = this.strokes[stroke];
    let [from, to] = [0, along.length];
    while (from < to) {
      const middle = (from + to) >> 1;
      if (along[middle] > alongMm) to = middle;
      else from = middle + 1;
    }
    return from;
  }

  /** The point at a place; beyond the end of its stroke, the last point. */
  pointAt(place: StrokePosition): readonly [x: number, y: number] {
    const { points, along } = this.strokes[place.stroke];
    const after = this.firstBeyond(place);
    if (after === 0 || after === along.length) return points.at(after === 0 ? 0 : -1)!;
    const [x, y] = points[after - 1];
    const [toX, toY] = points[after];
    const t = (place.alongMm - along[after - 1]) / (along[after] - along[after - 1]);
    return [x + t * (toX - x), y + t * (toY - y)];
  }

  /** The place on the same stroke, at most `aheadMm` farther, that is nearest to a point; null: it is not within `withinMm`. */
  nearest(
    from: StrokePosition,
    [x, y]: readonly [x: number, y: number],
    aheadMm: number,
    withinMm: number,
  ): StrokePosition | null {
    const { stroke, alongMm } = from;
    const { points, along } = this.strokes[stroke];
    let found: StrokePosition | null = null;
    let nearestMm = withinMm;
    for (let i = Math.max(1, this.firstBeyond(from)); i < along.length; i++) {
      const beginMm = along[i - 1];
      if (beginMm > alongMm + aheadMm) break;
      const [beginX, beginY] = points[i - 1];
      const [dx, dy] = [points[i][0] - beginX, points[i][1] - beginY];
      const lengthMm = along[i] - beginMm;
      const passesMm = ((x - beginX) * dx + (y - beginY) * dy) / lengthMm;
      const onMm = Math.min(lengthMm, Math.max(0, alongMm - beginMm, passesMm));
      const t = onMm / lengthMm;
      const awayMm = Math.hypot(x - beginX - t * dx, y - beginY - t * dy);
      if (awayMm >= nearestMm) continue;
      nearestMm = awayMm;
      found = { stroke, alongMm: beginMm + onMm };
    }
    return found;
  }
}
