/** The order in which lines are drawn, and layers that are drawn more than once. */
import { tagRanges, type Lines, LineBuilder, distance } from "../../geometry/polyline.js";
import { improveTour } from "./best-order.js";
import { nearestOrder } from "./nearest.js";
import type { PrepareSettings } from "../../settings/prepare.js";
import { spreadLines } from "./spread.js";
import { fileTour, linesOfTour, travelAsDrawn, travelOf, type Tour } from "./tour.js";
import type { Work } from "../work.js";

/** Lines in drawing order, each as often as its layer is drawn, and the travel before and after ordering. */
interface Ordered {
  readonly lines: Lines;
  readonly travelMmUnordered: number;
  readonly travelMm: number;
}

/** Lines of one tag (a part of a layer) must be contiguous. The tags stay in the same order. */
export function inDrawingOrder(
  lines: Lines,
  passesOf: (tag: number) => number,
  settings: PrepareSettings,
  work: Work,
): Ordered {
  const asInFile = repeatLines(lines, passesOf);
  const travelMmUnordered = travelAsDrawn(asInFile);
  const tour = shortTour(lines, settings, work);
  const inOrder = repeatLines(spreadLines(linesOfTour(lines, tour), settings.spread), passesOf);
  const travelMm = travelAsDrawn(inOrder);
  // With several passes, an order with less travel per pass may need more travel between passes.
  if (settings.spread === "none" && travelMm > travelMmUnordered) {
    return { lines: asInFile, travelMmUnordered, travelMm: travelMmUnordered };
  }
  return { lines: inOrder, travelMmUnordered, travelMm };
}

/** A tour with less pen-up travel. The file's order if that has the least. */
function shortTour(lines: Lines, { order, orderS, reloop }: PrepareSettings, work: Work): Tour {
  const tour = fileTour(lines);
  if (order === "none") return tour;
  let pen = { x: 0, y: 0 };
  for (const [first, end] of tagRanges(lines)) {
    pen = nearestOrder(lines, first, end, pen, !reloop, tour, work);
  }
  if (order === "best") improveTour(lines, tour, !reloop, orderS, work);
  return travelOf(lines, tour) <= travelAsDrawn(lines) ? tour : fileTour(lines);
}

/**
 * Repeats each tag's lines `passesOf` times. If it saves travel, every second pass is drawn backwards (last line first,
 * each line reversed), because it then begins where the previous pass ends.
 */
function repeatLines(lines: Lines, passesOf: (tag: number) => number): Lines {
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
