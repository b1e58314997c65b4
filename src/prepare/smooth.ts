/** Smooths lines, and moves the start points of closed lines. */
import { LineBuilder, isClosedLine, lineCount, type Lines } from "../geometry/polyline.js";
import { randomFrom } from "./random.js";

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
