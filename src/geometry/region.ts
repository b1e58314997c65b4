/**
 * Areas of the plane. Uses Clipper2 (A. Johnson; clipper2-ts).
 *
 * Clipper works on integers. One unit is 0.1 µm (SCALE): far below any pen width, and products of two
 * coordinates on any paper stay exact in a double. A region is always clean: its rings do not cross,
 * and their winding makes holes under the non-zero rule.
 */
import Flatbush from "flatbush";
import { ClipType, FillRule, type Path64, type Paths64 } from "clipper2-ts/dist/Core.js";
import { Clipper64 } from "clipper2-ts/dist/Engine.js";
import type { Box } from "./box.js";
import { type LineBuilder, type Lines } from "./polyline.js";
import { RegionEdges } from "./region-edges.js";

/** Clipper units per mm. */
export const SCALE = 10_000;

/** With fewer rings, or fewer edges side by side, Clipper takes them as they are. */
const MIN_RINGS_OF_HEAPS = 50;
const MANY_EDGES_ACROSS = 100;

/** `rings` in Clipper units; `box` in mm. */
export interface Region {
  readonly rings: Paths64;
  readonly box: Box;
  /** True if the region is exactly its box: then a line is clipped faster. */
  readonly isBox: boolean;
  /** Max gap between its edges and the curves they replace, mm. */
  readonly gap: number;
  /** For lines and points in the region; collected by the first call. */
  edges(): RegionEdges;
}

/** Points x, y, x, y … [from, to) in mm as a ring in Clipper units. */
export function ringOf(xy: ArrayLike<number>, from = 0, to = xy.length): Path64 {
  const ring: Path64 = [];
  for (let k = from; k < to; k += 2) {
    ring.push({ x: Math.round(xy[k] * SCALE), y: Math.round(xy[k + 1] * SCALE) });
  }
  return ring;
}

export const ringOfLine = ({ xy, offsets }: Lines, i: number): Path64 =>
  ringOf(xy, 2 * offsets[i], 2 * offsets[i + 1]);

/** A region from rings that are already clean; `gap` if they replace curves. */
export function regionOf(rings: Paths64, gap = 0): Region {
  const { x0, y0, x1, y1 } = boxOfRings(rings);
  const box = { x0: x0 / SCALE, y0: y0 / SCALE, x1: x1 / SCALE, y1: y1 / SCALE };
  let edges: RegionEdges | null = null;
  return {
    rings,
    box,
    isBox: rings.length === 1 && isRectangle(rings[0]),
    gap,
    edges: () => (edges ??= new RegionEdges(rings, SCALE)),
  };
}

/** In Clipper units. */
function boxOfRings(rings: Paths64): Box {
  let [x0, y0, x1, y1] = [Infinity, Infinity, -Infinity, -Infinity];
  for (const ring of rings) {
    for (const { x, y } of ring) {
      x0 = Math.min(x0, x);
      y0 = Math.min(y0, y);
      x1 = Math.max(x1, x);
      y1 = Math.max(y1, y);
    }
  }
  return { x0, y0, x1, y1 };
}

function isRectangle(ring: Path64): boolean {
  if (ring.length !== 4) return false;
  return ring.every((p, k) => {
    const next = ring[(k + 1) % 4];
    const after = ring[(k + 2) % 4];
    return (p.x === next.x) !== (p.y === next.y) && (p.x === next.x) === (next.y === after.y);
  });
}

/** The area that `rings` enclose under `rule`. Rings that lie apart from the others are cleaned apart. */
export const cleanRings = (rings: Paths64, rule: FillRule): Paths64 =>
  heaps(rings).flatMap((heap) => combine(ClipType.Union, heap, [], rule));

/**
 * Rings whose boxes touch, directly or through others, in one heap: these can cross each other or lie inside one
 * another. Clipper compares each ring with all beside it, so that a row of thousands would take minutes at once.
 */
export function heaps(rings: Paths64): Paths64[] {
  if (rings.length < MIN_RINGS_OF_HEAPS) return [rings];
  const tree = new Flatbush(rings.length);
  const boxes = rings.map((ring) => boxOfRings([ring]));
  for (const { x0, y0, x1, y1 } of boxes) tree.add(x0, y0, x1, y1);
  tree.finish();
  const heapOf = new Int32Array(rings.length).fill(-1);
  const found: Paths64[] = [];
  for (let first = 0; first < rings.length; first++) {
    if (heapOf[first] >= 0) continue;
    const heap = found.length;
    const pending = [first];
    const members: number[] = [];
    heapOf[first] = heap;
    for (let at = pending.pop(); at !== undefined; at = pending.pop()) {
      members.push(at);
      const { x0, y0, x1, y1 } = boxes[at];
      const joined = tree.search(x0, y0, x1, y1, (k) => heapOf[k] < 0);
      for (const k of joined) heapOf[k] = heap;
      pending.push(...joined);
    }
    found.push(members.sort((a, b) => a - b).map((k) => rings[k]));
  }
  return found;
}

/**
 * The part of each ring in a box (I. Sutherland, G. Hodgman, 1974). It encloses every point of the box as often as the
 * ring does, but may run along the border of the box back and forth.
 */
export function ringsInBox(rings: Paths64, { x0, y0, x1, y1 }: Box): Paths64 {
  return rings
    .map((ring) => cutBySide(ring, "x", 1, Math.round(x0 * SCALE)))
    .map((ring) => cutBySide(ring, "x", -1, Math.round(x1 * SCALE)))
    .map((ring) => cutBySide(ring, "y", 1, Math.round(y0 * SCALE)))
    .map((ring) => cutBySide(ring, "y", -1, Math.round(y1 * SCALE)))
    .filter((ring) => ring.length > 2);
}

/** The part of a ring on one side of a line: above `at` along the axis, or below for sign −1. */
function cutBySide(ring: Path64, axis: "x" | "y", sign: 1 | -1, at: number): Path64 {
  if (ring.every((p) => sign * (p[axis] - at) >= 0)) return ring;
  const kept: Path64 = [];
  for (let k = 0, j = ring.length - 1; k < ring.length; j = k++) {
    const [p, q] = [ring[j], ring[k]];
    const from = sign * (p[axis] - at);
    const to = sign * (q[axis] - at);
    if (from < 0 !== to < 0) {
      const t = from / (from - to);
      kept.push({ x: Math.round(p.x + t * (q.x - p.x)), y: Math.round(p.y + t * (q.y - p.y)) });
    }
    if (to >= 0) kept.push(q);
  }
  return kept;
}

/** A boolean operation on two sets of rings, both filled under `rule`. */
export function combine(
  op: ClipType,
  subject: Paths64,
  clip: Paths64,
  rule: FillRule = FillRule.NonZero,
): Paths64 {
  const isTurned = sweepsBetterTurned([...subject, ...clip]);
  const clipper = new Clipper64();
  clipper.preserveCollinear = false;
  clipper.addSubject(isTurned ? turned(subject) : subject);
  if (clip.length > 0) clipper.addClip(isTurned ? turned(clip) : clip);
  const closed: Paths64 = [];
  clipper.execute(op, rule, closed);
  return isTurned ? turned(turned(turned(closed))) : closed;
}

/**
 * Clipper sweeps along y, and each step costs as much as there are edges on the sweep line. Whether turned by 90° this is
 * so much less that turning pays.
 */
function sweepsBetterTurned(rings: Paths64): boolean {
  let [width, height] = [0, 0];
  for (const ring of rings) {
    for (let k = 0, j = ring.length - 1; k < ring.length; j = k++) {
      width += Math.abs(ring[k].x - ring[j].x);
      height += Math.abs(ring[k].y - ring[j].y);
    }
  }
  const { x0, y0, x1, y1 } = boxOfRings(rings);
  const edgesAcross = height / (y1 - y0);
  return edgesAcross > MANY_EDGES_ACROSS && width / (x1 - x0) < edgesAcross / 2;
}

/** Turned by 90°. */
const turned = (rings: Paths64): Paths64 => rings.map((ring) => ring.map(({ x, y }) => ({ x: -y, y: x })));

/** Adds a line from points in Clipper units. */
export function addPath(path: Path64, tag: number, builder: LineBuilder): void {
  for (const p of path) builder.point(p.x / SCALE, p.y / SCALE);
  builder.end(tag);
}

/** Whether a point is inside; on the border the result may be either. */
export const regionContains = (region: Region, x: number, y: number): boolean =>
  region.edges().windingAt(x, y) !== 0;
