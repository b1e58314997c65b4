/**
 * Points in a grid of square cells. Finds the points nearest to a position. Points can be removed one by one.
 *
 *   3 3 3 3 3     A search scans the cell of the query point, then the ring of cells around it, and so on,
 *   3 2 2 2 3     until no cell is left that is closer than the points found. The points of a cell are a
 *   3 2 1 2 3     linked list in ascending order.
 *   3 2 2 2 3
 *   3 3 3 3 3
 *
 * A query takes constant time for evenly spread points. In crowded areas it scans more points. Flatbush, the index of
 * boxes elsewhere, can't remove entries: a search would pass all strokes that are already drawn.
 */
import { boxOfPoints } from "./box.js";
import { clamp } from "./polyline.js";

/**
 * Mean number of points in a cell. A larger number would be slower where points are crowded, a smaller one where they
 * are not.
 */
const POINTS_IN_CELL = 0.5;

/**
 * The points that a search found, nearest first. Points at the same distance are in the order of their numbers. One
 * object can serve any number of searches.
 */
export class NearestPoints {
  count = 0;
  readonly ids: Int32Array;
  /** Points farther away than this are rejected: squared distance, mm². */
  limit2 = 0;
  private readonly distances2: Float64Array;

  /** @param max how many points a search finds at most */
  constructor(private readonly max: number) {
    this.ids = new Int32Array(max);
    this.distances2 = new Float64Array(max);
  }

  clear(limitMm: number): void {
    this.count = 0;
    this.limit2 = limitMm * limitMm;
  }

  /** `d2` is at most `limit2`. */
  add(id: number, d2: number): void {
    const { ids, distances2, max } = this;
    if (this.count === max && d2 === this.limit2 && id > ids[max - 1]) return;
    let k = this.count < max ? this.count++ : max - 1;
    for (; k > 0 && (distances2[k - 1] > d2 || (distances2[k - 1] === d2 && ids[k - 1] > id)); k--) {
      distances2[k] = distances2[k - 1];
      ids[k] = ids[k - 1];
    }
    distances2[k] = d2;
    ids[k] = id;
    if (this.count === max) this.limit2 = distances2[max - 1];
  }
}

const NONE = -1;

export class PointGrid {
  /** Side of a cell, mm; position of the first cell. */
  private readonly side: number;
  private readonly x0: number;
  private readonly y0: number;
  private readonly columns: number;
  private readonly rows: number;
  /** The lowest point of each cell; by point, the next higher and the next lower one in its cell. */
  private readonly lowest: Int32Array;
  private readonly higher: Int32Array;
  private readonly lower: Int32Array;

  /** `xy` interleaved, mm; point i is xy[2i], xy[2i + 1]. Stored by reference, not copied. */
  constructor(
    private readonly xy: Float64Array,
    pointsInCell = POINTS_IN_CELL,
  ) {
    const count = xy.length / 2;
    const { x0, y0, x1, y1 } = boxOfPoints(xy);
    const width = Math.max(0, x1 - x0);
    const height = Math.max(0, y1 - y0);
    const perPoint = pointsInCell / count;
    // A narrow box has a single row of cells.
    this.side = Math.max(Math.sqrt(width * height * perPoint), Math.max(width, height) * perPoint) || 1;
    this.x0 = x0;
    this.y0 = y0;
    this.columns = Math.floor(width / this.side) + 1;
    this.rows = Math.floor(height / this.side) + 1;
    this.lowest = new Int32Array(this.columns * this.rows).fill(NONE);
    this.higher = new Int32Array(count);
    this.lower = new Int32Array(count);
    for (let id = count - 1; id >= 0; id--) {
      const cell = this.cellOf(id);
      const next = this.lowest[cell];
      this.higher[id] = next;
      this.lower[id] = NONE;
      if (next !== NONE) this.lower[next] = id;
      this.lowest[cell] = id;
    }
  }

  /** The remaining points, cell by cell. */
  inSpaceOrder(): Uint32Array {
    const ids = new Uint32Array(this.higher.length);
    let count = 0;
    for (const first of this.lowest) {
      for (let id = first; id !== NONE; id = this.higher[id]) ids[count++] = id;
    }
    return ids.subarray(0, count);
  }

  /** Removes a point that has not been removed yet. */
  remove(id: number): void {
    const { lower, higher } = this;
    if (lower[id] === NONE) this.lowest[this.cellOf(id)] = higher[id];
    else higher[lower[id]] = higher[id];
    if (higher[id] !== NONE) lower[higher[id]] = lower[id];
  }

  /** Finds the remaining points nearest to (x, y), up to `limitMm` away. */
  find(x: number, y: number, limitMm: number, found: NearestPoints): void {
    const { columns, rows, side } = this;
    found.clear(limitMm);
    const column = this.columnOf(x);
    const row = this.rowOf(y);
    for (let ring = 0; ; ring++) {
      const left = column - ring;
      const right = column + ring;
      const top = row - ring;
      const bottom = row + ring;
      for (let r = Math.max(top, 0); r <= Math.min(bottom, rows - 1); r++) {
        const step = r === top || r === bottom ? 1 : right - left;
        for (let c = left; c <= right; c += step) {
          if (c >= 0 && c < columns) this.scan(r * columns + c, x, y, found);
        }
      }
      // Distance to the nearest cell that has not been scanned.
      const gap = Math.min(
        left > 0 ? x - this.x0 - left * side : Infinity,
        right < columns - 1 ? this.x0 + (right + 1) * side - x : Infinity,
        top > 0 ? y - this.y0 - top * side : Infinity,
        bottom < rows - 1 ? this.y0 + (bottom + 1) * side - y : Infinity,
      );
      if (gap === Infinity || (gap > 0 && gap * gap > found.limit2)) return;
    }
  }

  private scan(cell: number, x: number, y: number, found: NearestPoints): void {
    const { xy, higher } = this;
    // Stop at points at (x, y) itself: otherwise many points at one place would take quadratic time.
    for (let id = this.lowest[cell]; id !== NONE && found.limit2 > 0; id = higher[id]) {
      const dx = xy[2 * id] - x;
      const dy = xy[2 * id + 1] - y;
      const d2 = dx * dx + dy * dy;
      if (d2 <= found.limit2) found.add(id, d2);
    }
  }

  private cellOf(id: number): number {
    return this.rowOf(this.xy[2 * id + 1]) * this.columns + this.columnOf(this.xy[2 * id]);
  }

  private columnOf(x: number): number {
    return clamp(Math.floor((x - this.x0) / this.side), 0, this.columns - 1);
  }

  private rowOf(y: number): number {
    return clamp(Math.floor((y - this.y0) / this.side), 0, this.rows - 1);
  }
}
