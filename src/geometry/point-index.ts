/**
 * A uniform grid over points: nearest-neighbour queries on points that are taken away as one goes.
 *
 * Points stand in cells as one array in cell order (counting sort); a removed point is swapped to
 * the end of its cell, so a cell shrinks and empties. A query walks square rings of cells outward
 * and stops when no cell further out can hold anything nearer. About 2 points a cell: expected
 * O(1) a query on even data; on clustered data the rings grow, but only over emptied cells.
 */
import { boxOfPoints, type Box } from "./box.js";

const POINTS_PER_CELL = 2;
const MOST_CELLS = 1 << 22;

export class PointIndex {
  private readonly xy: Float64Array;
  private readonly x0: number;
  private readonly y0: number;
  private readonly cell: number;
  private readonly columns: number;
  private readonly rows: number;
  /** Point ids in cell order; cell c has [starts[c], starts[c] + sizes[c]). */
  private readonly ids: Uint32Array;
  private readonly starts: Uint32Array;
  private readonly sizes: Uint32Array;
  /** Where each point stands in `ids`. */
  private readonly places: Uint32Array;
  private left: number;

  /**
   * `xy` interleaved, mm; point i is xy[2i], xy[2i+1]. Kept, not copied.
   * With `ids` only those points are in the index.
   */
  constructor(xy: Float64Array, ids?: Uint32Array) {
    const count = ids ? ids.length : xy.length / 2;
    const box = ids ? boxOfSome(xy, ids) : boxOfPoints(xy);
    const width = count > 0 ? box.x1 - box.x0 : 0;
    const height = count > 0 ? box.y1 - box.y0 : 0;
    this.xy = xy;
    this.x0 = count > 0 ? box.x0 : 0;
    this.y0 = count > 0 ? box.y0 : 0;
    this.cell = cellSize(width, height, count);
    this.columns = Math.floor(width / this.cell) + 1;
    this.rows = Math.floor(height / this.cell) + 1;
    this.starts = new Uint32Array(this.columns * this.rows + 1);
    this.sizes = new Uint32Array(this.columns * this.rows);
    this.ids = new Uint32Array(count);
    this.places = new Uint32Array(xy.length / 2);
    this.left = count;
    this.sortIntoCells(ids ?? Uint32Array.from({ length: count }, (_, id) => id));
  }

  /** Points not removed yet. */
  get size(): number {
    return this.left;
  }

  remove(id: number): void {
    const cell = this.cellOf(id);
    const last = this.starts[cell] + --this.sizes[cell];
    const place = this.places[id];
    const other = this.ids[last];
    this.ids[place] = other;
    this.places[other] = place;
    this.ids[last] = id;
    this.places[id] = last;
    this.left--;
  }

  /** The nearest point left, or −1. Of equally near ones the lowest id, so that results do not depend on removals. */
  nearest(x: number, y: number): number {
    if (this.left === 0) return -1;
    const column = clamp(Math.floor((x - this.x0) / this.cell), this.columns - 1);
    const row = clamp(Math.floor((y - this.y0) / this.cell), this.rows - 1);
    const rings = Math.max(column, this.columns - 1 - column, row, this.rows - 1 - row);
    let best = -1;
    let best2 = Infinity;
    for (let ring = 0; ring <= rings; ring++) {
      // Anything in this ring is at least (ring − 1) cells away, wherever in its own cell the query lies.
      const reach = Math.max(ring - 1, 0) * this.cell;
      if (best >= 0 && reach * reach > best2) break;
      const r0 = Math.max(row - ring, 0);
      const r1 = Math.min(row + ring, this.rows - 1);
      for (let r = r0; r <= r1; r++) {
        const whole = r === row - ring || r === row + ring;
        const step = whole || ring === 0 ? 1 : 2 * ring;
        for (let c = column - ring; c <= column + ring; c += step) {
          if (c < 0 || c >= this.columns) continue;
          const cell = r * this.columns + c;
          const end = this.starts[cell] + this.sizes[cell];
          for (let k = this.starts[cell]; k < end; k++) {
            const id = this.ids[k];
            const dx = this.xy[2 * id] - x;
            const dy = this.xy[2 * id + 1] - y;
            const d2 = dx * dx + dy * dy;
            if (d2 < best2 || (d2 === best2 && id < best)) {
              best2 = d2;
              best = id;
            }
          }
        }
      }
    }
    return best;
  }

  /** The points left, in no order that means anything. */
  remaining(): Uint32Array {
    const ids = new Uint32Array(this.left);
    let used = 0;
    for (let c = 0; c < this.sizes.length; c++) {
      ids.set(this.ids.subarray(this.starts[c], this.starts[c] + this.sizes[c]), used);
      used += this.sizes[c];
    }
    return ids;
  }

  /** Calls `visit` with every point left within `radius` of the place, until it answers false. */
  within(x: number, y: number, radius: number, visit: (id: number) => boolean): void {
    const c0 = clamp(Math.floor((x - radius - this.x0) / this.cell), this.columns - 1);
    const c1 = clamp(Math.floor((x + radius - this.x0) / this.cell), this.columns - 1);
    const r0 = clamp(Math.floor((y - radius - this.y0) / this.cell), this.rows - 1);
    const r1 = clamp(Math.floor((y + radius - this.y0) / this.cell), this.rows - 1);
    for (let r = r0; r <= r1; r++) {
      for (let c = c0; c <= c1; c++) {
        const cell = r * this.columns + c;
        const end = this.starts[cell] + this.sizes[cell];
        for (let k = this.starts[cell]; k < end; k++) {
          const id = this.ids[k];
          const dx = this.xy[2 * id] - x;
          const dy = this.xy[2 * id + 1] - y;
          if (dx * dx + dy * dy <= radius * radius && !visit(id)) return;
        }
      }
    }
  }

  private cellOf(id: number): number {
    const column = clamp(Math.floor((this.xy[2 * id] - this.x0) / this.cell), this.columns - 1);
    const row = clamp(Math.floor((this.xy[2 * id + 1] - this.y0) / this.cell), this.rows - 1);
    return row * this.columns + column;
  }

  private sortIntoCells(points: Uint32Array): void {
    for (const id of points) this.sizes[this.cellOf(id)]++;
    for (let c = 0; c < this.sizes.length; c++) this.starts[c + 1] = this.starts[c] + this.sizes[c];
    const next = this.starts.slice(0, this.sizes.length);
    for (const id of points) {
      const place = next[this.cellOf(id)]++;
      this.ids[place] = id;
      this.places[id] = place;
    }
  }
}

function cellSize(width: number, height: number, count: number): number {
  const cells = Math.min(Math.max(count / POINTS_PER_CELL, 1), MOST_CELLS);
  const long = Math.max(width, height);
  if (long === 0) return 1;
  // On a thin strip the area says little: then the long side alone is divided.
  return Math.max(Math.sqrt((width * height) / cells), long / cells);
}

function boxOfSome(xy: Float64Array, ids: Uint32Array): Box {
  let x0 = Infinity;
  let y0 = Infinity;
  let x1 = -Infinity;
  let y1 = -Infinity;
  for (const id of ids) {
    x0 = Math.min(x0, xy[2 * id]);
    x1 = Math.max(x1, xy[2 * id]);
    y0 = Math.min(y0, xy[2 * id + 1]);
    y1 = Math.max(y1, xy[2 * id + 1]);
  }
  return { x0, y0, x1, y1 };
}

const clamp = (value: number, high: number): number => (value < 0 ? 0 : value > high ? high : value);
