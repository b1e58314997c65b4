/**
 * Order "fast": always on to the nearest end that is left. Either end of an open line will do, and any
 * point of a closed one. Over a k-d tree: n log n, 20 000 strokes in some hundredths of a second.
 */
import { PointIndex } from "../geometry/point-index.js";
import { isClosedLine, type Lines } from "../geometry/polyline.js";
import type { Tour } from "./tour.js";
import { stopIfCancelled, type Work } from "./work.js";

/**
 * Orders lines [first, end), writing into `tour` (same range of `order`), beginning at a place (mm).
 * Closed lines are begun at any point, or without `freeStart` at their own. Answers where the pen ends.
 */
export function nearestOrder(
  lines: Lines,
  first: number,
  end: number,
  from: { readonly x: number; readonly y: number },
  freeStart: boolean,
  tour: Tour,
  work: Work,
): { readonly x: number; readonly y: number } {
  const entries = entriesOf(lines, first, end, freeStart);
  const index = new PointIndex(entries.xy);
  let exit = -1;
  for (let k = first; k < end; k++) {
    if ((k & 1023) === 0) stopIfCancelled(work);
    const entry = exit < 0 ? index.nearest(from.x, from.y) : index.nearestTo(exit);
    const line = entries.line[entry];
    const low = entries.firstOf[line - first];
    const high = entries.firstOf[line - first + 1];
    for (let e = low; e < high; e++) index.remove(e);
    tour.order[k] = line;
    const closed = isClosedLine(lines, line);
    tour.start[line] = closed ? entry - low : 0;
    tour.reversed[line] = !closed && entry > low ? 1 : 0;
    exit = closed ? entry : low + high - 1 - entry;
  }
  return exit < 0 ? from : { x: entries.xy[2 * exit], y: entries.xy[2 * exit + 1] };
}

interface Entries {
  readonly xy: Float64Array;
  /** Line of each entry. */
  readonly line: Uint32Array;
  /** Line `first + i` has entries [firstOf[i], firstOf[i + 1]). */
  readonly firstOf: Uint32Array;
}

/** Every point at which a line can be begun: both ends, one for a dot, all corners of a closed line. */
function entriesOf(lines: Lines, first: number, end: number, freeStart: boolean): Entries {
  const { xy, offsets } = lines;
  const firstOf = new Uint32Array(end - first + 1);
  for (let i = first; i < end; i++) {
    const points = offsets[i + 1] - offsets[i];
    let entries = points;
    if (points > 2) entries = !isClosedLine(lines, i) ? 2 : freeStart ? points - 1 : 1;
    firstOf[i - first + 1] = firstOf[i - first] + entries;
  }
  const places = new Float64Array(2 * firstOf[end - first]);
  const line = new Uint32Array(firstOf[end - first]);
  for (let i = first; i < end; i++) {
    const from = firstOf[i - first];
    const to = firstOf[i - first + 1];
    const isOpen = to - from === 2 && !isClosedLine(lines, i);
    for (let e = from; e < to; e++) {
      const p = isOpen && e > from ? offsets[i + 1] - 1 : offsets[i] + e - from;
      places[2 * e] = xy[2 * p];
      places[2 * e + 1] = xy[2 * p + 1];
      line[e] = i;
    }
  }
  return { xy: places, line, firstOf };
}
