/** Changes the points of lines: simplifies and smooths them, and moves the start points of closed lines. */
import { LineBuilder, isClosedLine, lineCount, type Lines, nearestShare } from "../../geometry/polyline.js";
import { randomFrom } from "../work.js";

/**
 * Removes points: none of them is farther than `tolerance` mm from the new line, and end points stay. Douglas and
 * Peucker's method, with a work list instead of recursion. (D. Douglas, T. Peucker, The Canadian Cartographer 10(2), 1973)
 *
 *        ·  far
 *      /   \           if the point farthest from the chord is farther than the tolerance, it stays, and both
 *  a ·-------· b       halves are checked again; otherwise all points between a and b are dropped
 *
 * The distance is measured to the chord as a segment, so a line that doubles back keeps its turning point.
 */
export function simplifyLines(lines: Lines, tolerance: number): Lines {
  if (!(tolerance > 0)) return lines;
  const builder = new LineBuilder();
  for (let i = 0; i < lineCount(lines); i++) {
    const first = lines.offsets[i];
    const points = lines.offsets[i + 1] - first;
    const keep = keptPoints(lines.xy, first, points, tolerance);
    for (let k = 0; k < points; k++) {
      if (keep[k] === 1) builder.point(lines.xy[2 * (first + k)], lines.xy[2 * (first + k) + 1]);
    }
    builder.end(lines.tag[i]);
  }
  return builder.finish();
}

function keptPoints(xy: Float64Array, first: number, points: number, tolerance: number): Uint8Array {
  const keep = new Uint8Array(points);
  keep[0] = keep[points - 1] = 1;
  const todo: number[] = [0, points - 1];
  while (todo.length > 0) {
    const b = todo.pop() as number;
    const a = todo.pop() as number;
    let far = -1;
    let far2 = tolerance * tolerance;
    for (let k = a + 1; k < b; k++) {
      const d2 = distance2ToSegment(xy, first + k, first + a, first + b);
      if (d2 > far2) {
        far2 = d2;
        far = k;
      }
    }
    if (far < 0) continue;
    keep[far] = 1;
    todo.push(a, far, far, b);
  }
  return keep;
}

function distance2ToSegment(xy: Float64Array, p: number, a: number, b: number): number {
  const [x0, y0, x1, y1] = [xy[2 * a], xy[2 * a + 1], xy[2 * b], xy[2 * b + 1]];
  const [x, y] = [xy[2 * p], xy[2 * p + 1]];
  const t = nearestShare(x0, y0, x1, y1, x, y);
  const ex = x - x0 - t * (x1 - x0);
  const ey = y - y0 - t * (y1 - y0);
  return ex * ex + ey * ey;
}

/**
 * Corner cutting (G. Chaikin, 1974): each round shortens every segment to its middle half and connects these by new
 * segments. The limit is a quadratic B-spline. Open lines keep their end points, closed lines stay closed.
 */
export function smoothLines(lines: Lines, rounds: number): Lines {
  let smooth = lines;
  for (let round = 0; round < rounds; round++) smooth = cutCorners(smooth);
  return smooth;
}

function cutCorners(lines: Lines): Lines {
  const builder = new LineBuilder();
  for (let i = 0; i < lineCount(lines); i++) {
    const first = lines.offsets[i];
    const last = lines.offsets[i + 1] - 1;
    if (last - first < 2) builder.copy(lines, i, lines.tag[i]);
    else cutLineCorners(lines, i, builder);
  }
  return builder.finish();
}

function cutLineCorners(lines: Lines, i: number, builder: LineBuilder): void {
  const { xy, offsets } = lines;
  const first = offsets[i];
  const last = offsets[i + 1] - 1;
  const closed = isClosedLine(lines, i);
  const between = (p: number, t: number): void => {
    const x = xy[2 * p] + t * (xy[2 * p + 2] - xy[2 * p]);
    const y = xy[2 * p + 1] + t * (xy[2 * p + 3] - xy[2 * p + 1]);
    builder.point(x, y);
  };
  if (!closed) builder.point(xy[2 * first], xy[2 * first + 1]);
  for (let p = first; p < last; p++) {
    if (closed || p > first) between(p, 0.25);
    if (closed || p < last - 1) between(p, 0.75);
  }
  if (closed) between(first, 0.25);
  else builder.point(xy[2 * last], xy[2 * last + 1]);
  builder.end(lines.tag[i]);
}

/** Starts closed lines at a random point, the same one in every run. */
export function reloopLines(lines: Lines): Lines {
  const random = randomFrom(1);
  const builder = new LineBuilder();
  for (let i = 0; i < lineCount(lines); i++) {
    if (!isClosedLine(lines, i)) {
      builder.copy(lines, i, lines.tag[i]);
      continue;
    }
    const segments = lines.offsets[i + 1] - 1 - lines.offsets[i];
    builder.copyFrom(lines, i, Math.floor(random() * segments));
  }
  return builder.finish();
}
