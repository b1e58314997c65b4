/** A layer drawn more than once: for more ink, with no more travel than it takes. */
import { LineBuilder, distance, type Lines } from "../geometry/polyline.js";
import { tagRanges } from "./tour.js";

/**
 * Each tag's lines as often as `passesOf` tells. Every second pass goes back the way the pen came, last line
 * first and each backwards, where that saves travel: it begins where the pass before ends.
 */
export function repeatLines(lines: Lines, passesOf: (tag: number) => number): Lines {
  const ranges = tagRanges(lines);
  if (ranges.every(([first]) => passesOf(lines.tag[first]) <= 1)) return lines;
  const builder = new LineBuilder();
  ranges.forEach(([first, end], k) => {
    const passes = passesOf(lines.tag[first]);
    const back = goesBack(lines, first, end, passes, ranges[k + 1]?.[0] ?? null);
    for (let pass = 0; pass < passes; pass++) copyPass(lines, first, end, back && pass % 2 === 1, builder);
  });
  return builder.finish();
}

/** Whether back and forth is less travel than beginning anew each time, the way to the next tag counted. */
function goesBack(lines: Lines, first: number, end: number, passes: number, next: number | null): boolean {
  const { xy, offsets } = lines;
  const start = offsets[first];
  const stop = offsets[end] - 1;
  const to = next === null ? null : offsets[next];
  const way = (a: number, b: number | null): number =>
    distance(xy[2 * a], xy[2 * a + 1], b === null ? 0 : xy[2 * b], b === null ? 0 : xy[2 * b + 1]);
  const anew = (passes - 1) * way(stop, start) + way(stop, to);
  return way(passes % 2 === 0 ? start : stop, to) <= anew;
}

function copyPass(lines: Lines, first: number, end: number, back: boolean, builder: LineBuilder): void {
  for (let k = 0; k < end - first; k++) {
    const i = back ? end - 1 - k : first + k;
    builder.copy(lines, i, lines.tag[i], back);
  }
}
