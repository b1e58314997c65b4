/**
 * The parts of lines inside a box, or inside or outside a region. A line on the edge belongs to both sides. A closed line
 * that is cut starts where it is cut. Points cut at a box are never outside it, so that "inside the margins" can be checked
 * without a tolerance.
 */
import { boxContains, boxesTouch, grownBox, insideRange, type Box } from "./box.js";
import { LineBuilder, clamp, isClosedLine, lineBox, lineCount, mix, type Lines } from "./polyline.js";
import { regionContains, type Region } from "./region.js";
import { onEdgeFor, type SegmentPart } from "./region-edges.js";

/** The parts of lines inside a box, in order. */
export function clipLinesToBox(lines: Lines, box: Box): Lines {
  const builder = new LineBuilder();
  const { xy, offsets, tag } = lines;
  for (let i = 0; i < lineCount(lines); i++) {
    const bounds = lineBox(lines, i);
    if (boxContains(box, bounds)) builder.copy(lines, i, tag[i]);
    else if (boxesTouch(box, bounds)) {
      const kept: SegmentPart[] = [];
      for (let p = offsets[i]; p + 1 < offsets[i + 1]; p++) {
        const range = insideRange(xy[2 * p], xy[2 * p + 1], xy[2 * p + 2], xy[2 * p + 3], box);
        if (range !== null) addParts([range], p - offsets[i], kept);
      }
      addPieces(lines, i, kept, builder, box);
    }
  }
  return builder.finish();
}

/** The parts of straight lines inside a region. */
export function cutLines(lines: Lines, region: Region): Lines {
  const builder = new LineBuilder();
  for (let i = 0; i < lineCount(lines); i++) cutLine(lines, i, 0, region, false, builder);
  return builder.finish();
}

/**
 * Adds the parts of line `i` inside the region (or outside, with `keepOutside`) to `builder`, and those on its edge. `gap`:
 * max gap between the line and the curve it replaces, mm.
 */
export function cutLine(
  lines: Lines,
  i: number,
  gap: number,
  region: Region,
  keepOutside: boolean,
  builder: LineBuilder,
): void {
  const { xy, offsets } = lines;
  const tag = lines.tag[i];
  const bounds = lineBox(lines, i);
  const onEdge = onEdgeFor(gap, region.gap);
  if (region.rings.length === 0 || !boxesTouch(bounds, grownBox(region.box, onEdge))) {
    if (keepOutside) builder.copy(lines, i, tag);
    return;
  }
  if (region.isBox && boxContains(grownBox(region.box, -onEdge), bounds)) {
    if (!keepOutside) builder.copy(lines, i, tag);
    return;
  }
  if (offsets[i + 1] - offsets[i] < 2) {
    if (regionContains(region, xy[2 * offsets[i]], xy[2 * offsets[i] + 1]) !== keepOutside)
      builder.copy(lines, i, tag);
    return;
  }
  const edges = region.edges();
  const kept: SegmentPart[] = [];
  let winding: number | null = null;
  for (let p = offsets[i]; p + 1 < offsets[i + 1]; p++) {
    const cut = edges.partsOf(lines, i, p, keepOutside, onEdge, winding);
    winding = cut.windingAtEnd;
    addParts(cut.parts, p - offsets[i], kept);
  }
  addPieces(lines, i, kept, builder);
}

/** Adds parts of segment number `segment` to those of its line, which count its segments: 2.5 is the middle of the third. */
export function addParts(
  parts: readonly Readonly<SegmentPart>[],
  segment: number,
  toLine: SegmentPart[],
): void {
  for (const [from, to] of parts) {
    const last = toLine.at(-1);
    if (last !== undefined && from === 0 && last[1] === segment) last[1] = segment + to;
    else toLine.push([segment + from, segment + to]);
  }
}

const ANYWHERE: Box = { x0: -Infinity, y0: -Infinity, x1: Infinity, y1: Infinity };

/** Adds these parts of line `i`, inside `box`. Parts of a closed line that meet at its start are one piece. */
export function addPieces(
  lines: Lines,
  i: number,
  parts: readonly SegmentPart[],
  builder: LineBuilder,
  box = ANYWHERE,
): void {
  const segments = lines.offsets[i + 1] - lines.offsets[i] - 1;
  const pieces = [...parts];
  const [first, last] = [pieces[0], pieces[pieces.length - 1]];
  if (pieces.length > 1 && first[0] === 0 && last[1] === segments && isClosedLine(lines, i)) {
    pieces.shift();
    pieces[pieces.length - 1] = [last[0], segments + first[1]];
  }
  for (const [from, to] of pieces) addPiece(lines, i, from, to, builder, box);
}

function addPiece(
  { xy, offsets, tag }: Lines,
  i: number,
  from: number,
  to: number,
  builder: LineBuilder,
  { x0, y0, x1, y1 }: Box,
): void {
  const first = offsets[i];
  const segments = offsets[i + 1] - first - 1;
  const addPoint = (at: number): void => {
    const segment = Math.min(Math.floor(at), at === segments ? segments - 1 : Infinity);
    const p = first + (segment % segments);
    const t = at - segment;
    const x = mix(xy[2 * p], xy[2 * p + 2], t);
    const y = mix(xy[2 * p + 1], xy[2 * p + 3], t);
    builder.point(clamp(x, x0, x1), clamp(y, y0, y1));
  };
  addPoint(from);
  for (let at = Math.floor(from) + 1; at < to; at++) addPoint(at);
  addPoint(to);
  // A line that only touches the edge would become a dot, which is not in the drawing.
  if (builder.openPoints < 2) builder.drop();
  else builder.end(tag[i]);
}
