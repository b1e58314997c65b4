/**
 * Points in strips, for repeated queries for the nearest remaining point, with removal of points.
 *
 *   |  ·  | ·   |   · |      strips of equally many points, side by side in x,
 *   |·    |   · | ·   |      each a linked list sorted by y
 *   |   · | q · |  ·  |
 *   | ·   |  ·  |·    |      a search goes up and down from q in its own strip, then in the adjacent ones,
 *   |  ·  |·    |   · |      each time only as far as a nearer point than the best so far can be
 *
 * Removed points are unlinked from their list, so that searches no longer visit them. They keep their own
 * links, so that a search can start at a removed point.
 *
 * To build, a counting sort by x puts the points into many more columns than there are strips; then each
 * strip takes the next points in that order. Within a strip the built-in sort orders keys made of the y,
 * rounded down to one of many levels, and the point's number. Results stay exact: a search extends as far as
 * rounding may have changed the order (slackX, slackY).
 *
 * A search takes constant time for evenly spread points, and at most about √n otherwise: all strips hold
 * equally many points, even if the points are clustered or all coincide.
 */
import { boxOfPoints } from "./box.js";

const COLUMNS = 1 << 12;
/** Integers up to this are exact in a double. */
const MAX_EXACT = 2 ** 53;
/** Levels of y; finer ones would not make the search faster. */
const MAX_LEVELS = 2 ** 32;

export class PointStrips {
  /**
   * By place. The places of a strip are contiguous. One place without a point precedes each strip and one
   * follows the last; its coordinates are infinite.
   */
  private readonly xs: Float64Array;
  private readonly ys: Float64Array;
  private readonly ids: Uint32Array;
  private readonly gone: Uint8Array;
  /** The previous and next place in the list; for removed points, as they were at removal. */
  private readonly before: Int32Array;
  private readonly after: Int32Array;
  /** By point. */
  private readonly placeOf: Uint32Array;
  /** By strip: its min and max x. */
  private readonly lows: Float64Array;
  private readonly highs: Float64Array;
  /** Places from one strip to the next. */
  private readonly stride: number;
  /** By how much x may be out of order between strips, and y within a strip. */
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
    // Every point number is below this power of two.
    const numbers = 2 ** Math.ceil(Math.log2(count + 1));
    const perX = levelsPerMm(x0, x1, COLUMNS);
    const perY = levelsPerMm(y0, y1, Math.min(MAX_EXACT / numbers, MAX_LEVELS));
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

  /** Removes points [first, end). */
  removeAll(first: number, end: number): void {
    const { placeOf, before, after, gone } = this;
    for (let id = first; id < end; id++) {
      const place = placeOf[id];
      gone[place] = 1;
      after[before[place]] = after[place];
      before[after[place]] = before[place];
    }
  }

  /** The nearest remaining point, or −1. */
  nearest(x: number, y: number): number {
    const { highs } = this;
    if (highs.length === 0) return -1;
    let strip = 0;
    while (strip + 1 < highs.length && highs[strip] < x) strip++;
    return this.search(x, y, strip, -1);
  }

  /** The remaining point nearest to point `id`: `id` itself unless it was removed; −1 if none remains. */
  nearestTo(id: number): number {
    const place = this.placeOf[id];
    return this.search(this.xs[place], this.ys[place], Math.floor(place / this.stride), place);
  }

  /**
   * Searches strip `from` first, starting at `place` if it is known (≥ 0). One loop without calls, so that
   * the engine optimizes it only once.
   */
  private search(qx: number, qy: number, from: number, place: number): number {
    const { xs, ys, gone, before, after, lows, highs, stride, slackX, slackY } = this;
    let best = -1;
    let best2 = Infinity;
    let step = -1;
    for (let strip = from; ;) {
      let first = place;
      if (place < 0) {
        // Find the place that splits the strip at qy: lower y before it, higher y from it on.
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
        // Path compression: the next search that starts here skips the removed points at once.
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
        // At the place before the strip, dy is −Infinity and the gap infinite.
        const gap = Math.abs(dy) - slackY;
        if (best2 === 0 || (gap > 0 && gap * gap >= best2)) break;
        const dx = xs[k] - qx;
        const d2 = dx * dx + dy * dy;
        if (d2 >= best2) continue;
        best = k;
        best2 = d2;
      }
      if (best2 === 0) break;
      // Continue with the strips before, as long as they are near enough, then with those after.
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

/** The points' sort keys, column by column: level of y × `numbers` + point number. */
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

/** How many points lie in each column and all columns before it. */
function endsOfColumns(xy: Float64Array, x0: number, perX: number): Uint32Array {
  const ends = new Uint32Array(COLUMNS);
  for (let k = 0; k < xy.length; k += 2) ends[Math.floor((xy[k] - x0) * perX)]++;
  let end = 0;
  for (let column = 0; column < COLUMNS; column++) end = ends[column] += end;
  return ends;
}

/** 0 if all values are equal. */
function levelsPerMm(from: number, to: number, levels: number): number {
  const perMm = (levels - 1) / (to - from);
  return perMm < Infinity ? perMm : 0;
}
