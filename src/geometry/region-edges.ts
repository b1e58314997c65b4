/**
 * The edges of a region, to tell which parts of a straight segment are inside.
 *
 *            ┌─────────┐
 *    ───────●┼─────────┼●──────>    Each edge that crosses the segment changes the winding number by one. It is
 *          t0│         │t1          computed for one point, in the middle of the longest part, and counted from there.
 *            └─────────┘
 *
 * A tree of boxes (Flatbush) finds the edges near a segment, so that the cost grows with the crossings and not with the
 * size of the region. A vertex on the segment's line counts as to the right of it, for all edges that meet there. So a
 * crossing at a vertex is neither lost nor counted twice.
 *
 * A line on an edge is half inside, and kept. A run is a part of the line that stays within `onEdge` mm of edges. A short
 * run from one side to the other is a crossing, and the line is cut at the edge. A long run lies on the edge; so does one
 * that leaves to the kept side at both ends.
 */
import Flatbush from "flatbush";
import type { Paths64 } from "clipper2-ts/dist/Core.js";
import { boxOfPoints, insideRange } from "./box.js";
import { SAME_POINT_MM, isClosedLine, mix, type Lines } from "./polyline.js";

/** A line this close to an edge lies on it, mm: far below any pen width, above all rounding. */
const ON_EDGE = 0.002;
/** Lines further apart than this are never taken for the same, even if curves become very coarse chords, mm. */
const MAX_GAP_OF_CHORDS = 0.09;
/** A crossing at more than 6° is shorter than this many times `onEdge`. */
const LONG_RUN = 20;
/** With fewer edges a tree does not pay. */
const MIN_EDGES_OF_TREE = 16;

/**
 * How close to an edge a line lies on it, mm. The same curve may be divided into other chords there. All their ends lie on
 * the curve, so the line and the edge are no further apart than the larger of their gaps to the curve.
 */
export const onEdgeFor = (gapOfLine: number, gapOfEdges: number): number =>
  ON_EDGE + Math.min(Math.max(gapOfLine, gapOfEdges), MAX_GAP_OF_CHORDS);

/** The least length of a run that is no crossing, mm. */
export const longRun = (onEdge: number): number => LONG_RUN * onEdge;

/** A part of a segment, from and to a share of its length. */
export type SegmentPart = [from: number, to: number];

interface Crossing {
  readonly t: number;
  /** Change of the winding number. */
  readonly turn: number;
}

/** Where a run ends. */
interface EdgeRunEnd {
  /** Its length up to there, beyond the segment, mm. */
  readonly length: number;
  /** Whether the line continues where it is kept. */
  readonly isKept: boolean;
}

export class RegionEdges {
  /** x0, y0, x1, y1 of each edge, mm. */
  private readonly ends: Float64Array;
  private readonly tree: Flatbush | null;
  private readonly maxX: number;
  private readonly maxY: number;
  /** Whether the rays that find the winding number are vertical, because these cross fewer edges. */
  private readonly isRayVertical: boolean;

  constructor(rings: Paths64, unitsPerMm: number) {
    const count = rings.reduce((sum, ring) => sum + ring.length, 0);
    const ends = new Float64Array(4 * count);
    let at = 0;
    let [width, height] = [0, 0];
    for (const ring of rings) {
      for (let k = 0, j = ring.length - 1; k < ring.length; j = k++, at += 4) {
        ends[at] = ring[j].x / unitsPerMm;
        ends[at + 1] = ring[j].y / unitsPerMm;
        ends[at + 2] = ring[k].x / unitsPerMm;
        ends[at + 3] = ring[k].y / unitsPerMm;
        width += Math.abs(ends[at + 2] - ends[at]);
        height += Math.abs(ends[at + 3] - ends[at + 1]);
      }
    }
    const box = boxOfPoints(ends);
    this.ends = ends;
    this.maxX = box.x1;
    this.maxY = box.y1;
    this.isRayVertical = width * (box.y1 - box.y0) < height * (box.x1 - box.x0);
    this.tree = count < MIN_EDGES_OF_TREE ? null : new Flatbush(count);
    for (let k = 0; k < ends.length && this.tree !== null; k += 4) {
      const [x0, y0, x1, y1] = [ends[k], ends[k + 1], ends[k + 2], ends[k + 3]];
      this.tree.add(Math.min(x0, x1), Math.min(y0, y1), Math.max(x0, x1), Math.max(y0, y1));
    }
    this.tree?.finish();
  }

  /** The winding number at a point; on an edge, that of either side. */
  windingAt(x: number, y: number): number {
    const { ends, isRayVertical } = this;
    const edges = isRayVertical ? this.near(x, y, x, this.maxY) : this.near(x, y, this.maxX, y);
    let winding = 0;
    for (const e of edges) {
      const x0 = ends[4 * e] - x;
      const y0 = ends[4 * e + 1] - y;
      const x1 = ends[4 * e + 2] - x;
      const y1 = ends[4 * e + 3] - y;
      const [from, to] = isRayVertical ? [x0, x1] : [y0, y1];
      if (from > 0 === to > 0) continue;
      // Positive if the edge passes the point anticlockwise, whichever way it crosses the ray's line.
      const side = x0 * y1 - x1 * y0;
      const turn = isRayVertical === to > 0 ? -1 : 1;
      if (side * turn > 0) winding += turn;
    }
    return winding;
  }

  /**
   * The parts of segment `p` of line `i` inside the region, or outside with `keepOutside`; parts on an edge, within
   * `onEdge` mm, always belong to them. A segment has the number of its first point. `known` is the winding number at the
   * segment's start, or null. Also returns the one at its end, null if an edge is near.
   */
  partsOf(
    lines: Lines,
    i: number,
    p: number,
    keepOutside: boolean,
    onEdge: number,
    known: number | null,
  ): { readonly parts: readonly SegmentPart[]; readonly windingAtEnd: number | null } {
    const { length, crossings, runs } = this.meet(lines, p, onEdge);
    const isKept = (winding: number): boolean => (winding === 0) === keepOutside;
    let start = known;
    const windingAtStart = (): number => (start ??= this.windingAtStart(lines, p, crossings, runs));
    const turnsBefore = turnsAlong(crossings);
    const endOfRun = (t: number): EdgeRunEnd => {
      if (t === 0) return this.follow(lines, i, p, -1, isKept, onEdge);
      if (t === 1) return this.follow(lines, i, p, 1, isKept, onEdge);
      return { length: 0, isKept: isKept(windingAtStart() + turnsBefore(t)) };
    };
    const parts = runs.filter(([from, to]) => {
      const here = (to - from) * length;
      if (here >= longRun(onEdge)) return true;
      const before = endOfRun(from);
      if (before.length + here >= longRun(onEdge)) return true;
      const after = endOfRun(to);
      return (before.isKept && after.isKept) || before.length + here + after.length >= longRun(onEdge);
    });
    if (parts.length === 1 && isWhole(parts[0])) return { parts, windingAtEnd: null };
    const windingAtEnd = addCrossed(crossings, windingAtStart(), isKept, parts);
    const isEndFree = runs.at(-1)?.[1] !== 1;
    return { parts: merged(parts, SAME_POINT_MM / length), windingAtEnd: isEndFree ? windingAtEnd : null };
  }

  /** The edges that cross segment `p`, and its parts within `onEdge` mm of edges. Both ascend. */
  private meet(
    { xy }: Lines,
    p: number,
    onEdge: number,
  ): { readonly length: number; readonly crossings: readonly Crossing[]; readonly runs: SegmentPart[] } {
    const [x0, y0, x1, y1] = [xy[2 * p], xy[2 * p + 1], xy[2 * p + 2], xy[2 * p + 3]];
    const dx = x1 - x0;
    const dy = y1 - y0;
    const length = Math.sqrt(dx * dx + dy * dy);
    const rounding = SAME_POINT_MM / length;
    const crossings: Crossing[] = [];
    const near: SegmentPart[] = [];
    for (const e of this.near(
      Math.min(x0, x1) - onEdge,
      Math.min(y0, y1) - onEdge,
      Math.max(x0, x1) + onEdge,
      Math.max(y0, y1) + onEdge,
    )) {
      const ax = this.ends[4 * e] - x0;
      const ay = this.ends[4 * e + 1] - y0;
      const bx = this.ends[4 * e + 2] - x0;
      const by = this.ends[4 * e + 3] - y0;
      // Distances of the edge's ends from the segment's line.
      const a = (dx * ay - dy * ax) / length;
      const b = (dx * by - dy * bx) / length;
      if (Math.min(a, b) > onEdge || Math.max(a, b) < -onEdge) continue;
      if (a > 0 !== b > 0) {
        // Shares of the segment.
        const ta = (ax * dx + ay * dy) / (length * length);
        const tb = (bx * dx + by * dy) / (length * length);
        const t = ta + ((tb - ta) * a) / (a - b);
        if (t > rounding && t < 1 - rounding) crossings.push({ t, turn: b > 0 ? -1 : 1 });
      }
      const part = partAround(ax, ay, bx, by, dx, dy, onEdge);
      if (part !== null) near.push(part);
    }
    crossings.sort((c, d) => c.t - d.t);
    return { length, crossings, runs: merged(near, rounding) };
  }

  /**
   * Follows a run from the end of segment `p`, or backwards from its start: its length there, as far as it matters, and
   * whether the line continues where it is kept. The end of a line counts as kept.
   */
  private follow(
    lines: Lines,
    i: number,
    p: number,
    step: 1 | -1,
    isKept: (winding: number) => boolean,
    onEdge: number,
  ): EdgeRunEnd {
    const first = lines.offsets[i];
    const last = lines.offsets[i + 1] - 2;
    const isClosed = isClosedLine(lines, i);
    let length = 0;
    for (let q = p + step; length < longRun(onEdge); q += step) {
      if (isClosed && q > last) q = first;
      else if (isClosed && q < first) q = last;
      if (q === p || q < first || q > last) break;
      const { length: ofSegment, runs } = this.meet(lines, q, onEdge);
      const joint = step === 1 ? 0 : 1;
      const run = runs.find((part) => part.includes(joint)) ?? [joint, joint];
      length += (run[1] - run[0]) * ofSegment;
      if (isWhole(run)) continue;
      const end = step === 1 ? run[1] : run[0];
      return { length, isKept: isKept(this.windingAt(...pointAt(lines, q, end))) };
    }
    return { length, isKept: true };
  }

  /**
   * The winding number at the start of segment `p`, from the one in the middle of its longest part without an edge near;
   * if edges are near all of it, of its longest part without a crossing.
   */
  private windingAtStart(
    lines: Lines,
    p: number,
    crossings: readonly Crossing[],
    runs: readonly SegmentPart[],
  ): number {
    const isNearAll = runs.length === 1 && isWhole(runs[0]);
    const stops = isNearAll ? crossings.map(({ t }): SegmentPart => [t, t]) : runs;
    let [middle, longest, from] = [0.5, 0, 0];
    for (const stop of [...stops, [1, 1]]) {
      if (stop[0] - from > longest) [middle, longest] = [(from + stop[0]) / 2, stop[0] - from];
      from = stop[1];
    }
    const turns = crossings.reduce((sum, { t, turn }) => (t < middle ? sum + turn : sum), 0);
    return this.windingAt(...pointAt(lines, p, middle)) - turns;
  }

  /** The edges whose boxes touch this box. */
  private near(x0: number, y0: number, x1: number, y1: number): number[] {
    if (this.tree !== null) return this.tree.search(x0, y0, x1, y1);
    const { ends } = this;
    const found: number[] = [];
    for (let k = 0; k < ends.length; k += 4) {
      if (ends[k] < x0 && ends[k + 2] < x0) continue;
      if (ends[k] > x1 && ends[k + 2] > x1) continue;
      if (ends[k + 1] < y0 && ends[k + 3] < y0) continue;
      if (ends[k + 1] > y1 && ends[k + 3] > y1) continue;
      found.push(k / 4);
    }
    return found;
  }
}

/**
 * The part of the segment from the origin to (dx, dy) in a box around the edge from a to b, which goes `onEdge` beyond it
 * on all sides. Null if there is none.
 */
function partAround(
  ax: number,
  ay: number,
  bx: number,
  by: number,
  dx: number,
  dy: number,
  onEdge: number,
): SegmentPart | null {
  const ex = bx - ax;
  const ey = by - ay;
  const length = Math.sqrt(ex * ex + ey * ey);
  if (length === 0) return null;
  // The segment's start and extent along the edge and across it.
  const u = -(ax * ex + ay * ey) / length;
  const v = (ax * ey - ay * ex) / length;
  const du = (dx * ex + dy * ey) / length;
  const dv = (dy * ex - dx * ey) / length;
  const around = { x0: -onEdge, y0: -onEdge, x1: length + onEdge, y1: onEdge };
  return insideRange(u, v, u + du, v + dv, around);
}

const isWhole = ([from, to]: SegmentPart): boolean => from === 0 && to === 1;

const pointAt = ({ xy }: Lines, p: number, t: number): [x: number, y: number] => [
  mix(xy[2 * p], xy[2 * p + 2], t),
  mix(xy[2 * p + 1], xy[2 * p + 3], t),
];

/** The change of the winding number from the start to `t`, for ascending `t`. */
function turnsAlong(crossings: readonly Crossing[]): (t: number) => number {
  let k = 0;
  let turns = 0;
  return (t) => {
    for (; k < crossings.length && crossings[k].t < t; k++) turns += crossings[k].turn;
    return turns;
  };
}

/** Adds the parts between crossings that are wanted. Returns the winding number at the end. */
function addCrossed(
  crossings: readonly Crossing[],
  windingAtStart: number,
  isKept: (winding: number) => boolean,
  parts: SegmentPart[],
): number {
  let winding = windingAtStart;
  let from = 0;
  for (const { t, turn } of crossings) {
    if (isKept(winding)) parts.push([from, t]);
    winding += turn;
    from = t;
  }
  if (isKept(winding)) parts.push([from, 1]);
  return winding;
}

/** The union of the parts, ascending. Parts and gaps up to `rounding` do not count, and ends this near to 0 or 1 are there. */
export function merged(parts: readonly SegmentPart[], rounding: number): SegmentPart[] {
  const sorted = parts.filter(([from, to]) => to - from > 0).sort((p, q) => p[0] - q[0]);
  const united: SegmentPart[] = [];
  for (const [from, to] of sorted) {
    const last = united.at(-1);
    if (last !== undefined && from - last[1] <= rounding) last[1] = Math.max(last[1], to);
    else united.push([from, to]);
  }
  return united
    .filter(([from, to]) => to - from > rounding)
    .map(([from, to]) => [from <= rounding ? 0 : from, to >= 1 - rounding ? 1 : to]);
}
