/**
 * A tour: the order, direction and start point of each line, and the pen's travel for it. The pen starts at
 * home (0, 0) and returns there. Lengths in mm.
 */
import { LineBuilder, distance, isClosedLine, lineCount, type Lines } from "../geometry/polyline.js";

export interface Tour {
  /** Line indices in drawing order. */
  readonly order: Uint32Array;
  /** 1 if a line is drawn backwards; by line index. */
  readonly reversed: Uint8Array;
  /** For closed lines the start point, counted from the line's first point; by line index. */
  readonly start: Uint32Array;
}

/** The lines in their current order. */
export function fileTour(lines: Lines): Tour {
  const count = lineCount(lines);
  const order = new Uint32Array(count);
  for (let i = 0; i < count; i++) order[i] = i;
  return {
    order,
    reversed: new Uint8Array(count),
    start: new Uint32Array(count),
  };
}

/** Index of the point where the pen comes down for line `i`. */
export function entryPoint(lines: Lines, tour: Tour, i: number): number {
  if (tour.start[i] > 0) return lines.offsets[i] + tour.start[i];
  return tour.reversed[i] === 1 ? lines.offsets[i + 1] - 1 : lines.offsets[i];
}

/** Index of the point where the pen is lifted. */
export function exitPoint(lines: Lines, tour: Tour, i: number): number {
  if (tour.start[i] > 0) return lines.offsets[i] + tour.start[i];
  return tour.reversed[i] === 1 ? lines.offsets[i] : lines.offsets[i + 1] - 1;
}

/** Pen-up travel from home through all lines and back home, mm. */
export function travelOf(lines: Lines, tour: Tour): number {
  const { xy } = lines;
  const { order } = tour;
  let x = 0;
  let y = 0;
  let travel = 0;
  for (let k = 0; k < order.length; k++) {
    const i = order[k];
    const entry = 2 * entryPoint(lines, tour, i);
    travel += distance(x, y, xy[entry], xy[entry + 1]);
    const exit = 2 * exitPoint(lines, tour, i);
    x = xy[exit];
    y = xy[exit + 1];
  }
  return order.length > 0 ? travel + distance(x, y, 0, 0) : 0;
}

/** The same travel for the lines in their current order. */
export function travelAsDrawn(lines: Lines): number {
  const { xy, offsets } = lines;
  const count = lineCount(lines);
  let x = 0;
  let y = 0;
  let travel = 0;
  for (let i = 0; i < count; i++) {
    const entry = 2 * offsets[i];
    travel += distance(x, y, xy[entry], xy[entry + 1]);
    const exit = 2 * offsets[i + 1] - 2;
    x = xy[exit];
    y = xy[exit + 1];
  }
  return count > 0 ? travel + distance(x, y, 0, 0) : 0;
}

/** The lines in the order and direction of the tour. */
export function linesOfTour(lines: Lines, tour: Tour): Lines {
  const builder = new LineBuilder();
  const { order } = tour;
  for (let k = 0; k < order.length; k++) {
    const i = order[k];
    if (tour.start[i] > 0 && isClosedLine(lines, i)) copyFrom(lines, i, tour.start[i], builder);
    else builder.copy(lines, i, lines.tag[i], tour.reversed[i] === 1);
  }
  return builder.finish();
}

/** Copies a closed line from another start point. */
function copyFrom(lines: Lines, i: number, start: number, builder: LineBuilder): void {
  const { xy, offsets } = lines;
  const first = offsets[i];
  const segments = offsets[i + 1] - 1 - first;
  for (let k = 0; k <= segments; k++) {
    const p = first + ((start + k) % segments);
    builder.point(xy[2 * p], xy[2 * p + 1]);
  }
  builder.end(lines.tag[i]);
}

/** Ranges [first, end) of lines that share a tag; lines of one tag are contiguous. */
export function tagRanges({ tag }: Lines): [number, number][] {
  const count = tag.length;
  const ranges: [number, number][] = [];
  for (let first = 0, end = 0; first < count; first = end) {
    while (end < count && tag[end] === tag[first]) end++;
    ranges.push([first, end]);
  }
  return ranges;
}
