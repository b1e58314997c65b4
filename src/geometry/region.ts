/**
 * Areas of the plane. Uses Clipper2 (A. Johnson; clipper2-ts).
 *
 * Clipper works on integers. One unit is 0.1 µm (SCALE): far below any pen width, and products of two
 * coordinates on any paper stay exact in a double. A region is always clean: its rings do not cross,
 * and their winding makes holes under the non-zero rule.
 */
import { Clipper64, ClipType, FillRule, type Path64, type Paths64 } from "clipper2-ts";
import type { Box } from "./box.js";
import { type LineBuilder, type Lines } from "./polyline.js";
import { RegionEdges } from "./region-edges.js";

/** Clipper units per mm. */
export const SCALE = 10_000;

/** `rings` in Clipper units; `box` in mm. */
export interface Region {
  readonly rings: Paths64;
  readonly box: Box;
  /** True if the region is exactly its box: then a line is clipped faster. */
  readonly isBox: boolean;
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

/** A region from rings that are already clean. */
export function regionOf(rings: Paths64): Region {
  let [x0, y0, x1, y1] = [Infinity, Infinity, -Infinity, -Infinity];
  for (const ring of rings) {
    for (const { x, y } of ring) {
      x0 = Math.min(x0, x);
      y0 = Math.min(y0, y);
      x1 = Math.max(x1, x);
      y1 = Math.max(y1, y);
    }
  }
  const box = { x0: x0 / SCALE, y0: y0 / SCALE, x1: x1 / SCALE, y1: y1 / SCALE };
  let edges: RegionEdges | null = null;
  return {
    rings,
    box,
    isBox: rings.length === 1 && isRectangle(rings[0]),
    edges: () => (edges ??= new RegionEdges(rings, SCALE)),
  };
}

function isRectangle(ring: Path64): boolean {
  if (ring.length !== 4) return false;
  return ring.every((p, k) => {
    const next = ring[(k + 1) % 4];
    const after = ring[(k + 2) % 4];
    return (p.x === next.x) !== (p.y === next.y) && (p.x === next.x) === (next.y === after.y);
  });
}

/** The area that `rings` enclose under `rule`. */
export const cleanRings = (rings: Paths64, rule: FillRule): Paths64 =>
  combine(ClipType.Union, rings, [], rule);

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
  const clipper = new Clipper64();
  clipper.preserveCollinear = false;
  clipper.addSubject(subject);
  if (clip.length > 0) clipper.addClip(clip);
  const closed: Paths64 = [];
  clipper.execute(op, rule, closed);
  return closed;
}

/** Adds a line from points in Clipper units. */
export function addPath(path: Path64, tag: number, builder: LineBuilder): void {
  for (const p of path) builder.point(p.x / SCALE, p.y / SCALE);
  builder.end(tag);
}

/** Whether a point is inside; on the border the result may be either. */
export const regionContains = (region: Region, x: number, y: number): boolean =>
  region.edges().windingAt(x, y) !== 0;
