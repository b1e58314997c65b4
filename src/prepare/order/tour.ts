/**
 * A tour: the order, direction and start point of each line, and the pen's travel for it. The pen starts at
 * home (0, 0) and returns there. Lengths in mm.
 */
import { LineBuilder, distance, isClosedLine, lineCount, type Lines } from "../../geometry/polyline.js";

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
  return {
    order: new Uint32Array(count).map((_, i) => i),
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
  let x = 0;
  let y = 0;
  let travel = 0;
  for (const i of tour.order) {
    const entry = 2 * entryPoint(lines, tour, i);
    travel += distance(x, y, xy[entry], xy[entry + 1]);
    const exit = 2 * exitPoint(lines, tour, i);
    x = xy[exit];
    y = xy[exit + 1];
  }
  return travel + distance(x, y, 0, 0);
}

/** The same travel for the lines in their current order. */
export const travelAsDrawn = (lines: Lines): number => travelOf(lines, fileTour(lines));

/** The lines in the order and direction of the tour. */
export function linesOfTour(lines: Lines, tour: Tour): Lines {
  const builder = new LineBuilder();
  for (const i of tour.order) {
    if (tour.start[i] > 0 && isClosedLine(lines, i)) builder.copyFrom(lines, i, tour.start[i]);
    else builder.copy(lines, i, lines.tag[i], tour.reversed[i] === 1);
  }
  return builder.finish();
}
