/** Repeats layers that are drawn more than once, for more ink, with little travel. */
import { LineBuilder, distance, tagRanges, type Lines } from "../geometry/polyline.js";

/**
 * Repeats each tag's lines `passesOf` times. If it saves travel, every second pass is drawn backwards (last line first,
 * each line reversed), because it then begins where the previous pass ends.
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

/**
 * Whether drawing back and forth takes less travel than starting from the same end each time, including the travel to
 * the next tag.
 */
function goesBack(lines: Lines, first: number, end: number, passes: number, next: number | null): boolean {
  const { xy, offsets } = lines;
  const start = offsets[first];
  const stop = offsets[end] - 1;
  const to = next === null ? null : offsets[next];
  const travel = (a: number, b: number | null): number =>
    distance(xy[2 * a], xy[2 * a + 1], b === null ? 0 : xy[2 * b], b === null ? 0 : xy[2 * b + 1]);
  const forwards = (passes - 1) * travel(stop, start) + travel(stop, to);
  return travel(passes % 2 === 0 ? start : stop, to) <= forwards;
}

function copyPass(lines: Lines, first: number, end: number, back: boolean, builder: LineBuilder): void {
  for (let k = 0; k < end - first; k++) {
    const i = back ? end - 1 - k : first + k;
    builder.copy(lines, i, lines.tag[i], back);
  }
}
