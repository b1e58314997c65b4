/** Polylines (x, y, x, y …) for comparisons of what is asked with what is drawn. */
import type { StrokeSet } from "../../../src/index.js";
import { SegmentGrid } from "./segment-grid.js";

export const linesOf = ({ xy, offsets }: StrokeSet): Float64Array[] =>
  Array.from({ length: offsets.length - 1 }, (_, s) => xy.subarray(2 * offsets[s], 2 * offsets[s + 1]));

export function* pointsOf(lines: Iterable<ArrayLike<number>>): Iterable<readonly [number, number]> {
  for (const xy of lines) for (let i = 0; i < xy.length; i += 2) yield [xy[i], xy[i + 1]];
}

/** For distances of less than 1 mm. */
export function gridOf(lines: Iterable<ArrayLike<number>>): SegmentGrid {
  const grid = new SegmentGrid(1);
  for (const xy of lines) grid.addPolyline(xy);
  return grid;
}
