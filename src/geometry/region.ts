/**
 * Areas of the plane. Uses Clipper2 (A. Johnson; clipper2-ts).
 *
 * Clipper works on integers. One unit is 0.1 µm (SCALE): far below any pen width, and products of two
 * coordinates on any paper stay exact in a double. A region is always clean: its rings do not cross,
 * and their winding makes holes under the non-zero rule.
 */
import { Clipper64, ClipType, FillRule, type Path64, type Paths64 } from "clipper2-ts";
import { boxOfPoints, type Box } from "./box.js";
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
  const box = boxOfPoints(rings.flatMap((ring) => ring.flatMap((p) => [p.x / SCALE, p.y / SCALE])));
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
