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
import { boxContains, boxContainsPoint, boxOfPoints, boxesTouch, type Box } from "./box.js";
import { LineBuilder, isClosedLine, lineCount, type Lines } from "./polyline.js";

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
  const end = offsets[i + 1];
  const bounds = boxOfPoints(xy, 2 * first, 2 * end);
  if (boxContains(box, bounds)) return builder.copy(lines, i, tag);
  if (!boxesTouch(box, bounds) || end - first < 2) return;
  const segments = end - first - 1;
  const start = isClosedLine(lines, i) ? firstOutside(xy, first, segments, box) : 0;
  for (let k = 0; k < segments; k++) {
    const p = first + ((start + k) % segments);
    clipSegment(xy[2 * p], xy[2 * p + 1], xy[2 * p + 2], xy[2 * p + 3], box, builder, tag);
  }
  endPiece(builder, tag);
}

/** Index of a point of a closed line outside the box. If the line starts there, no piece inside the box is split. */
function firstOutside(xy: Float64Array, first: number, segments: number, box: Box): number {
  for (let k = 0; k < segments; k++) {
    if (!boxContainsPoint(box, xy[2 * (first + k)], xy[2 * (first + k) + 1])) return k;
  }
  return 0;
}

/** Adds the inside part of one segment. Ends the piece where the segment leaves the box. */
function clipSegment(
  x0: number,
  y0: number,
  x1: number,
  y1: number,
  box: Box,
  builder: LineBuilder,
  tag: number,
): void {
  if (!insideRange(x0, y0, x1, y1, box, range)) return endPiece(builder, tag);
  const [enter, leave] = range;
  if (enter > 0) endPiece(builder, tag);
  const x = (t: number): number => clamped(t === 1 ? x1 : x0 + t * (x1 - x0), box.x0, box.x1);
  const y = (t: number): number => clamped(t === 1 ? y1 : y0 + t * (y1 - y0), box.y0, box.y1);
  if (builder.openPoints === 0) builder.point(x(enter), y(enter));
  builder.point(x(leave), y(leave));
  if (leave < 1) endPiece(builder, tag);
}

const range: [number, number] = [0, 1];

/** Writes the t at which the segment enters and leaves the box. False if the segment misses the box. */
export function insideRange(
  x0: number,
  y0: number,
  x1: number,
  y1: number,
  box: Box,
  out: [number, number],
): boolean {
  out[0] = 0;
  out[1] = 1;
  const hits =
    boundBySide(x0 - x1, x0 - box.x0, out) &&
    boundBySide(x1 - x0, box.x1 - x0, out) &&
    boundBySide(y0 - y1, y0 - box.y0, out) &&
    boundBySide(y1 - y0, box.y1 - y0, out);
  return hits && out[0] <= out[1];
}

/**
 * Applies one side: t · p ≤ q, with p the rate towards the side and q the distance to it. False if the whole segment is
 * beyond it.
 */
function boundBySide(p: number, q: number, out: [number, number]): boolean {
  if (p === 0) return q >= 0;
  if (p < 0) out[0] = Math.max(out[0], q / p);
  else out[1] = Math.min(out[1], q / p);
  return true;
}

const clamped = (value: number, low: number, high: number): number => Math.min(Math.max(value, low), high);

/** Drops pieces that only touch the border: they would become dots that are not in the drawing. */
function endPiece(builder: LineBuilder, tag: number): void {
  if (builder.openPoints < 2) builder.drop();
  else builder.end(tag);
}
