/** A cell's number; there are enough columns and rows for a sheet of paper. */
const keyOf = (column: number, row: number): number => (column + 0x8000) * 0x10000 + (row + 0x8000);

/** A cell and its neighbours, the most likely first. */
const AROUND = [
  [0, 0],
  [1, 0],
  [-1, 0],
  [0, 1],
  [0, -1],
  [1, 1],
  [1, -1],
  [-1, 1],
  [-1, -1],
] as const;

/** Fast distances from points to many line segments: a grid of cells over the segments. */
export class SegmentGrid {
  private readonly segments: number[] = [];
  private readonly cells = new Map<number, number[]>();

  /** `cellMm` should be larger than the distances of interest. */
  constructor(private readonly cellMm = 0.5) {}

  /** x, y, x, y …; a single point is a segment of length 0. */
  addPolyline(xy: ArrayLike<number>, from = 0, to = xy.length): void {
    if (to - from === 2) this.addSegment(xy[from], xy[from + 1], xy[from], xy[from + 1]);
    for (let i = from; i + 3 < to; i += 2) this.addSegment(xy[i], xy[i + 1], xy[i + 2], xy[i + 3]);
  }

  /**
   * mm to the nearest segment; Infinity if none is within a cell. The search ends at a segment nearer than
   * `enoughMm`: for the maximum of many distances, smaller ones need not be exact.
   */
  distance(x: number, y: number, enoughMm = 0): number {
    const column = Math.floor(x / this.cellMm);
    const row = Math.floor(y / this.cellMm);
    const enough2 = enoughMm * enoughMm;
    let nearest2 = Infinity;
    for (const [right, down] of AROUND) {
      const cell = this.cells.get(keyOf(column + right, row + down));
      if (!cell) continue;
      for (const segment of cell) {
        nearest2 = Math.min(nearest2, this.toSegment2(segment, x, y));
        if (nearest2 <= enough2) return Math.sqrt(nearest2);
      }
    }
    return Math.sqrt(nearest2);
  }

  private addSegment(x0: number, y0: number, x1: number, y1: number): void {
    const index = this.segments.length;
    this.segments.push(x0, y0, x1, y1);
    const stepCount = Math.max(1, Math.ceil((2 * Math.hypot(x1 - x0, y1 - y0)) / this.cellMm));
    let last = NaN;
    for (let k = 0; k <= stepCount; k++) {
      const x = x0 + ((x1 - x0) * k) / stepCount;
      const y = y0 + ((y1 - y0) * k) / stepCount;
      const key = keyOf(Math.floor(x / this.cellMm), Math.floor(y / this.cellMm));
      if (key === last) continue;
      last = key;
      const cell = this.cells.get(key);
      if (cell) cell.push(index);
      else this.cells.set(key, [index]);
    }
  }

  /** mm². */
  private toSegment2(index: number, x: number, y: number): number {
    const x0 = this.segments[index];
    const y0 = this.segments[index + 1];
    const dx = this.segments[index + 2] - x0;
    const dy = this.segments[index + 3] - y0;
    const length2 = dx * dx + dy * dy;
    const t = length2 > 0 ? Math.min(1, Math.max(0, ((x - x0) * dx + (y - y0) * dy) / length2)) : 0;
    const awayX = x - x0 - t * dx;
    const awayY = y - y0 - t * dy;
    return awayX * awayX + awayY * awayY;
  }
}

/** The largest distance from any of the points (x, y, x, y …) to the grid's segments. */
export function farthest(points: Iterable<readonly [number, number]>, grid: SegmentGrid): number {
  let maxMm = 0;
  for (const [x, y] of points) maxMm = Math.max(maxMm, grid.distance(x, y, maxMm));
  return maxMm;
}
