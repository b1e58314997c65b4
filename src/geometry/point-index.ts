/**
 * A k-d tree over points, for nearest-neighbour questions while points are taken away one by one.
 *
 * Method: ids in one array, the median of each range at its middle, ranges split in x and y by turns
 * (J. Bentley, CACM 18(9), 1975; the array form after V. Agafonkin's kdbush). Every range of more than
 * LEAF points counts how many of its points are left, so that emptied parts are passed over at once.
 *
 *   ids   [ … left half … | m | … right half … ]        left[m] = points left in the whole range
 *
 * Built in n log n, asked and removed from in log n on average, whether points are spread evenly,
 * stand in clusters or all at one place: no cell size to get wrong.
 */
const LEAF = 8;

export class PointIndex {
  private readonly xy: Float64Array;
  private readonly ids: Uint32Array;
  /** The coordinates in the order of `ids`: side by side where they are looked at together. */
  private readonly xs: Float64Array;
  private readonly ys: Float64Array;
  /** Where each point stands in `ids`. */
  private readonly places: Uint32Array;
  private readonly gone: Uint8Array;
  /** By the middle of each split range: points left in it. */
  private readonly left: Uint32Array;
  private remaining: number;

  // The question under way; fields, because a closure for each would cost more than the search.
  private qx = 0;
  private qy = 0;
  private best = -1;
  private best2 = Infinity;

  /**
   * `xy` interleaved, mm; point i is xy[2i], xy[2i+1]. Kept, not copied.
   * With `ids` only those points are in the index.
   */
  constructor(xy: Float64Array, ids?: Uint32Array) {
    this.xy = xy;
    this.ids = ids ? ids.slice() : new Uint32Array(xy.length / 2);
    if (!ids) for (let id = 0; id < this.ids.length; id++) this.ids[id] = id;
    this.xs = new Float64Array(this.ids.length);
    this.ys = new Float64Array(this.ids.length);
    for (let k = 0; k < this.ids.length; k++) {
      this.xs[k] = xy[2 * this.ids[k]];
      this.ys[k] = xy[2 * this.ids[k] + 1];
    }
    this.places = new Uint32Array(xy.length / 2);
    this.gone = new Uint8Array(this.ids.length);
    this.left = new Uint32Array(this.ids.length);
    this.remaining = this.ids.length;
    this.build(0, this.ids.length - 1, 0);
    for (let k = 0; k < this.ids.length; k++) this.places[this.ids[k]] = k;
  }

  /** All points, neighbours in the tree side by side: any stretch of it lies in a few compact boxes. */
  get inSpaceOrder(): Uint32Array {
    return this.ids;
  }

  /** Points not removed yet. */
  get size(): number {
    return this.remaining;
  }

  remove(id: number): void {
    const place = this.places[id];
    this.gone[place] = 1;
    this.remaining--;
    let from = 0;
    let to = this.ids.length - 1;
    while (to - from >= LEAF) {
      const middle = (from + to) >> 1;
      this.left[middle]--;
      if (place === middle) return;
      if (place < middle) to = middle - 1;
      else from = middle + 1;
    }
  }

  /** The nearest point left, or −1. */
  nearest(x: number, y: number): number {
    this.qx = x;
    this.qy = y;
    this.best = -1;
    this.best2 = Infinity;
    if (this.remaining > 0) this.searchNearest(0, this.ids.length - 1, 0);
    return this.best;
  }

  /**
   * Writes the `count` points nearest to point `id` that are left, nearest first, into `out` from `at`,
   * without the point itself and `except`. Answers how many there were.
   */
  nearestMany(id: number, except: number, count: number, out: Int32Array, at: number): number {
    this.qx = this.xy[2 * id];
    this.qy = this.xy[2 * id + 1];
    const list = new NearestList(count, out, at, id, except);
    this.searchMany(0, this.ids.length - 1, 0, list);
    return list.size;
  }

  private build(from: number, to: number, axis: 0 | 1): void {
    if (to - from < LEAF) return;
    const middle = (from + to) >> 1;
    if (axis === 0) this.select(this.xs, this.ys, middle, from, to);
    else this.select(this.ys, this.xs, middle, from, to);
    this.left[middle] = to - from + 1;
    this.build(from, middle - 1, axis === 0 ? 1 : 0);
    this.build(middle + 1, to, axis === 0 ? 1 : 0);
  }

  /** Puts the point that belongs at `k` in the order of `keys` there, smaller ones before it (Hoare's quickselect). */
  private select(keys: Float64Array, others: Float64Array, k: number, from: number, to: number): void {
    const { ids } = this;
    while (to > from) {
      // The middle of three as pivot: sorted input, which drawings often are, stays linear.
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

  private searchNearest(from: number, to: number, axis: 0 | 1): void {
    if (to - from < LEAF) {
      for (let k = from; k <= to; k++) this.offer(k);
      return;
    }
    const middle = (from + to) >> 1;
    if (this.left[middle] === 0) return;
    this.offer(middle);
    const gap = axis === 0 ? this.qx - this.xs[middle] : this.qy - this.ys[middle];
    const next = axis === 0 ? 1 : 0;
    if (gap <= 0) {
      this.searchNearest(from, middle - 1, next);
      if (gap * gap < this.best2) this.searchNearest(middle + 1, to, next);
    } else {
      this.searchNearest(middle + 1, to, next);
      if (gap * gap < this.best2) this.searchNearest(from, middle - 1, next);
    }
  }

  private offer(place: number): void {
    if (this.gone[place] === 1) return;
    const d2 = this.distance2(place);
    if (d2 >= this.best2) return;
    this.best2 = d2;
    this.best = this.ids[place];
  }

  private distance2(place: number): number {
    const dx = this.xs[place] - this.qx;
    const dy = this.ys[place] - this.qy;
    return dx * dx + dy * dy;
  }

  private searchMany(from: number, to: number, axis: 0 | 1, list: NearestList): void {
    if (to - from < LEAF) {
      for (let k = from; k <= to; k++) if (this.gone[k] === 0) list.offer(this.ids[k], this.distance2(k));
      return;
    }
    const middle = (from + to) >> 1;
    if (this.left[middle] === 0) return;
    if (this.gone[middle] === 0) list.offer(this.ids[middle], this.distance2(middle));
    const gap = axis === 0 ? this.qx - this.xs[middle] : this.qy - this.ys[middle];
    const next = axis === 0 ? 1 : 0;
    if (gap <= 0) {
      this.searchMany(from, middle - 1, next, list);
      if (gap * gap < list.worst2) this.searchMany(middle + 1, to, next, list);
    } else {
      this.searchMany(middle + 1, to, next, list);
      if (gap * gap < list.worst2) this.searchMany(from, middle - 1, next, list);
    }
  }
}

/** The few nearest so far, sorted by insertion. */
class NearestList {
  size = 0;
  /** Farther than this nothing gets in. */
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
