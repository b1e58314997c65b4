/**
 * Joins lines whose ends meet, within a layer, so that the pen stays down.
 *
 * Every end is paired with at most one other end nearby; chains of paired lines become one line. Round one
 * pairs ends at the same point, the straightest continuation first: where lines cross in a mesh, the pen then
 * runs straight through instead of turning. Round two pairs the remaining ends, nearest first.
 *
 * Symbols: end 2i is the first point of line i, end 2i + 1 its last. `far[e]` is the other end of the chain
 * that ends in e (valid for chain ends only), so that a chain is never joined to itself unless this closes a
 * real loop.
 *
 * No points move: joining adds the gap, at most `radius`, as a straight segment. Dots and closed lines are
 * unchanged.
 */
import { LineBuilder, SAME_POINT, distance, lineLength, type Lines } from "../geometry/polyline.js";
import { tagRanges } from "./tour.js";

/** Max candidates compared at one point: keeps a star of 100 000 rays linear. */
const MOST_CANDIDATES = 24;
/** A chain shorter than this many radii is not closed: its ends are close only because it is short. */
const SHORTEST_LOOP = 4;
const UNPAIRED = -1;

/** Lines of one tag must be contiguous. `radius` in mm; 0 joins only ends that coincide (or nearly). */
export function joinLines(lines: Lines, radius: number): Lines {
  const builder = new LineBuilder();
  for (const [first, end] of tagRanges(lines)) {
    joinRange(lines, first, end, Math.max(radius, SAME_POINT), builder);
  }
  return builder.finish();
}

function joinRange(lines: Lines, first: number, end: number, radius: number, builder: LineBuilder): void {
  const places = new Float64Array(4 * (end - first));
  const joinable = joinableEnds(lines, first, end, places);
  const near = crowdedEnds(places, joinable, radius);
  if (near.length === 0) {
    builder.copyRange(lines, first, end);
    return;
  }
  const pairing = new Pairing(lines, first, places, near, joinable.length, radius);
  pairing.run(SAME_POINT, true);
  if (radius > SAME_POINT) pairing.run(radius, false);
  writeChains(lines, first, end, near, pairing.partner, builder);
}

/**
 * Writes each chain at the position of the first of its lines; `near` are the ends that may be paired, in
 * order.
 */
function writeChains(
  lines: Lines,
  first: number,
  end: number,
  near: Uint32Array,
  partner: Int32Array,
  builder: LineBuilder,
): void {
  const done = new Uint8Array(end - first);
  let from = 0;
  for (const e of near) {
    const i = e >> 1;
    if (partner[e] === UNPAIRED || i < from) continue;
    builder.copyRange(lines, first + from, first + i);
    if (done[i] === 0) writeChain(lines, first, partner, i, done, builder);
    from = i + 1;
  }
  builder.copyRange(lines, first + from, end);
}

/**
 * The ends of the lines that are neither dots nor closed. Writes their positions, x, y, x, y …, to `places`.
 */
function joinableEnds({ xy, offsets }: Lines, first: number, end: number, places: Float64Array): Uint32Array {
  const ends = new Uint32Array(2 * (end - first));
  let count = 0;
  for (let i = first; i < end; i++) {
    const p = 2 * offsets[i];
    const q = 2 * offsets[i + 1] - 2;
    const e = 2 * (i - first);
    const x0 = (places[2 * e] = xy[p]);
    const y0 = (places[2 * e + 1] = xy[p + 1]);
    const x1 = (places[2 * e + 2] = xy[q]);
    const y1 = (places[2 * e + 3] = xy[q + 1]);
    if (p === q || (q > p + 2 && x0 === x1 && y0 === y1)) continue;
    ends[count++] = e;
    ends[count++] = e + 1;
  }
  return ends.subarray(0, count);
}

/**
 * The `ends` that have another one within the radius (plus a margin for rounding): a few in most drawings.
 * Uses cells as in `EndGrid`, but so wide that the surroundings of an end usually lie in at most two of them.
 */
function crowdedEnds(xy: Float64Array, ends: Uint32Array, radius: number): Uint32Array {
  const heads = new Int32Array(2 ** Math.ceil(Math.log2(2 * ends.length + 1))).fill(-1);
  const next = new Int32Array(ends.length);
  const mask = heads.length - 1;
  const perMm = 1 / (4 * radius);
  linkByCell(xy, ends, perMm, heads, next);
  const crowded = new Uint32Array(ends.length);
  let count = 0;
  for (let k = 0; k < ends.length; k++) {
    const x = xy[2 * ends[k]];
    const y = xy[2 * ends[k] + 1];
    // Slightly more than the radius, for rounding.
    const reach = 1.01 * radius + 1e-15 * (Math.abs(x) + Math.abs(y));
    const side = reach * perMm;
    const column = Math.floor(x * perMm);
    const row = Math.floor(y * perMm);
    const u = x * perMm - column;
    const v = y * perMm - row;
    const column0 = u < side ? column - 1 : column;
    const column1 = u > 1 - side ? column + 1 : column;
    const row1 = v > 1 - side ? row + 1 : row;
    let isNear = false;
    for (let r = v < side ? row - 1 : row; r <= row1 && !isNear; r++) {
      for (let c = column0; c <= column1 && !isNear; c++) {
        for (let j = heads[cellHash(c, r) & mask]; j >= 0 && !isNear; j = next[j]) {
          const dx = xy[2 * ends[j]] - x;
          const dy = xy[2 * ends[j] + 1] - y;
          isNear = dx * dx + dy * dy <= reach * reach && j !== k;
        }
      }
    }
    if (isNear) crowded[count++] = ends[k];
  }
  return crowded.subarray(0, count);
}

/**
 * Links the ends of each cell, by index in `ends`: the first one at `heads[hash]`, the one after k at
 * `next[k]`.
 */
function linkByCell(
  xy: Float64Array,
  ends: Uint32Array,
  perMm: number,
  heads: Int32Array,
  next: Int32Array,
): void {
  const mask = heads.length - 1;
  for (let k = 0; k < ends.length; k++) {
    const e = 2 * ends[k];
    const hash = cellHash(Math.floor(xy[e] * perMm), Math.floor(xy[e + 1] * perMm)) & mask;
    next[k] = heads[hash];
    heads[hash] = k;
  }
}

function cellHash(column: number, row: number): number {
  const hash = Math.imul(column, 0x9e3779b1) ^ Math.imul(row, 0x85ebca77);
  return hash ^ (hash >>> 15);
}

class Pairing {
  readonly partner: Int32Array;
  private readonly far: Int32Array;
  private readonly length: Float64Array;
  /** Unit vector from each end, out of its line. */
  private readonly out: Float64Array;
  private readonly grid: EndGrid;

  /** @param near the ends that may be paired, of `joinable` in all; the others are ignored */
  constructor(
    lines: Lines,
    first: number,
    /** Position of each end. */
    private readonly xy: Float64Array,
    private readonly near: Uint32Array,
    joinable: number,
    private readonly radius: number,
  ) {
    const ends = xy.length / 2;
    this.partner = new Int32Array(ends).fill(UNPAIRED);
    this.far = new Int32Array(ends);
    this.length = new Float64Array(ends);
    this.out = new Float64Array(2 * ends);
    for (let k = 0; k < near.length; k++) {
      const e = near[k];
      const line = first + (e >> 1);
      this.far[e] = e ^ 1;
      this.length[e] = lineLength(lines, line);
      if ((e & 1) === 0) this.setOut(lines, e, lines.offsets[line], 1);
      else this.setOut(lines, e, lines.offsets[line + 1] - 1, -1);
    }
    this.grid = new EndGrid(xy, near, joinable, radius);
  }

  private setOut({ xy }: Lines, e: number, at: number, step: number): void {
    const dx = xy[2 * at] - xy[2 * (at + step)];
    const dy = xy[2 * at + 1] - xy[2 * (at + step) + 1];
    const length = Math.sqrt(dx * dx + dy * dy) || 1;
    this.out[2 * e] = dx / length;
    this.out[2 * e + 1] = dy / length;
  }

  /** Pairs each free end with the best free one within `reach`: the straightest, or the nearest. */
  run(reach: number, straightest: boolean): void {
    for (const e of this.near) {
      if (this.partner[e] !== UNPAIRED) continue;
      const other = this.best(e, reach, straightest);
      if (other >= 0) this.pair(e, other);
    }
  }

  private best(e: number, reach: number, straightest: boolean): number {
    const x = this.xy[2 * e];
    const y = this.xy[2 * e + 1];
    let best = -1;
    let bestCost = Infinity;
    let seen = 0;
    const column1 = this.grid.cellOf(x + reach);
    const row1 = this.grid.cellOf(y + reach);
    for (let row = this.grid.cellOf(y - reach); row <= row1; row++) {
      for (let column = this.grid.cellOf(x - reach); column <= column1; column++) {
        let before = -1;
        for (let other = this.grid.first(column, row); other >= 0; other = this.grid.next[other]) {
          if (this.partner[other] !== UNPAIRED) {
            this.grid.unlink(column, row, before, other);
            continue;
          }
          before = other;
          const gap = distance(x, y, this.xy[2 * other], this.xy[2 * other + 1]);
          if (gap > reach || other === e || !this.mayPair(e, other)) continue;
          // Straight on means that the two lines leave the point in opposite directions.
          const cost = straightest
            ? this.out[2 * e] * this.out[2 * other] + this.out[2 * e + 1] * this.out[2 * other + 1]
            : gap;
          if (cost < bestCost) {
            bestCost = cost;
            best = other;
          }
          if (++seen === MOST_CANDIDATES) return best;
        }
      }
    }
    return best;
  }

  private mayPair(e: number, other: number): boolean {
    return this.far[e] !== other || this.length[e] > SHORTEST_LOOP * this.radius;
  }

  private pair(e: number, other: number): void {
    this.partner[e] = other;
    this.partner[other] = e;
    const head = this.far[e];
    const tail = this.far[other];
    const length = this.length[e] + this.length[other];
    this.far[head] = tail;
    this.far[tail] = head;
    this.length[head] = this.length[tail] = length;
  }
}

/**
 * Ends in cells as wide as the join radius, with the cells in a hash table: everything within the radius of a
 * point is in at most four cells. Two cells may share a list; the distance check handles that.
 */
class EndGrid {
  /** The next end in the same list, −1 at its end. */
  readonly next: Int32Array;
  private readonly heads: Int32Array;

  constructor(
    xy: Float64Array,
    ends: Uint32Array,
    /** Number of ends that the table is sized for. */
    size: number,
    private readonly cell: number,
  ) {
    this.next = new Int32Array(xy.length / 2).fill(-1);
    this.heads = new Int32Array(2 ** Math.ceil(Math.log2(Math.max(size, 1) + 1))).fill(-1);
    for (const e of ends) {
      const bucket = this.bucketOf(this.cellOf(xy[2 * e]), this.cellOf(xy[2 * e + 1]));
      this.next[e] = this.heads[bucket];
      this.heads[bucket] = e;
    }
  }

  cellOf(value: number): number {
    return Math.floor(value / this.cell);
  }

  first(column: number, row: number): number {
    return this.heads[this.bucketOf(column, row)];
  }

  /** Removes `end` from its list, where `before` precedes it (−1: none). Its own link stays. */
  unlink(column: number, row: number, before: number, end: number): void {
    if (before < 0) this.heads[this.bucketOf(column, row)] = this.next[end];
    else this.next[before] = this.next[end];
  }

  private bucketOf(column: number, row: number): number {
    return cellHash(column, row) & (this.heads.length - 1);
  }
}

/** Writes the chain that contains line `i`, in line i's direction, starting at its free end if it has one. */
function writeChain(
  lines: Lines,
  first: number,
  partner: Int32Array,
  i: number,
  done: Uint8Array,
  builder: LineBuilder,
): void {
  let entry = 2 * i;
  while (partner[entry] !== UNPAIRED) {
    entry = partner[entry] ^ 1;
    if (entry >> 1 === i) break;
  }
  const head = entry;
  const closes = partner[head] !== UNPAIRED;
  for (;;) {
    const line = entry >> 1;
    done[line] = 1;
    addPoints(lines, first + line, (entry & 1) === 1, builder);
    const next = partner[entry ^ 1];
    if (next === UNPAIRED || next === head) break;
    entry = next;
  }
  if (closes) {
    const line = first + (head >> 1);
    const p = (head & 1) === 1 ? lines.offsets[line + 1] - 1 : lines.offsets[line];
    builder.point(lines.xy[2 * p], lines.xy[2 * p + 1]);
  }
  builder.end(lines.tag[first + i]);
}

function addPoints(lines: Lines, i: number, reversed: boolean, builder: LineBuilder): void {
  const { xy, offsets } = lines;
  const from = offsets[i];
  const to = offsets[i + 1] - 1;
  if (reversed) for (let p = to; p >= from; p--) builder.point(xy[2 * p], xy[2 * p + 1]);
  else for (let p = from; p <= to; p++) builder.point(xy[2 * p], xy[2 * p + 1]);
}
