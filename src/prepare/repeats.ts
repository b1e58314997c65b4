/**
 * Drops repeated lines: every part of a segment that is within a tolerance of an earlier, parallel one. So shared
 * borders and doubled shapes are drawn once. Only what is drawn counts as earlier: otherwise each of many close lines
 * would be dropped because of the one before, and their whole area would stay empty.
 *
 *      earlier  ────────────────────
 *      this         ═══════════════════════     within tolerance from t0 to t1: dropped there,
 *                   t0            t1            the rest stays
 *
 * Pieces (segments and dots) are indexed in a tree of boxes (Flatbush). Only pieces of the same tag are compared.
 */
import Flatbush from "flatbush";
import { LineBuilder, distance, lineCount, type Lines } from "../geometry/polyline.js";
import { stopIfCancelled, type Work } from "./work.js";

/** `tolerance` in mm; 0 keeps everything. A dot is dropped if an earlier dot is within the tolerance. */
export function dropRepeats(lines: Lines, tolerance: number, work: Work): Lines {
  if (!(tolerance > 0) || lineCount(lines) === 0) return lines;
  const pieces = piecesOf(lines);
  const builder = new LineBuilder();
  let piece = 0;
  for (let i = 0; i < lineCount(lines); i++) {
    if ((i & 255) === 0) stopIfCancelled(work);
    const first = lines.offsets[i];
    const last = lines.offsets[i + 1] - 1;
    if (first === last) {
      const isRepeated = isDotRepeated(lines, pieces, piece, tolerance);
      if (!isRepeated) builder.copy(lines, i, lines.tag[i]);
      pieces.drawn[piece++] = isRepeated ? [] : WHOLE;
      continue;
    }
    for (let p = first; p < last; p++, piece++) {
      pieces.drawn[piece] = addNewParts(lines, pieces, piece, tolerance, builder);
    }
    builder.end(lines.tag[i]);
  }
  return builder.finish();
}

/** A part of a piece, from and to a share of its length, 0 … 1. */
type Range = readonly [number, number];

const WHOLE: readonly Range[] = [[0, 1]];

interface Pieces {
  readonly tree: Flatbush;
  /** First point and line of each piece; a dot is a piece from a point to itself. */
  readonly point: Uint32Array;
  readonly line: Uint32Array;
  /** The drawn parts of each piece so far. */
  readonly drawn: (readonly Range[])[];
}

function piecesOf(lines: Lines): Pieces {
  const count = lineCount(lines);
  let total = 0;
  for (let i = 0; i < count; i++) total += Math.max(lines.offsets[i + 1] - lines.offsets[i] - 1, 1);
  const point = new Uint32Array(total);
  const line = new Uint32Array(total);
  const tree = new Flatbush(total);
  let piece = 0;
  for (let i = 0; i < count; i++) {
    const first = lines.offsets[i];
    const last = lines.offsets[i + 1] - 1;
    for (let p = first; p < Math.max(last, first + 1); p++) {
      const q = Math.min(p + 1, last);
      const [x0, y0, x1, y1] = [lines.xy[2 * p], lines.xy[2 * p + 1], lines.xy[2 * q], lines.xy[2 * q + 1]];
      tree.add(Math.min(x0, x1), Math.min(y0, y1), Math.max(x0, x1), Math.max(y0, y1));
      point[piece] = p;
      line[piece++] = i;
    }
  }
  tree.finish();
  return { tree, point, line, drawn: [] };
}

const isDot = (lines: Lines, i: number): boolean => lines.offsets[i + 1] - lines.offsets[i] === 1;

const isDrawnBefore = ({ drawn }: Pieces, k: number, piece: number): boolean =>
  k < piece && drawn[k].length > 0;

function isDotRepeated(lines: Lines, pieces: Pieces, piece: number, tolerance: number): boolean {
  const { xy } = lines;
  const p = pieces.point[piece];
  const tag = lines.tag[pieces.line[piece]];
  const near = pieces.tree.search(
    xy[2 * p] - tolerance,
    xy[2 * p + 1] - tolerance,
    xy[2 * p] + tolerance,
    xy[2 * p + 1] + tolerance,
    (k) =>
      isDrawnBefore(pieces, k, piece) && isDot(lines, pieces.line[k]) && lines.tag[pieces.line[k]] === tag,
  );
  return near.some((k) => {
    const q = pieces.point[k];
    return distance(xy[2 * p], xy[2 * p + 1], xy[2 * q], xy[2 * q + 1]) <= tolerance;
  });
}

/** Adds the new parts of the piece to the line under construction, ending the line before each gap. Returns the parts. */
function addNewParts(
  lines: Lines,
  pieces: Pieces,
  piece: number,
  tolerance: number,
  builder: LineBuilder,
): readonly Range[] {
  const { xy } = lines;
  const p = pieces.point[piece];
  const tag = lines.tag[pieces.line[piece]];
  const [x0, y0, x1, y1] = [xy[2 * p], xy[2 * p + 1], xy[2 * p + 2], xy[2 * p + 3]];
  const covered = coveredRanges(lines, pieces, piece, tolerance);
  if (covered.length === 0) {
    addPart(builder, x0, y0, x1, y1);
    return WHOLE;
  }
  const drawn: Range[] = [];
  const length = distance(x0, y0, x1, y1);
  const x = (t: number): number => (t === 1 ? x1 : x0 + t * (x1 - x0));
  const y = (t: number): number => (t === 1 ? y1 : y0 + t * (y1 - y0));
  const addNew = (from: number, to: number): void => {
    // A remainder shorter than the tolerance is dropped too, to save a pen lift.
    if ((to - from) * length <= tolerance) return;
    addPart(builder, x(from), y(from), x(to), y(to));
    drawn.push([from, to]);
  };
  let at = 0;
  for (const [from, to] of covered) {
    addNew(at, from);
    if (builder.openPoints > 1) builder.end(tag);
    else builder.drop();
    at = Math.max(at, to);
  }
  addNew(at, 1);
  return drawn;
}

function addPart(builder: LineBuilder, x0: number, y0: number, x1: number, y1: number): void {
  if (builder.openPoints === 0) builder.point(x0, y0);
  builder.point(x1, y1);
}

/** Sorted, merged ranges of t where the piece runs along drawn parts of earlier ones. */
function coveredRanges(lines: Lines, pieces: Pieces, piece: number, tolerance: number): [number, number][] {
  const { xy } = lines;
  const p = pieces.point[piece];
  const tag = lines.tag[pieces.line[piece]];
  const [x0, y0, x1, y1] = [xy[2 * p], xy[2 * p + 1], xy[2 * p + 2], xy[2 * p + 3]];
  const near = pieces.tree.search(
    Math.min(x0, x1) - tolerance,
    Math.min(y0, y1) - tolerance,
    Math.max(x0, x1) + tolerance,
    Math.max(y0, y1) + tolerance,
    (k) =>
      isDrawnBefore(pieces, k, piece) && lines.tag[pieces.line[k]] === tag && !isDot(lines, pieces.line[k]),
  );
  const ranges: [number, number][] = [];
  for (const k of near) {
    for (const part of pieces.drawn[k]) {
      const range = sharedRange(xy, p, pieces.point[k], part, tolerance);
      if (range !== null) ranges.push(range);
    }
  }
  ranges.sort((a, b) => a[0] - b[0]);
  const merged: [number, number][] = [];
  for (const range of ranges) {
    const last = merged[merged.length - 1];
    if (last !== undefined && range[0] <= last[1]) last[1] = Math.max(last[1], range[1]);
    else merged.push(range);
  }
  return merged;
}

/** The range of t on segment p where the part of segment q is within the tolerance; null if there is none. */
function sharedRange(
  xy: Float64Array,
  p: number,
  q: number,
  part: Range,
  tolerance: number,
): [number, number] | null {
  const x0 = xy[2 * p];
  const y0 = xy[2 * p + 1];
  const dx = xy[2 * p + 2] - x0;
  const dy = xy[2 * p + 3] - y0;
  const length2 = dx * dx + dy * dy;
  if (length2 === 0) return null;
  const along = (k: number): number => ((xy[2 * k] - x0) * dx + (xy[2 * k + 1] - y0) * dy) / length2;
  const across = (k: number): number =>
    ((xy[2 * k + 1] - y0) * dx - (xy[2 * k] - x0) * dy) / Math.sqrt(length2);
  const ta = along(q);
  const tb = along(q + 1);
  const start = ta + part[0] * (tb - ta);
  const end = ta + part[1] * (tb - ta);
  const from = Math.max(Math.min(start, end), 0);
  const to = Math.min(Math.max(start, end), 1);
  if ((to - from) * Math.sqrt(length2) <= tolerance * 1e-3) return null;
  // The distance of two straight lines is linear in t, so checking both ends of the range is enough.
  const slope = (across(q + 1) - across(q)) / (tb - ta);
  const gapAt = (t: number): number => Math.abs(across(q) + slope * (t - ta));
  return gapAt(from) <= tolerance && gapAt(to) <= tolerance ? [from, to] : null;
}
