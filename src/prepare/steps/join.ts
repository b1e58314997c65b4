/**
 * Joins lines of one colour whose ends meet, within a layer, so that the pen stays down.
 *
 * Every end is paired with at most one other end nearby; chains of paired lines become one line. The first round pairs
 * ends at the same point, the second round the remaining ends. Both choose the end where the pen turns least, so that in a
 * mesh the pen goes straight through a crossing.
 *
 * Symbols: end 2i is the first point of line i, end 2i + 1 its last. `far[e]` is the other end of the chain that ends in
 * e (valid for chain ends only). It shows whether a pair would join a chain to itself, which only real loops may do.
 *
 * No points move: joining adds the gap, at most `radius`, as a straight segment. Dots and closed lines are unchanged.
 */
import { NearestPoints, PointGrid } from "../../geometry/point-grid.js";
import {
  LineBuilder,
  SAME_POINT_MM,
  isClosedLine,
  lineLength,
  rangesBy,
  type Lines,
} from "../../geometry/polyline.js";

/** Max candidates compared at one point, so that the time stays linear even for a star of 100 000 rays. */
const MAX_CANDIDATES = 24;
/** A chain shorter than this many radii is not closed, because its ends are close only because it is short. */
const SHORTEST_LOOP = 4;
/** Of the ends within the radius, those up to this many times as far as the nearest are compared. */
const FARTHER = 2;
const UNPAIRED = -1;

/**
 * Joins lines of the same tag. `rangeOf` says which tags are one range: its lines must be contiguous, and lines of other
 * ranges are not looked at. `radius` in mm; 0 joins only ends that coincide.
 */
export function joinLines(lines: Lines, radius: number, rangeOf: (tag: number) => number): Lines {
  const builder = new LineBuilder();
  for (const [first, end] of rangesBy(lines, rangeOf)) {
    const pairing = new EndPairing(lines, first, end, Math.max(radius, SAME_POINT_MM));
    pairing.run(SAME_POINT_MM);
    if (radius > SAME_POINT_MM) pairing.run(radius);
    pairing.write(builder);
  }
  return builder.finish();
}

/** Joins a line only to the one before it in the file, in their directions, so that the file's order is kept. */
export function joinInFileOrder(lines: Lines, radius: number): Lines {
  const { xy, offsets, tag } = lines;
  const builder = new LineBuilder();
  const isJoinable = (i: number): boolean => offsets[i + 1] - offsets[i] > 1 && !isClosedLine(lines, i);
  for (let i = 0; i < tag.length; i++) {
    builder.extend(lines, i, false);
    const next = i + 1;
    const end = 2 * (offsets[next] - 1);
    const meets =
      next < tag.length &&
      tag[next] === tag[i] &&
      isJoinable(i) &&
      isJoinable(next) &&
      Math.hypot(xy[end + 2] - xy[end], xy[end + 3] - xy[end + 1]) <= Math.max(radius, SAME_POINT_MM);
    if (!meets) builder.end(tag[i]);
  }
  return builder.finish();
}

/** Pairs the ends of the lines [first, end), except those of dots and closed lines. */
class EndPairing {
  private readonly partner: Int32Array;
  private readonly far: Int32Array;
  private readonly length: Float64Array;
  private readonly xy: Float64Array;
  /** Unit vector at each end, pointing away from its line. */
  private readonly out: Float64Array;
  /** The ends that can still be paired, and 1 for each of them. */
  private readonly free: PointGrid;
  private readonly isFree: Uint8Array;
  private readonly near = new NearestPoints(MAX_CANDIDATES);

  constructor(
    private readonly lines: Lines,
    private readonly first: number,
    end: number,
    private readonly radius: number,
  ) {
    const ends = 2 * (end - first);
    this.partner = new Int32Array(ends).fill(UNPAIRED);
    this.far = new Int32Array(ends);
    this.length = new Float64Array(ends);
    this.xy = new Float64Array(2 * ends);
    this.out = new Float64Array(2 * ends);
    for (let e = 0; e < ends; e += 2) {
      const line = this.lineOf(e);
      this.setEnd(e, lines.offsets[line], 1);
      this.setEnd(e + 1, lines.offsets[line + 1] - 1, -1);
      this.far[e] = e + 1;
      this.far[e + 1] = e;
      this.length[e] = this.length[e + 1] = lineLength(lines, line);
    }
    this.free = new PointGrid(this.xy);
    this.isFree = new Uint8Array(ends).fill(1);
    for (let e = 0; e < ends; e += 2) {
      const line = this.lineOf(e);
      const isDot = lines.offsets[line + 1] - lines.offsets[line] === 1;
      if (isDot || isClosedLine(lines, line)) {
        this.take(e);
        this.take(e + 1);
      }
    }
    this.removeIsolated();
  }

  /** Removes ends without another end within the radius: almost all in most drawings. */
  private removeIsolated(): void {
    const two = new NearestPoints(2);
    for (let e = 0; e < this.isFree.length; e++) {
      if (this.isFree[e] === 0) continue;
      this.free.find(this.xy[2 * e], this.xy[2 * e + 1], this.radius, two);
      if (two.count < 2) this.take(e);
    }
  }

  /** The line of an end. */
  private lineOf(e: number): number {
    return this.first + (e >> 1);
  }

  private setEnd(e: number, at: number, step: number): void {
    const { xy } = this.lines;
    const dx = xy[2 * at] - xy[2 * (at + step)];
    const dy = xy[2 * at + 1] - xy[2 * (at + step) + 1];
    const length = Math.sqrt(dx * dx + dy * dy) || 1;
    this.xy[2 * e] = xy[2 * at];
    this.xy[2 * e + 1] = xy[2 * at + 1];
    this.out[2 * e] = dx / length;
    this.out[2 * e + 1] = dy / length;
  }

  /** Pairs each free end with the free one within `reach` where the pen turns least. */
  run(reach: number): void {
    for (let e = 0; e < this.partner.length; e++) {
      if (this.isFree[e] === 0) continue;
      const other = this.best(e, reach);
      if (other >= 0) this.pair(e, other);
    }
  }

  private best(e: number, reach: number): number {
    const { near, xy } = this;
    const x = xy[2 * e];
    const y = xy[2 * e + 1];
    this.free.find(x, y, reach, near);
    let best = -1;
    let bestTurn = Infinity;
    let farthest = Infinity;
    // The nearest come first.
    for (let k = 0; k < near.count; k++) {
      const other = near.ids[k];
      if (other === e || !this.mayPair(e, other)) continue;
      const gap = Math.hypot(xy[2 * other] - x, xy[2 * other + 1] - y);
      if (gap > farthest) break;
      farthest = Math.min(farthest, Math.max(FARTHER * gap, SAME_POINT_MM));
      const turn = this.turn(e, other, gap);
      if (turn < bestTurn) {
        bestTurn = turn;
        best = other;
      }
    }
    return best;
  }

  /** How much the pen turns from end e to `other`, 0 (straight on) to 4 (back, and back again). */
  private turn(e: number, other: number, gap: number): number {
    const { out, xy } = this;
    const [ux, uy] = [out[2 * e], out[2 * e + 1]];
    const [vx, vy] = [-out[2 * other], -out[2 * other + 1]];
    if (gap <= SAME_POINT_MM) return 1 - (ux * vx + uy * vy);
    const dx = (xy[2 * other] - xy[2 * e]) / gap;
    const dy = (xy[2 * other + 1] - xy[2 * e + 1]) / gap;
    return 2 - (ux * dx + uy * dy) - (dx * vx + dy * vy);
  }

  private take(e: number): void {
    this.free.remove(e);
    this.isFree[e] = 0;
  }

  private mayPair(e: number, other: number): boolean {
    const { tag } = this.lines;
    if (tag[this.lineOf(e)] !== tag[this.lineOf(other)]) return false;
    return this.far[e] !== other || this.length[e] > SHORTEST_LOOP * this.radius;
  }

  private pair(e: number, other: number): void {
    this.partner[e] = other;
    this.partner[other] = e;
    this.take(e);
    this.take(other);
    const head = this.far[e];
    const tail = this.far[other];
    const length = this.length[e] + this.length[other];
    this.far[head] = tail;
    this.far[tail] = head;
    this.length[head] = this.length[tail] = length;
  }

  /** Writes each chain at the position of the first of its lines. */
  write(builder: LineBuilder): void {
    const { partner, lines } = this;
    const done = new Uint8Array(partner.length / 2);
    for (let e = 0; e < partner.length; e += 2) {
      const line = this.lineOf(e);
      if (partner[e] === UNPAIRED && partner[e + 1] === UNPAIRED) builder.copy(lines, line, lines.tag[line]);
      else if (done[e >> 1] === 0) this.writeChain(e, done, builder);
    }
  }

  /**
   * Writes the chain that contains the line with the first end `start`, in that line's direction. It starts at a free
   * end; a loop starts at that line.
   */
  private writeChain(start: number, done: Uint8Array, builder: LineBuilder): void {
    const { partner, lines } = this;
    let entry = start;
    while (partner[entry] !== UNPAIRED) {
      entry = partner[entry] ^ 1;
      if (entry >> 1 === start >> 1) break;
    }
    const head = entry;
    for (;;) {
      done[entry >> 1] = 1;
      builder.extend(lines, this.lineOf(entry), (entry & 1) === 1);
      const next = partner[entry ^ 1];
      if (next === UNPAIRED || next === head) break;
      entry = next;
    }
    if (partner[head] !== UNPAIRED) builder.point(this.xy[2 * head], this.xy[2 * head + 1]);
    builder.end(lines.tag[this.lineOf(start)]);
  }
}
