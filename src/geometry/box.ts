/** Axis-aligned boxes, mm. A box is empty if x0 > x1 or y0 > y1. */
import { applyX, applyY, type Affine } from "./affine.js";

export interface Box {
  readonly x0: number;
  readonly y0: number;
  readonly x1: number;
  readonly y1: number;
}

export const EMPTY_BOX: Box = { x0: Infinity, y0: Infinity, x1: -Infinity, y1: -Infinity };

export const isEmptyBox = (box: Box): boolean => !(box.x0 <= box.x1 && box.y0 <= box.y1);

/** True if `inner` lies inside `outer`, borders included. */
export const boxContains = (outer: Box, inner: Box): boolean =>
  inner.x0 >= outer.x0 && inner.x1 <= outer.x1 && inner.y0 >= outer.y0 && inner.y1 <= outer.y1;

/** True if `inner` is not larger than `outer`, wherever it lies. */
export const hasRoom = (outer: Box, inner: Box): boolean =>
  inner.x1 - inner.x0 <= outer.x1 - outer.x0 && inner.y1 - inner.y0 <= outer.y1 - outer.y0;

/** True if the boxes have at least one point in common, borders included. */
export const boxesTouch = (a: Box, b: Box): boolean =>
  a.x0 <= b.x1 && b.x0 <= a.x1 && a.y0 <= b.y1 && b.y0 <= a.y1;

export const intersectBoxes = (a: Box, b: Box): Box => ({
  x0: Math.max(a.x0, b.x0),
  y0: Math.max(a.y0, b.y0),
  x1: Math.min(a.x1, b.x1),
  y1: Math.min(a.y1, b.y1),
});

export const uniteBoxes = (a: Box, b: Box): Box => ({
  x0: Math.min(a.x0, b.x0),
  y0: Math.min(a.y0, b.y0),
  x1: Math.max(a.x1, b.x1),
  y1: Math.max(a.y1, b.y1),
});

/** The box with every side moved outwards. */
export const grownBox = ({ x0, y0, x1, y1 }: Box, mm: number): Box => ({
  x0: x0 - mm,
  y0: y0 - mm,
  x1: x1 + mm,
  y1: y1 + mm,
});

/** The corners of a box after a map: x, y, x, y …, in the order of its outline. */
export const mappedCorners = (map: Affine, { x0, y0, x1, y1 }: Box): number[] =>
  [
    [x0, y0],
    [x1, y0],
    [x1, y1],
    [x0, y1],
  ].flatMap(([x, y]) => [applyX(map, x, y), applyY(map, x, y)]);

/** The bounding box of a box after a map. */
export const mapBox = (map: Affine, box: Box): Box =>
  isEmptyBox(box) ? box : boxOfPoints(mappedCorners(map, box));

/** Bounding box of the interleaved coordinates [from, to) (indices into `xy`). */
export function boxOfPoints(xy: ArrayLike<number>, from = 0, to = xy.length): Box {
  let x0 = Infinity;
  let y0 = Infinity;
  let x1 = -Infinity;
  let y1 = -Infinity;
  for (let k = from; k < to; k += 2) {
    const x = xy[k];
    const y = xy[k + 1];
    if (x < x0) x0 = x;
    if (x > x1) x1 = x;
    if (y < y0) y0 = y;
    if (y > y1) y1 = y;
  }
  return { x0, y0, x1, y1 };
}

/**
 * The part of the line (x0, y0) + t (x1 − x0, y1 − y0) in a box, `from` ≤ t ≤ `to`; null if it misses the box. Points on
 * the border count as inside. Each side of the box bounds t from below, where the line enters, or from above, where it
 * leaves: the part from the largest entry to the smallest exit is inside.
 * (Y.-D. Liang, B. A. Barsky, "A New Concept and Method for Line Clipping", ACM TOG 3(1), 1984)
 */
export function insideRange(
  x0: number,
  y0: number,
  x1: number,
  y1: number,
  box: Box,
  from = 0,
  to = 1,
): [enter: number, leave: number] | null {
  let [enter, leave] = [from, to];
  // t · rate ≤ room, with the rate towards the side and the distance to it.
  for (const [rate, room] of [
    [x0 - x1, x0 - box.x0],
    [x1 - x0, box.x1 - x0],
    [y0 - y1, y0 - box.y0],
    [y1 - y0, box.y1 - y0],
  ]) {
    if (rate < 0) enter = Math.max(enter, room / rate);
    else if (rate > 0) leave = Math.min(leave, room / rate);
    else if (room < 0) return null;
  }
  return enter <= leave ? [enter, leave] : null;
}
