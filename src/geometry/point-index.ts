/**
 * A k-d tree over points, for queries for the nearest few points.
 *
 * Method: ids in one array, the median of each range at its middle, ranges split alternately in x and y
 * (J. Bentley, CACM 18(9), 1975; the array form after V. Agafonkin's kdbush). Ranges are nodes, numbered
 * as they are split.
 *
 *   ids   [ … left half … | m | … right half … ]        node n
 *           node n + 1          node rights[n]
 *
 * Building takes O(n log n), a query O(log n) on average, whether points are evenly spread, clustered or all
 * coincident. There is no cell size to tune.
 */
const LEAF = 8;

export class PointIndex {
  private readonly xy: Float64Array;
  private readonly ids: Uint32Array;
  /** The coordinates in the order of `ids`, so that a search reads adjacent memory. */
  private readonly xs: Float64Array;
  private readonly ys: Float64Array;
  /** By node: first and last index of its range, the node of its right half, the axis of its split. */
  private readonly starts: Uint32Array;
  private readonly ends: Uint32Array;
  private readonly rights: Uint32Array;
  private readonly axes: Uint8Array;
  private nodeCount = 0;

  // The current query point. Fields, because a closure per query would cost more than the search.
  private qx = 0;
  private qy = 0;

  /**
   * `xy` interleaved, mm; point i is xy[2i], xy[2i+1]. Stored by reference, not copied.
   * With `ids` only those points are in the index.
   */
  constructor(xy: Float64Array, ids?: Uint32Array) {
    this.xy = xy;
    const count = ids?.length ?? xy.length / 2;
    this.ids = new Uint32Array(count);
    this.xs = new Float64Array(count);
    this.ys = new Float64Array(count);
    for (let k = 0; k < count; k++) {
      const id = ids ? ids[k] : k;
      this.ids[k] = id;
      this.xs[k] = xy[2 * id];
      this.ys[k] = xy[2 * id + 1];
    }
    // Leaves have at least LEAF / 2 points, and there is one inner node fewer than leaves.
    const maxNodes = Math.ceil((4 * this.ids.length) / LEAF) + 1;
    this.starts = new Uint32Array(maxNodes);
    this.ends = new Uint32Array(maxNodes);
    this.rights = new Uint32Array(maxNodes);
    this.axes = new Uint8Array(maxNodes);
    this.build(0, this.ids.length - 1, 0);
  }

  /** All point ids in tree order: any contiguous slice lies within a few compact boxes. */
  get inSpaceOrder(): Uint32Array {
    return this.ids;
  }

  /**
   * Writes the `count` points nearest to point `id`, nearest first, into `out` from `at`,
   * excluding the point itself and `except`. Returns how many were written.
   */
  nearestMany(id: number, except: number, count: number, out: Int32Array, at: number): number {
    this.qx = this.xy[2 * id];
    this.qy = this.xy[2 * id + 1];
    const list = new NearestList(count, out, at, id, except);
    this.searchMany(0, list);
    return list.size;
  }

  /** Builds the node of the range [from, to] and returns its number. */
  private build(from: number, to: number, axis: 0 | 1): number {
    const node = this.nodeCount++;
    this.starts[node] = from;
    this.ends[node] = to;
    this.axes[node] = axis;
    if (to - from < LEAF) return node;
    const middle = (from + to) >> 1;
    if (axis === 0) this.select(this.xs, this.ys, middle, from, to);
    else this.select(this.ys, this.xs, middle, from, to);
    const other = axis === 0 ? 1 : 0;
    this.build(from, middle - 1, other);
    this.rights[node] = this.build(middle + 1, to, other);
    return node;
  }

  /**
   * Moves the point of rank `k` by `keys` to index `k`, with smaller ones before it (Hoare's quickselect).
   */
  private select(keys: Float64Array, others: Float64Array, k: number, from: number, to: number): void {
    const { ids } = this;
    while (to > from) {
      // Median of three as pivot: sorted input, which is common in drawings, stays linear.
      const pivot = medianOfThree(keys[from], keys[(from + to) >> 1], keys[to]);
      let i = from;
      let j = to;
      while (i <= j) {
        while (keys[i] < pivot) i++;
        while (keys[j] > pivot) j--;
        if (i > j) break;
        const id = ids[i];
        const key = keys[i];
        const other = others[i];
        ids[i] = ids[j];
        keys[i] = keys[j];
        others[i++] = others[j];
        ids[j] = id;
        keys[j] = key;
        others[j--] = other;
      }
      if (k <= j) to = j;
      else if (k >= i) from = i;
      else return;
    }
  }

  private distance2(place: number): number {
    const dx = this.xs[place] - this.qx;
    const dy = this.ys[place] - this.qy;
    return dx * dx + dy * dy;
  }

  private searchMany(node: number, list: NearestList): void {
    const from = this.starts[node];
    const to = this.ends[node];
    if (to - from < LEAF) {
      for (let k = from; k <= to; k++) list.offer(this.ids[k], this.distance2(k));
      return;
    }
    const middle = (from + to) >> 1;
    list.offer(this.ids[middle], this.distance2(middle));
    const gap = this.axes[node] === 0 ? this.qx - this.xs[middle] : this.qy - this.ys[middle];
    const right = this.rights[node];
    this.searchMany(gap <= 0 ? node + 1 : right, list);
    if (gap * gap < list.worst2) this.searchMany(gap <= 0 ? right : node + 1, list);
  }
}

/** The nearest few found so far, kept sorted by insertion. */
class NearestList {
  size = 0;
  /** Squared distance from which on candidates are rejected. */
  worst2 = Infinity;
  private readonly distances: Float64Array;

  constructor(
    private readonly count: number,
    private readonly out: Int32Array,
    private readonly at: number,
    private readonly self: number,
    private readonly except: number,
  ) {
    this.distances = new Float64Array(count);
  }

  offer(id: number, d2: number): void {
    if (d2 >= this.worst2 || id === this.self || id === this.except) return;
    let k = this.size < this.count ? this.size++ : this.count - 1;
    for (; k > 0 && this.distances[k - 1] > d2; k--) {
      this.distances[k] = this.distances[k - 1];
      this.out[this.at + k] = this.out[this.at + k - 1];
    }
    this.distances[k] = d2;
    this.out[this.at + k] = id;
    if (this.size === this.count) this.worst2 = this.distances[this.count - 1];
  }
}

function medianOfThree(a: number, b: number, c: number): number {
  return Math.max(Math.min(a, b), Math.min(Math.max(a, b), c));
}
