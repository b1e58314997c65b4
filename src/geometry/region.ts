/**
 * Areas of the plane, and the parts of lines inside them. Uses Clipper2 (A. Johnson; clipper2-ts).
 *
 * Clipper works on integers. One unit is 0.1 µm (SCALE): far below any pen width, and products of two
 * coordinates on any paper stay exact in a double. A region is always clean: its rings do not cross,
 * and their winding makes holes under the non-zero rule.
 */
import { Clipper64, ClipType, FillRule, type Path64, type Paths64 } from "clipper2-ts";
import { boxOfPoints, boxesTouch, boxContains, type Box } from "./box.js";
import { clipLine } from "./clip.js";
import { LineBuilder, lineBox, lineCount, type Lines } from "./polyline.js";

/** Clipper units per mm. */
export const SCALE = 10_000;

/** `rings` in Clipper units; `box` in mm. */
export interface Region {
  readonly rings: Paths64;
  readonly box: Box;
  /** True if the region is exactly its box: then clipping does not need Clipper. */
  readonly isBox: boolean;
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
  return { rings, box, isBox: rings.length === 1 && isRectangle(rings[0]) };
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

/** Adds the parts of line `i` inside the region (or outside, with `keepOutside`) to `builder`. */
export function cutLine(
  lines: Lines,
  i: number,
  region: Region,
  keepOutside: boolean,
  builder: LineBuilder,
): void {
  const { xy, offsets } = lines;
  const tag = lines.tag[i];
  const bounds = lineBox(lines, i);
  if (region.rings.length === 0 || !boxesTouch(bounds, region.box)) {
    if (keepOutside) builder.copy(lines, i, tag);
    return;
  }
  if (region.isBox && !keepOutside) return clipLine(lines, i, region.box, builder);
  if (region.isBox && boxContains(region.box, bounds)) return;
  if (offsets[i + 1] - offsets[i] < 2) {
    if (regionContains(region, xy[2 * offsets[i]], xy[2 * offsets[i] + 1]) !== keepOutside)
      builder.copy(lines, i, tag);
    return;
  }
  const clipper = new Clipper64();
  clipper.addOpenSubject(withoutReversals(ringOfLine(lines, i)));
  clipper.addClip(region.rings);
  const open: Paths64 = [];
  clipper.execute(keepOutside ? ClipType.Difference : ClipType.Intersection, FillRule.NonZero, [], open);
  // Pieces split only at the line's own start, or where it goes back, are joined again.
  for (const piece of stitched(open)) addPath(piece, tag, builder);
}

/** Adds a line from points in Clipper units. */
export function addPath(path: Path64, tag: number, builder: LineBuilder): void {
  for (const p of path) builder.point(p.x / SCALE, p.y / SCALE);
  builder.end(tag);
}

/**
 * The line, split where it goes back along a horizontal: Clipper2 cuts such a line wrongly, and sometimes never ends.
 * Clipper2 treats horizontals apart, so that other lines may go back over themselves.
 */
function withoutReversals(line: Path64): Paths64 {
  // Points that differ may be equal in Clipper units, and would hide a reversal.
  const points = line.filter((p, k) => k === 0 || p.x !== line[k - 1].x || p.y !== line[k - 1].y);
  const parts: Paths64 = [];
  let first = 0;
  for (let k = 1; k + 1 < points.length; k++) {
    const [a, b, c] = [points[k - 1], points[k], points[k + 1]];
    if (a.y !== b.y || b.y !== c.y || a.x < b.x === b.x < c.x) continue;
    parts.push(points.slice(first, k + 1));
    first = k;
  }
  parts.push(points.slice(first));
  return parts;
}

function stitched(pieces: Paths64): Paths64 {
  const key = (p: { x: number; y: number }): string => `${p.x},${p.y}`;
  if (pieces.length < 2) return pieces;
  const byEnd = new Map<string, Path64>();
  const out = new Set<Path64>();
  for (const given of pieces) {
    let piece = given;
    for (const atStart of [true, false]) {
      const at = key(atStart ? piece[0] : piece[piece.length - 1]);
      const other = byEnd.get(at);
      if (other === undefined || other === piece) continue;
      byEnd.delete(key(other[0]));
      byEnd.delete(key(other[other.length - 1]));
      out.delete(other);
      const head = key(other[other.length - 1]) === at ? other : other.slice().reverse();
      const tail = atStart ? piece : piece.slice().reverse();
      piece = [...head, ...tail.slice(1)];
    }
    out.add(piece);
    byEnd.set(key(piece[0]), piece);
    byEnd.set(key(piece[piece.length - 1]), piece);
  }
  return [...out];
}

/** True if the winding number over all rings is not 0. For a point on the border the result may be true or false. */
export function regionContains(region: Region, x: number, y: number): boolean {
  const px = x * SCALE;
  const py = y * SCALE;
  let winding = 0;
  for (const ring of region.rings) {
    for (let k = 0, j = ring.length - 1; k < ring.length; j = k++) {
      const a = ring[j];
      const b = ring[k];
      if (a.y <= py === b.y <= py) continue;
      const left = (b.x - a.x) * (py - a.y) - (px - a.x) * (b.y - a.y);
      if (b.y > a.y && left > 0) winding++;
      else if (b.y < a.y && left < 0) winding--;
    }
  }
  return winding !== 0;
}

/** Clips every line to the region of its tag; null leaves the line unchanged. */
export function cutLines(lines: Lines, regionOfTag: (tag: number) => Region | null): Lines {
  const builder = new LineBuilder();
  for (let i = 0; i < lineCount(lines); i++) {
    const region = regionOfTag(lines.tag[i]);
    if (region === null) builder.copy(lines, i, lines.tag[i]);
    else cutLine(lines, i, region, false, builder);
  }
  return builder.finish();
}
