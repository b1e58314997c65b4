/**
 * The kernel of order "best": local search on a tour of strokes that may be drawn in either direction.
 *
 * Problem: every stroke k has two ends, 2k and 2k + 1. The tour is a ring of ends in which the two ends of a
 * stroke stay adjacent; between strokes the pen travels:
 *
 *     … 2a+1 │ 6 7 │ 12 13 │ 5 4 │ 2b …        │ travel    6 7 a stroke, 5 4 one drawn backwards
 *
 * So every end has exactly one travel edge, to its partner. Reversing a section of the tour (2-opt) also reverses its
 * strokes, so no special moves are needed to change their directions. One stroke represents home: the pen begins at its
 * exit and must end at its entry.
 *
 * Moves (after S. Lin, 1965, and I. Or, 1976):
 *
 *     1. remove the travel edge t1 t2, connect t2 to a near end t3, remove its travel edge t3 t4
 *     2. either connect t4 to t1 (2-opt)
 *     3. or connect t4 to a near end t5, remove its travel edge t5 t6, connect t6 to t1 (3-opt; this includes Or's
 *        move of a section to another place, reversed or not)
 *
 * The gain must be positive after every step, which limits the search (Lin and Kernighan). Near ends come from lists of
 * the nearest few.
 *
 * Let rel(x) be the position of x counted from t2 away from t1 (rel t2 = 0, rel t1 = last). A stroke is entered at an
 * even rel and left at an odd one. A move must leave a single ring:
 *
 *     rel t3 even: 2-opt does; with 3-opt, rel t5 must be even if t5 is after t3, and odd if it is before t4
 *     rel t3 odd : 2-opt does not; with 3-opt, t5 must be between t2 and t3
 *
 * To leave a local optimum, the search makes a double bridge over a short section (a kick), then searches around it. Both
 * are undone if the tour became longer (iterated local search, O. Martin, S. Otto, E. Felten, 1991). All changes are
 * reversals of sections, stored in a log, so undoing them takes no longer than making them.
 *
 * Invariants: `tour` and `place` are inverse; the ends of a stroke are neighbours in the ring at positions
 * 2i, 2i+1; `length` decreases with every accepted step. Lengths in mm.
 */
import { NearestPoints, PointGrid } from "../../geometry/point-grid.js";

/** Number of near ends in each end's list, and how many of them are tried for the third edge. */
const NEAR = 8;
const NEAR_THIRD = 5;
/** Smaller gains are rounding errors. */
const EPSILON = 1e-9;
/** A double bridge cuts within this many strokes. */
const KICK_SPAN = 12;

/** A move that removes the travel edges at t1, t3 and t5. */
interface Move {
  /** By how much the tour becomes shorter, mm. */
  readonly gain: number;
  readonly t3: number;
  /** Null for a 2-opt move. */
  readonly t5: number | null;
}

export class TourSearch {
  /** Travel length of the ring, mm. */
  length = 0;

  private readonly ends: number;
  private readonly tour: Int32Array;
  private readonly place: Int32Array;
  /** By end, the nearest ends of other strokes, and how far away they are, mm; −1 if there are fewer. */
  private readonly near: Int32Array;
  private readonly nearDistance: Float64Array;
  /** Ends around which the search is still to be done: a ring buffer, with each end in it at most once. */
  private readonly queue: Int32Array;
  private readonly queued: Uint8Array;
  private queueFrom = 0;
  private queueSize = 0;
  /** Reversed sections since the last kick: first and last position of each. */
  private log: number[] = [];

  /**
   * `xy` has the coordinates of the ends: x, y of end 0, of end 1 …. It is referenced, not copied. `order` is the initial
   * ring: the ends in drawing order.
   */
  constructor(
    private readonly xy: Float64Array,
    order: Int32Array,
    private readonly random: () => number,
  ) {
    this.ends = order.length;
    this.tour = order.slice();
    this.place = new Int32Array(this.ends);
    for (let p = 0; p < this.ends; p++) this.place[this.tour[p]] = p;
    this.queue = new Int32Array(this.ends);
    this.queued = new Uint8Array(this.ends);
    this.near = new Int32Array(this.ends * NEAR).fill(-1);
    this.nearDistance = new Float64Array(this.ends * NEAR);
    this.findNear();
    for (let p = 1; p < this.ends; p += 2) this.length += this.gap(this.tour[p], this.tour[this.next(p)]);
    for (const end of this.tour) this.push(end);
  }

  private findNear(): void {
    const { ends, xy } = this;
    const index = new PointGrid(xy);
    // Two more, because the result includes the end itself and the other end of its stroke.
    const found = new NearestPoints(NEAR + 2);
    for (let e = 0; e < ends; e++) {
      index.find(xy[2 * e], xy[2 * e + 1], Infinity, found);
      const others = found.ids.subarray(0, found.count).filter((other) => strokeOf(other) !== strokeOf(e));
      for (let k = 0; k < Math.min(others.length, NEAR); k++) {
        this.near[e * NEAR + k] = others[k];
        this.nearDistance[e * NEAR + k] = this.gap(e, others[k]);
      }
    }
  }

  /** The current ring of ends. */
  get ring(): Int32Array {
    return this.tour;
  }

  /**
   * Improves until no move around any queued end helps, or `steps` ends have been processed; returns true
   * when done.
   */
  improve(steps = Infinity): boolean {
    for (let step = 0; this.queueSize > 0 && step < steps; step++) {
      const t1 = this.pop();
      while (this.improveAround(t1)) continue;
    }
    return this.queueSize === 0;
  }

  /** One double bridge and the search after it; undone if the tour became longer. */
  kick(): void {
    const strokes = this.ends / 2;
    if (strokes < 8) return;
    const before = this.length;
    this.log.length = 0;
    const span = Math.min(KICK_SPAN, strokes - 3);
    const start = Math.floor(this.random() * strokes);
    const cuts = [0, 0, 0].map(() => 1 + Math.floor(this.random() * span)).sort((a, b) => a - b);
    // Three different cuts, the last at most strokes − 1 after `start`: the stroke at `start` stays in place.
    const c1 = cuts[0];
    const c2 = Math.max(cuts[1], c1 + 1);
    const c3 = Math.max(cuts[2], c2 + 1);
    this.doubleBridge(start, c1, c2, c3);
    this.improve();
    if (this.length > before + EPSILON) this.undo(before);
  }

  /** Reorders the sections b, c, d after stroke position `start` to d, c, b. */
  private doubleBridge(start: number, c1: number, c2: number, c3: number): void {
    const at = (stroke: number, exit: number): number => this.tour[(2 * (start + stroke) + exit) % this.ends];
    const [p, b0, b1] = [at(0, 1), at(1, 0), at(c1, 1)];
    const [c0, cEnd, d0, d1, n] = [at(c1 + 1, 0), at(c2, 1), at(c2 + 1, 0), at(c3, 1), at(c3 + 1, 0)];
    const old = this.gap(p, b0) + this.gap(b1, c0) + this.gap(cEnd, d0) + this.gap(d1, n);
    this.swap(p, b0, b1, c0, d1, n);
    this.swap(p, c0, cEnd, d0, d1, b0);
    this.length += this.gap(p, d0) + this.gap(d1, c0) + this.gap(cEnd, b0) + this.gap(b1, n) - old;
    for (const end of [p, b0, b1, c0, cEnd, d0, d1, n]) this.push(end);
  }

  private undo(length: number): void {
    for (let k = this.log.length - 2; k >= 0; k -= 2) this.turnPlaces(this.log[k], this.log[k + 1]);
    this.log.length = 0;
    this.length = length;
  }

  /** Makes the best move that removes the travel edge of t1; false if none makes the tour shorter. */
  private improveAround(t1: number): boolean {
    const t2 = this.partnerOf(t1);
    const move = this.bestMove(t1, t2);
    if (move) this.makeMove(t1, t2, move);
    return move !== null;
  }

  private bestMove(t1: number, t2: number): Move | null {
    const { near, nearDistance } = this;
    const d12 = this.gap(t1, t2);
    let best: Move | null = null;
    for (let k = t2 * NEAR; k < (t2 + 1) * NEAR; k++) {
      const t3 = near[k];
      const g1 = d12 - nearDistance[k];
      const minGain = best?.gain ?? EPSILON;
      if (t3 < 0 || g1 <= minGain) break;
      if (t3 === t1) continue;
      const t4 = this.partnerOf(t3);
      const g2 = g1 + this.gap(t3, t4);
      if (isEven(this.rel(t3, t2))) {
        const gain = g2 - this.gap(t4, t1);
        if (gain > minGain) best = { gain, t3, t5: null };
      }
      best = this.bestThird(t1, t2, t3, t4, g2, best);
    }
    return best;
  }

  /** The best move with a third edge, if it is better than `best`; otherwise `best`. */
  private bestThird(
    t1: number,
    t2: number,
    t3: number,
    t4: number,
    g2: number,
    best: Move | null,
  ): Move | null {
    const { near, nearDistance } = this;
    const rel3 = this.rel(t3, t2);
    let better = best;
    for (let k = t4 * NEAR; k < t4 * NEAR + NEAR_THIRD; k++) {
      const t5 = near[k];
      const g3 = g2 - nearDistance[k];
      const minGain = better?.gain ?? EPSILON;
      if (t5 < 0 || g3 <= minGain) break;
      if (t5 === t1 || !isSingleRing(rel3, this.rel(t5, t2))) continue;
      const t6 = this.partnerOf(t5);
      const gain = g3 + this.gap(t5, t6) - this.gap(t6, t1);
      if (gain > minGain) better = { gain, t3, t5 };
    }
    return better;
  }

  /** The position of an end counted from t2, away from t1. */
  private rel(end: number, t2: number): number {
    const { place, ends } = this;
    // t2 is the entry of its stroke (even) if it comes after t1.
    const rel = isEven(place[t2]) ? place[end] - place[t2] : place[t2] - place[end];
    return rel < 0 ? rel + ends : rel;
  }

  /** Makes a move, as reversals of sections. */
  private makeMove(t1: number, t2: number, { gain, t3, t5 }: Move): void {
    const t4 = this.partnerOf(t3);
    const changed = [t1, t2, t3, t4];
    if (t5 === null) {
      this.turn(t1, t2, t4, t3);
    } else {
      const t6 = this.partnerOf(t5);
      changed.push(t5, t6);
      const { place } = this;
      // Both entries or both exits.
      const isLike2 = (end: number): boolean => isEven(place[end]) === isEven(place[t2]);
      if (isLike2(t3)) {
        this.turn(t1, t2, t4, t3);
        this.turn(t1, t4, t6, t5);
      } else if (isLike2(t5)) {
        this.turn(t1, t2, t6, t5);
        this.turn(t2, t5, t3, t4);
      } else {
        this.swapShortest(t1, t2, t5, t6, t3, t4);
      }
    }
    this.length -= gain;
    for (const end of changed) this.push(end);
  }

  /** p [x0 … x1] [y0 … y1] n becomes p [y0 … y1] [x0 … x1] n. */
  private swap(p: number, x0: number, x1: number, y0: number, y1: number, n: number): void {
    this.turn(p, x0, y1, n);
    this.turn(p, y1, y0, x1);
    this.turn(y1, x1, x0, n);
  }

  /**
   * The same if the whole ring consists of three sections. Exchanging any two of them gives the same ring, so exchange
   * the two shortest.
   */
  private swapShortest(p: number, x0: number, x1: number, y0: number, y1: number, n: number): void {
    const x = this.span(x0, x1);
    const y = this.span(y0, y1);
    const rest = this.ends - x - y;
    if (rest >= x && rest >= y) this.swap(p, x0, x1, y0, y1, n);
    else if (x >= y) this.swap(x1, y0, y1, n, p, x0);
    else this.swap(y1, n, p, x0, x1, y0);
  }

  private span(a: number, b: number): number {
    const forward = isEven(this.place[a]);
    const span = forward ? this.place[b] - this.place[a] : this.place[a] - this.place[b];
    return (span < 0 ? span + this.ends : span) + 1;
  }

  /** Removes travel a b and c d (b after a, d after c, in either direction), adds a c and b d: reverses b … c. */
  private turn(a: number, b: number, c: number, d: number): void {
    const { place, ends } = this;
    // If b is an entry (even), the section is b … c in the ring, otherwise c … b.
    const forward = isEven(place[b]);
    const first = forward ? place[b] : place[c];
    const last = forward ? place[c] : place[b];
    let inner = last - first;
    if (inner < 0) inner += ends;
    // Reversing the rest of the ring instead gives the same ring.
    if (2 * (inner + 1) <= ends) this.turnPlaces(first, last);
    else if (forward) this.turnPlaces(place[d], place[a]);
    else this.turnPlaces(place[a], place[d]);
  }

  private turnPlaces(first: number, last: number): void {
    const { tour, place, ends } = this;
    this.log.push(first, last);
    let count = last - first;
    if (count < 0) count += ends;
    let i = first;
    let j = last;
    for (let k = Math.floor((count + 1) / 2); k > 0; k--) {
      const a = tour[i];
      const b = tour[j];
      tour[i] = b;
      place[b] = i;
      tour[j] = a;
      place[a] = j;
      if (++i === ends) i = 0;
      if (--j < 0) j = ends - 1;
    }
  }

  private next(p: number): number {
    return p + 1 === this.ends ? 0 : p + 1;
  }

  private previous(p: number): number {
    return p === 0 ? this.ends - 1 : p - 1;
  }

  /** The other end of an end's travel edge. */
  private partnerOf(end: number): number {
    const p = this.place[end];
    return this.tour[isEven(p) ? this.previous(p) : this.next(p)];
  }

  private gap(a: number, b: number): number {
    const dx = this.xy[2 * a] - this.xy[2 * b];
    const dy = this.xy[2 * a + 1] - this.xy[2 * b + 1];
    return Math.sqrt(dx * dx + dy * dy);
  }

  private push(end: number): void {
    if (this.queued[end] === 1) return;
    this.queued[end] = 1;
    let at = this.queueFrom + this.queueSize++;
    if (at >= this.ends) at -= this.ends;
    this.queue[at] = end;
  }

  private pop(): number {
    const end = this.queue[this.queueFrom];
    this.queueFrom = this.next(this.queueFrom);
    this.queueSize--;
    this.queued[end] = 0;
    return end;
  }
}

const strokeOf = (end: number): number => Math.floor(end / 2);

const isEven = (position: number): boolean => position % 2 === 0;

/** Whether a move with t3 and t5 at these positions leaves a single ring (see the file's comment). */
function isSingleRing(rel3: number, rel5: number): boolean {
  if (!isEven(rel3)) return rel5 > 0 && rel5 < rel3;
  return rel5 > rel3 ? isEven(rel5) : rel5 < rel3 - 1 && !isEven(rel5);
}
