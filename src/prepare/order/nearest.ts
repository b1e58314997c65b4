/**
 * Order "fast": the next line is always the one with the nearest end. A line can start at either end, a closed one at
 * any point.
 */
import { NearestPoints, PointGrid } from "../../geometry/point-grid.js";
import { isClosedLine, type Lines } from "../../geometry/polyline.js";
import type { Tour } from "./tour.js";
import { stopIfCancelled, type Work } from "../work.js";

/** The pen's position, mm. */
interface PenPosition {
  readonly x: number;
  readonly y: number;
}

/**
 * Orders lines [first, end) from a start position (mm), and writes them to the same range of `tour.order`. With
 * `freeStart`, a closed line may start at any point. Returns the final position of the pen.
 */
export function nearestOrder(
  lines: Lines,
  first: number,
  end: number,
  from: PenPosition,
  freeStart: boolean,
  tour: Tour,
  work: Work,
): PenPosition {
  const entries = entriesOf(lines, first, end, freeStart);
  const points = new PointGrid(entries.xy);
  const nearest = new NearestPoints(1);
  const { xy } = entries;
  let { x, y } = from;
  for (let k = first; k < end; k++) {
    if ((k & 1023) === 0) stopIfCancelled(work);
    points.find(x, y, Infinity, nearest);
    const entry = nearest.ids[0];
    const line = entries.line[entry];
    const low = entries.firstOf[line - first];
    const high = entries.firstOf[line - first + 1];
    for (let e = low; e < high; e++) points.remove(e);
    const closed = entries.isClosed[line - first] === 1;
    tour.order[k] = line;
    tour.start[line] = closed ? entry - low : 0;
    tour.reversed[line] = !closed && entry > low ? 1 : 0;
    const exit = closed ? entry : low + high - 1 - entry;
    x = xy[2 * exit];
    y = xy[2 * exit + 1];
  }
  return { x, y };
}

interface Entries {
  readonly xy: Float64Array;
  /** Line of each entry. */
  readonly line: Uint32Array;
  /** Line `first + i` has entries [firstOf[i], firstOf[i + 1]). */
  readonly firstOf: Uint32Array;
  /** 1 for a closed line. */
  readonly isClosed: Uint8Array;
}

/** All points where a line can start: both ends, the point of a dot, all points of a closed line with `freeStart`. */
function entriesOf(lines: Lines, first: number, end: number, freeStart: boolean): Entries {
  const { xy, offsets } = lines;
  const maxEntries = offsets[end] - offsets[first];
  const firstOf = new Uint32Array(end - first + 1);
  const places = new Float64Array(2 * maxEntries);
  const line = new Uint32Array(maxEntries);
  const closed = new Uint8Array(end - first);
  let count = 0;
  const add = (i: number, p: number): void => {
    line[count] = i;
    places[2 * count] = xy[2 * p];
    places[2 * count + 1] = xy[2 * p + 1];
    count++;
  };
  for (let i = first; i < end; i++) {
    const from = offsets[i];
    const last = offsets[i + 1] - 1;
    const isClosed = isClosedLine(lines, i);
    if (isClosed) closed[i - first] = 1;
    const until = isClosed && freeStart ? last : from + 1;
    for (let p = from; p < until; p++) add(i, p);
    if (!isClosed && last > from) add(i, last);
    firstOf[i - first + 1] = count;
  }
  return { xy: places.subarray(0, 2 * count), line, firstOf, isClosed: closed };
}
