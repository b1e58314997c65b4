/**
 * Clips polylines to an axis-aligned box: Liang and Barsky's parametric clipping, segment by segment.
 * (Y.-D. Liang, B. A. Barsky, "A New Concept and Method for Line Clipping", ACM TOG 3(1), 1984)
 *
 *   p(t) = p0 + t (p1 − p0), 0 ≤ t ≤ 1: each side of the box bounds t from below (entering) or from above (leaving).
 *   The part from the largest entry to the smallest exit is inside.
 *
 * Points on the border count as inside. Cut points lie exactly on the border, so that
 * "inside the margins" can be checked without a tolerance.
 */
import { boxContains, boxContainsPoint, boxesTouch, type Box } from "./box.js";
import { LineBuilder, isClosedLine, lineBox, lineCount, mix, type Lines } from "./polyline.js";

/** The parts of `lines` inside `box`, in order. A closed line that is cut starts at a border. */
export function clipLinesToBox(lines: Lines, box: Box): Lines {
  const builder = new LineBuilder();
  for (let i = 0; i < lineCount(lines); i++) clipLine(lines, i, box, builder);
  return builder.finish();
}

/** Adds the parts of line `i` inside `box` to `builder`. */
export function clipLine(lines: Lines, i: number, box: Box, builder: LineBuilder): void {
  const { xy, offsets } = lines;
  const tag = lines.tag[i];
  const first = offsets[i];
  const segments = offsets[i + 1] - first - 1;
  const bounds = lineBox(lines, i);
  if (boxContains(box, bounds)) return builder.copy(lines, i, tag);
  if (!boxesTouch(box, bounds) || segments < 1) return;
  const start = isClosedLine(lines, i) ? firstOutside(xy, first, segments, box) : 0;
  // Drops pieces that only touch the border: they would become dots that are not in the drawing.
  const endPiece = (): void => {
    if (builder.openPoints < 2) builder.drop();
    else builder.end(tag);
  };
  for (let k = 0; k < segments; k++) {
    const p = first + ((start + k) % segments);
    const [x0, y0, x1, y1] = [xy[2 * p], xy[2 * p + 1], xy[2 * p + 2], xy[2 * p + 3]];
    const addPoint = (t: number): void =>
      builder.point(clamped(mix(x0, x1, t), box.x0, box.x1), clamped(mix(y0, y1, t), box.y0, box.y1));
    const range = insideRange(x0, y0, x1, y1, box);
    if (range === null) {
      endPiece();
      continue;
    }
    const [enter, leave] = range;
    if (enter > 0) endPiece();
    if (builder.openPoints === 0) addPoint(enter);
    addPoint(leave);
    if (leave < 1) endPiece();
  }
  endPiece();
}

/** Index of a point of a closed line outside the box. If the line starts there, no piece inside the box is split. */
function firstOutside(xy: Float64Array, first: number, segments: number, box: Box): number {
  for (let k = 0; k < segments; k++) {
    if (!boxContainsPoint(box, xy[2 * (first + k)], xy[2 * (first + k) + 1])) return k;
  }
  return 0;
}

/** The t at which the segment enters and leaves the box; null if the segment misses the box. */
export function insideRange(
  x0: number,
  y0: number,
  x1: number,
  y1: number,
  box: Box,
): readonly [enter: number, leave: number] | null {
  let enter = 0;
  let leave = 1;
  // Each side bounds t: t · rate ≤ room, with the rate towards the side and the distance to it.
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

const clamped = (value: number, low: number, high: number): number => Math.min(Math.max(value, low), high);
