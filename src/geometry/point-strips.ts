/**
 * Points in strips, for asking again and again which point left is the nearest, and taking points away.
 *
 *   |  ·  | ·   |   · |      strips of equally many points, side by side in x,
 *   |·    |   · | ·   |      each of them a linked list in the order of y
 *   |   · | q · |  ·  |
 *   | ·   |  ·  |·    |      a question goes up and down from q in its own strip, then in the strips beside it, each time
 *   |  ·  |·    |   · |      only as far as something nearer than what has been found may be
 *
 * Points that are taken away leave their list, so that nobody passes by them any more; they go on pointing to where
 * the list went on, so that a question can begin at them.
 *
 * Points come into strips by columns, many more than strips, counted and filled; in a strip they are sorted by the engine: a
 * y, rounded down to one of many levels, and the point's number make one number. Rounding costs no exactness: the search
 * goes on by as much as it may have put out of order.
 *
 * Evenly spread points are asked about in constant time, others in √n of it at most: no strip is fuller than another,
 * whether points stand in clusters or all at one place.
 */
import { boxOfPoints } from "./box.js";

const COLUMNS = 1 << 12;
/** Integers up to this are exact, and this many levels are enough for anything. */
const MOST_EXACT = 2 ** 53;
const MOST_LEVELS = 2 ** 32;

export class PointStrips {
  /**
   * By place. The places of a strip stand together; before each strip, and behind the last one, is a place without a
   * point, farther than all.
   */
  private readonly xs: Float64Array;
  private readonly ys: Float64Array;
  private readonly ids: Uint32Array;
  private readonly gone: Uint8Array;
  /** The places before and after one in the list; of points taken away, as it was then. */
  private readonly before: Int32Array;
  private readonly after: Int32Array;
  /** By point. */
  private readonly placeOf: Uint32Array;
  /** By strip: how far it reaches. */
  private readonly lows: Float64Array;
  private readonly highs: Float64Array;
  /** Places from one strip to the next. */
  private readonly stride: number;
  /** By how much x and y may be out of order from strip to strip, and in one. */
  private slackX = 0;
  private slackY = 0;

  /** Point i is xy[2i], xy[2i + 1]. */
  constructor(xy: Float64Array) {
    const count = xy.length / 2;
    const perStrip = Math.max(1, Math.ceil(2 * Math.sqrt(count)));
    const strips = Math.ceil(count / perStrip);
    const places = count + strips + 1;
    this.stride = perStrip + 1;
    this.xs = new Float64Array(places).fill(Infinity);
    this.ys = new Float64Array(places).fill(Infinity);
    this.ids = new Uint32Array(places);
    this.gone = new Uint8Array(places);
    this.before = new Int32Array(places);
    this.after = new Int32Array(places);
    this.placeOf = new Uint32Array(count);
    this.lows = new Float64Array(strips);
    this.highs = new Float64Array(strips);
    const { x0, x1, y0, y1 } = boxOfPoints(xy);
    // A point's number is below this.
    const numbers = 2 ** Math.ceil(Math.log2(count + 1));
    const perX = levelsPerMm(x0, x1, COLUMNS);
    const perY = levelsPerMm(y0, y1, Math.min(MOST_EXACT / numbers, MOST_LEVELS));
    this.slackX = perX > 0 ? 2 / perX : 0;
    this.slackY = perY > 0 ? 2 / perY : 0;
    const keys = keysByColumn(xy, x0, perX, y0, perY, numbers);
    for (let strip = 0; strip < strips; strip++) {
      this.fillStrip(strip, keys.subarray(strip * perStrip, (strip + 1) * perStrip).sort(), numbers, xy);
    }
    this.before[places - 1] = places - 2;
  }

  private fillStrip(strip: number, keys: Float64Array, numbers: number, xy: Float64Array): void {
    const { xs, ys, ids, placeOf, before, after } = this;
    let place = strip * this.stride;
    let low = Infinity;
    let high = -Infinity;
    before[place] = place - 1;
    after[place] = place + 1;
    for (let k = 0; k < keys.length; k++) {
      place++;
      const id = keys[k] - Math.floor(keys[k] / numbers) * numbers;
      const x = xy[2 * id];
      if (x < low) low = x;
      if (x > high) high = x;
      xs[place] = x;
      ys[place] = xy[2 * id + 1];
      ids[place] = id;
      placeOf[id] = place;
      before[place] = place - 1;
      after[place] = place + 1;
    }
    this.lows[strip] = low;
    this.highs[strip] = high;
  }

  /** Takes points [first, end) away. */
  removeAll(first: number, end: number): void {
    const { placeOf, before, after, gone } = this;
    for (let id = first; id < end; id++) {
      const place = placeOf[id];
      gone[place] = 1;
      after[before[place]] = after[place];
      before[after[place]] = before[place];
    }
  }

  /** The nearest point left, or −1. */
  nearest(x: number, y: number): number {
    const { highs } = this;
    if (highs.length === 0) return -1;
    let strip = 0;
    while (strip + 1 < highs.length && highs[strip] < x) strip++;
    return this.search(x, y, strip, -1);
  }

  /** The nearest point left to point `id`, itself if that is left; −1 for none. */
  nearestTo(id: number): number {
    const place = this.placeOf[id];
    return this.search(this.xs[place], this.ys[place], Math.floor(place / this.stride), place);
  }

  /** Looks at strip `from` first, from `place` on if that is known. One loop and no calls: it is never compiled twice. */
  private search(qx: number, qy: number, from: number, place: number): number {
    const { xs, ys, gone, before, after, lows, highs, stride, slackX, slackY } = this;
    let best = -1;
    let best2 = Infinity;
    let step = -1;
    for (let strip = from; ;) {
      let first = place;
      if (place < 0) {
        // No point left before the place has a higher y, and none after it a lower one.
        first = after[strip * stride];
        if (ys[first] < qy) {
          let high = Math.min((strip + 1) * stride, ys.length - 1);
          if (ys[before[high]] < qy) first = high;
          while (first < high) {
            const middle = (first + high) >> 1;
            if (ys[middle] < qy) first = middle + 1;
            else high = middle;
          }
        }
      }
      if (gone[first] === 1) {
        const began = first;
        while (gone[first] === 1) first = after[first];
        // The next who begins here has it shorter.
        for (let k = began; k !== first;) {
          const next = after[k];
          after[k] = first;
          k = next;
        }
      }
      for (let k = first; ; k = after[k]) {
        const dy = ys[k] - qy;
        const gap = dy - slackY;
        if (gap > 0 && gap * gap >= best2) break;
        const dx = xs[k] - qx;
        const d2 = dx * dx + dy * dy;
        if (d2 >= best2) continue;
        best = k;
        best2 = d2;
        if (d2 === 0) break;
      }
      for (let k = before[first]; ; k = before[k]) {
        const dy = qy - ys[k];
        // Of the place before the strip it is infinite.
        const gap = Math.abs(dy) - slackY;
        if (best2 === 0 || (gap > 0 && gap * gap >= best2)) break;
        const dx = xs[k] - qx;
        const d2 = dx * dx + dy * dy;
        if (d2 >= best2) continue;
        best = k;
        best2 = d2;
      }
      if (best2 === 0) break;
      // On to the strips before, as long as they are near enough, then to those after.
      place = -1;
      strip += step;
      if (step < 0) {
        const gap = strip < 0 ? Infinity : qx - highs[strip] - slackX;
        if (gap <= 0 || gap * gap < best2) continue;
        step = 1;
        strip = from + 1;
      }
      const gap = strip < lows.length ? lows[strip] - qx - slackX : Infinity;
      if (gap > 0 && gap * gap >= best2) break;
    }
    return best < 0 ? -1 : this.ids[best];
  }
}

/** The points' keys, column by column: level of y × `numbers` + number. */
function keysByColumn(
  xy: Float64Array,
  x0: number,
  perX: number,
  y0: number,
  perY: number,
  numbers: number,
): Float64Array {
  const ends = endsOfColumns(xy, x0, perX);
  const keys = new Float64Array(xy.length / 2);
  for (let i = keys.length - 1; i >= 0; i--) {
    const column = Math.floor((xy[2 * i] - x0) * perX);
    keys[--ends[column]] = Math.floor((xy[2 * i + 1] - y0) * perY) * numbers + i;
  }
  return keys;
}

/** How many points stand in each column and in those before it. */
function endsOfColumns(xy: Float64Array, x0: number, perX: number): Uint32Array {
  const ends = new Uint32Array(COLUMNS);
  for (let k = 0; k < xy.length; k += 2) ends[Math.floor((xy[k] - x0) * perX)]++;
  let end = 0;
  for (let column = 0; column < COLUMNS; column++) end = ends[column] += end;
  return ends;
}

/** 0 where there is nothing to tell apart. */
function levelsPerMm(from: number, to: number, levels: number): number {
  const perMm = (levels - 1) / (to - from);
  return perMm < Infinity ? perMm : 0;
}
