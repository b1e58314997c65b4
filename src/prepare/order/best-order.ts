/**
 * Order "best": starts from the order "fast" and improves it until the time is up.
 *
 * It works layer by layer, each from the end of the previous layer to the start of the next, so that every gain within a
 * layer is a gain overall. A closed line is treated as a point, its start point. Between rounds of the search, the start
 * point of each closed line moves to the corner closest to its neighbours.
 *
 * With a clock the search ends after `orderS`. Without one it ends after about the same amount of work, and every run
 * has the same result. So the page, the server and a job resumed after a crash have the same strokes.
 */
import { distance, isClosedLine, tagRanges, type Lines } from "../../geometry/polyline.js";
import { randomFrom, stopIfCancelled, type Work } from "../work.js";
import { improveBlocks } from "./tour-blocks.js";
import { TourSearch } from "./tour-search.js";
import { entryPoint, exitPoint, type Tour } from "./tour.js";

/** Kicks that count as one second when there is no clock: about the speed of a desktop computer. */
const KICKS_PER_S = 70_000;
/** Max kicks per stroke: a small drawing reaches its best order long before the time is up. */
const MAX_KICKS = 1_000;
const ENDS_PER_CHECK = 4_096;
/** Longer tours are searched only in blocks: reversing sections of the whole tour would take all the time. */
const MAX_WHOLE_TOUR = 50_000;
/** Share of the time for searching the whole ring at once. */
const FIRST_SHARE = 0.3;

/** Improves `tour` in place. `seconds` is the time limit, measured by `work.nowS`. */
export function improveTour(lines: Lines, tour: Tour, freeStart: boolean, seconds: number, work: Work): void {
  const ranges = tagRanges(lines);
  const total = tour.order.length;
  const startS = work.nowS?.() ?? 0;
  let done = 0;
  ranges.forEach(([first, end], k) => {
    const budget = new Budget(
      work,
      startS + (seconds * done) / total,
      (seconds * (end - first)) / total,
      total,
      done,
      end - first,
    );
    const from = first === 0 ? HOME : exitOf(lines, tour, tour.order[first - 1]);
    const to = k + 1 === ranges.length ? HOME : entryOf(lines, tour, tour.order[end]);
    improveRange(lines, tour, first, end, from, to, freeStart, budget);
    done += end - first;
  });
}

interface Point {
  readonly x: number;
  readonly y: number;
}

const HOME: Point = { x: 0, y: 0 };

const pointAt = (lines: Lines, p: number): Point => ({ x: lines.xy[2 * p], y: lines.xy[2 * p + 1] });
const entryOf = (lines: Lines, tour: Tour, i: number): Point => pointAt(lines, entryPoint(lines, tour, i));
const exitOf = (lines: Lines, tour: Tour, i: number): Point => pointAt(lines, exitPoint(lines, tour, i));

/** The search budget of one layer, and the progress reports. */
class Budget {
  constructor(
    private readonly work: Work,
    private readonly startS: number,
    private readonly seconds: number,
    private readonly totalStrokes: number,
    private readonly strokesBefore: number,
    readonly strokes: number,
  ) {}

  get kicks(): number {
    const max = this.strokes * MAX_KICKS;
    return this.work.nowS ? max : Math.max(1, Math.min(max, this.seconds * KICKS_PER_S));
  }

  /** Share of the budget used after `kicks` kicks, 0 … 1; throws when cancelled. */
  used(kicks: number): number {
    stopIfCancelled(this.work);
    if (this.work.enough?.aborted) return 1;
    const byTime = this.work.nowS ? (this.work.nowS() - this.startS) / this.seconds : 0;
    const share = Math.min(Math.max(byTime, kicks / this.kicks), 1);
    this.work.onProgress?.((this.strokesBefore + share * this.strokes) / this.totalStrokes, "ordering");
    return share;
  }
}

function improveRange(
  lines: Lines,
  tour: Tour,
  first: number,
  end: number,
  from: Point,
  to: Point,
  freeStart: boolean,
  budget: Budget,
): void {
  const count = end - first;
  if (count < 2) return;
  const ring = new Int32Array(2 * count + 2);
  const xy = new Float64Array(2 * ring.length);
  // This stroke represents the rest of the plot: it begins where this layer ends, and ends where this layer begins.
  ring.set([2 * count, 2 * count + 1]);
  xy.set([to.x, to.y, from.x, from.y], 4 * count);
  for (let k = 0; k < count; k++) {
    const i = tour.order[first + k];
    const backwards = tour.reversed[i];
    ring[2 * k + 2] = 2 * (i - first) + backwards;
    ring[2 * k + 3] = 2 * (i - first) + 1 - backwards;
    setEnds(lines, tour, i, first, xy);
  }
  search(ring, xy, budget, () => freeStart && restartClosed(lines, tour, ring, first, count, xy));
  readRing(tour, ring, first);
}

/**
 * Searches the whole ring first, then block by block until the time is up. `beginClosed` may change where
 * closed lines begin.
 */
function search(ring: Int32Array, xy: Float64Array, budget: Budget, beginClosed: () => boolean): void {
  const random = randomFrom(3);
  let kicks = 0;
  do {
    if (ring.length <= 2 * MAX_WHOLE_TOUR) {
      const whole = new TourSearch(xy, ring, random);
      while (!whole.improve(ENDS_PER_CHECK) && budget.used(kicks) < 1) continue;
      setHomeFirst(ring, whole.ring);
    }
  } while (beginClosed() && budget.used(kicks++) < FIRST_SHARE);
  const hasTime = (more: number): boolean => budget.used((kicks += more)) < 1;
  while (hasTime(0) && improveBlocks(ring, xy, random, hasTime)) beginClosed();
  beginClosed();
}

/** Copies a ring so that home, the stroke with the highest number, comes first and is entered at its even end. */
function setHomeFirst(ring: Int32Array, found: Int32Array): void {
  const home = found.length - 2;
  const place = found.indexOf(home);
  const step = (place & 1) === 0 ? 1 : found.length - 1;
  for (let k = 0, p = place; k < found.length; k++, p = (p + step) % found.length) ring[k] = found[p];
}

/** Sets the coordinates of both ends of line `i`; for a closed line both are its start point. */
function setEnds(lines: Lines, tour: Tour, i: number, first: number, xy: Float64Array): void {
  const closed = isClosedLine(lines, i);
  const a = lines.offsets[i] + tour.start[i];
  const b = closed ? a : lines.offsets[i + 1] - 1;
  xy.set([lines.xy[2 * a], lines.xy[2 * a + 1], lines.xy[2 * b], lines.xy[2 * b + 1]], 4 * (i - first));
}

/** Starts each closed line at the corner closest to its neighbours in the ring; returns true if any start has moved. */
function restartClosed(
  lines: Lines,
  tour: Tour,
  ring: Int32Array,
  first: number,
  count: number,
  xy: Float64Array,
): boolean {
  let moved = false;
  for (let p = 0; p < ring.length; p += 2) {
    const stroke = ring[p] >> 1;
    if (stroke === count || !isClosedLine(lines, first + stroke)) continue;
    const i = first + stroke;
    const start = bestStart(lines, i, xy, ring[p - 1], ring[(p + 2) % ring.length]);
    if (start === tour.start[i]) continue;
    tour.start[i] = start;
    setEnds(lines, tour, i, first, xy);
    moved = true;
  }
  return moved;
}

function bestStart(lines: Lines, i: number, xy: Float64Array, before: number, after: number): number {
  const first = lines.offsets[i];
  let best = 0;
  let shortest = Infinity;
  for (let p = first; p < lines.offsets[i + 1] - 1; p++) {
    const x = lines.xy[2 * p];
    const y = lines.xy[2 * p + 1];
    const travel =
      distance(x, y, xy[2 * before], xy[2 * before + 1]) + distance(x, y, xy[2 * after], xy[2 * after + 1]);
    if (travel < shortest) {
      shortest = travel;
      best = p - first;
    }
  }
  return best;
}

/** Writes the ring, which begins with home, into the tour. */
function readRing(tour: Tour, ring: Int32Array, first: number): void {
  for (let p = 2; p < ring.length; p += 2) {
    const i = first + (ring[p] >> 1);
    tour.order[first + p / 2 - 1] = i;
    tour.reversed[i] = ring[p] & 1;
  }
}
