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
 */
import Flatbush from "flatbush";
import type { Paths64 } from "clipper2-ts";
import { boxOfPoints } from "./box.js";
import { SAME_POINT } from "./polyline.js";

/** A line this close to an edge lies on it, mm: far below any pen width, above all rounding. */
export const ON_EDGE = 0.002;
/** A segment that crosses an edge is near it too, but not over this length. */
const SHORTEST_ON_EDGE = 8 * ON_EDGE;
/** With fewer edges a tree does not pay. */
const MIN_EDGES_OF_TREE = 16;

/** A part of a segment, from and to a share of its length. */
export type Part = [from: number, to: number];

interface Crossing {
  readonly t: number;
  /** Change of the winding number. */
  readonly turn: number;
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
   * The parts of a segment inside the region, or outside with `keepOutside`; parts on an edge always belong to them.
   * `known` is the winding number at the segment's start, or null. Also returns the one at its end, null if an edge is
   * near.
   */
  partsOf(
    x0: number,
    y0: number,
    x1: number,
    y1: number,
    keepOutside: boolean,
    known: number | null,
  ): { readonly parts: readonly Part[]; readonly windingAtEnd: number | null } {
    const dx = x1 - x0;
    const dy = y1 - y0;
    const length = Math.sqrt(dx * dx + dy * dy);
    const rounding = SAME_POINT / length;
    const margin = ON_EDGE / length;
    const crossings: Crossing[] = [];
    /** Where the segment is near an edge; those that run along it are among the parts. */
    const near: Part[] = [];
    const parts: Part[] = [];
    let isEndFree = true;
    for (const e of this.near(
      Math.min(x0, x1) - ON_EDGE,
      Math.min(y0, y1) - ON_EDGE,
      Math.max(x0, x1) + ON_EDGE,
      Math.max(y0, y1) + ON_EDGE,
    )) {
      const ax = this.ends[4 * e] - x0;
      const ay = this.ends[4 * e + 1] - y0;
      const bx = this.ends[4 * e + 2] - x0;
      const by = this.ends[4 * e + 3] - y0;
      // Distances from the segment's line, and shares of the segment.
      const a = (dx * ay - dy * ax) / length;
      const b = (dx * by - dy * bx) / length;
      const ta = (ax * dx + ay * dy) / (length * length);
      const tb = (bx * dx + by * dy) / (length * length);
      const along = (distance: number): number =>
        a === b ? ta : ta + ((tb - ta) * (a - distance)) / (a - b);
      if (a > 0 !== b > 0) {
        const t = along(0);
        if (t > rounding && t < 1 - rounding) crossings.push({ t, turn: b > 0 ? -1 : 1 });
      }
      if (Math.min(a, b) > ON_EDGE || Math.max(a, b) < -ON_EDGE) continue;
      const first = Math.abs(a) <= ON_EDGE ? ta : along(a > 0 ? ON_EDGE : -ON_EDGE);
      const last = Math.abs(b) <= ON_EDGE ? tb : along(b > 0 ? ON_EDGE : -ON_EDGE);
      const [from, to] = first < last ? [first, last] : [last, first];
      if (to >= 1 - margin && from <= 1 + margin) isEndFree = false;
      const part: Part = [Math.max(from - margin, 0), Math.min(to + margin, 1)];
      if (part[0] >= part[1]) continue;
      near.push([Math.max(from, 0), Math.min(to, 1)]);
      const isWhole = (part[0] === 0 && part[1] === 1) || (Math.abs(a) <= ON_EDGE && Math.abs(b) <= ON_EDGE);
      if (isWhole || (to - from) * length > SHORTEST_ON_EDGE) parts.push(part);
    }
    crossings.sort((p, q) => p.t - q.t);
    const winding = known ?? this.windingAtStart(crossings, near, (t) => [x0 + t * dx, y0 + t * dy]);
    const windingAtEnd = addCrossed(crossings, winding, keepOutside, parts);
    return { parts: merged(parts, rounding), windingAtEnd: isEndFree ? windingAtEnd : null };
  }

  /** The winding number at the start of a segment, from the one in the middle of its longest part without an edge near. */
  private windingAtStart(
    crossings: readonly Crossing[],
    near: Part[],
    placeOf: (t: number) => readonly [x: number, y: number],
  ): number {
    let [middle, longest, from] = [0.5, 0, 0];
    for (const part of [...near.sort((p, q) => p[0] - q[0]), [1, 1]]) {
      if (part[0] - from > longest) [middle, longest] = [(from + part[0]) / 2, part[0] - from];
      from = Math.max(from, part[1]);
    }
    const turns = crossings.reduce((sum, { t, turn }) => (t < middle ? sum + turn : sum), 0);
    return this.windingAt(...placeOf(middle)) - turns;
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

/** Adds the parts between crossings that are wanted. Returns the winding number at the end. */
function addCrossed(
  crossings: readonly Crossing[],
  windingAtStart: number,
  keepOutside: boolean,
  parts: Part[],
): number {
  let winding = windingAtStart;
  let from = 0;
  for (const { t, turn } of crossings) {
    if ((winding === 0) === keepOutside) parts.push([from, t]);
    winding += turn;
    from = t;
  }
  if ((winding === 0) === keepOutside) parts.push([from, 1]);
  return winding;
}

/** The union of the parts, ascending. Parts and gaps up to `rounding` do not count, and ends this near to 0 or 1 are there. */
export function merged(parts: readonly Part[], rounding: number): Part[] {
  const sorted = parts.filter(([from, to]) => to - from > 0).sort((p, q) => p[0] - q[0]);
  const united: Part[] = [];
  for (const [from, to] of sorted) {
    const last = united.at(-1);
    if (last !== undefined && from - last[1] <= rounding) last[1] = Math.max(last[1], to);
    else united.push([from, to]);
  }
  return united
    .filter(([from, to]) => to - from > rounding)
    .map(([from, to]) => [from <= rounding ? 0 : from, to >= 1 - rounding ? 1 : to]);
}
