/**
 * Drops repeated lines: every part of a segment that is within a tolerance of an earlier, parallel one. So shared
 * borders and doubled shapes are drawn once. Only what is drawn counts as earlier: otherwise each of many close lines
 * would be dropped because of the one before, and their whole area would stay empty.
 *
 *      earlier  ────────────────────
 *      this         ═══════════════════════     within tolerance from t0 to t1: dropped there,
 *                   t0            t1            the rest stays
 *
 * Pieces (segments and dots) are indexed in a tree of boxes (Flatbush). Only pieces of the same part of a layer are compared.
 */
import Flatbush from "flatbush";
import { LineBuilder, distance, lineCount, mix, type Lines } from "../../geometry/polyline.js";
import { merged, type SegmentPart } from "../../geometry/region-edges.js";
import { stopIfCancelled, type Work } from "../work.js";

/**
 * `tolerance` in mm; 0 keeps everything. A dot is dropped if an earlier dot is within the tolerance. `partOf` is the part of
 * a layer that a tag belongs to.
 */
export const dropRepeats = (
  lines: Lines,
  tolerance: number,
  partOf: (tag: number) => number,
  work: Work,
): Lines =>
  tolerance > 0 && lineCount(lines) > 0 ? new Repeats(lines, tolerance, partOf).dropped(work) : lines;

const WHOLE: readonly SegmentPart[] = [[0, 1]];

class Repeats {
  private readonly builder = new LineBuilder();
  private readonly tree: Flatbush;
  /** First point and line of each piece; a dot is a piece from a point to itself. */
  private readonly point: number[] = [];
  private readonly line: number[] = [];
  /** The drawn parts of each piece so far. */
  private readonly drawn: (readonly SegmentPart[])[] = [];

  constructor(
    private readonly lines: Lines,
    private readonly tolerance: number,
    private readonly partOf: (tag: number) => number,
  ) {
    const { offsets } = lines;
    for (let i = 0; i < lineCount(lines); i++) {
      for (let p = offsets[i]; p < Math.max(offsets[i + 1] - 1, offsets[i] + 1); p++) {
        this.point.push(p);
        this.line.push(i);
      }
    }
    this.tree = new Flatbush(this.point.length);
    for (let piece = 0; piece < this.point.length; piece++) this.tree.add(...this.boxOf(piece, 0));
    this.tree.finish();
  }

  dropped(work: Work): Lines {
    const { lines, builder } = this;
    let piece = 0;
    for (let i = 0; i < lineCount(lines); i++) {
      if ((i & 255) === 0) stopIfCancelled(work);
      if (this.isDot(piece)) {
        const isRepeated = this.isDotRepeated(piece);
        if (!isRepeated) builder.copy(lines, i, lines.tag[i]);
        this.drawn[piece++] = isRepeated ? [] : WHOLE;
        continue;
      }
      for (; this.line[piece] === i; piece++) this.drawn[piece] = this.addNewParts(piece);
      builder.end(lines.tag[i]);
    }
    return builder.finish();
  }

  private isDot(piece: number): boolean {
    const { offsets } = this.lines;
    const i = this.line[piece];
    return offsets[i + 1] - offsets[i] === 1;
  }

  /** The ends of a piece: x0, y0, x1, y1. */
  private endsOf(piece: number): [number, number, number, number] {
    const { xy } = this.lines;
    const p = this.point[piece];
    const q = this.isDot(piece) ? p : p + 1;
    return [xy[2 * p], xy[2 * p + 1], xy[2 * q], xy[2 * q + 1]];
  }

  /** The box of a piece, widened by a margin. */
  private boxOf(piece: number, margin: number): [number, number, number, number] {
    const [x0, y0, x1, y1] = this.endsOf(piece);
    return [
      Math.min(x0, x1) - margin,
      Math.min(y0, y1) - margin,
      Math.max(x0, x1) + margin,
      Math.max(y0, y1) + margin,
    ];
  }

  /** Earlier pieces of the same kind and part that are near, and drawn at least in part. */
  private drawnNear(piece: number): number[] {
    const { line, drawn, partOf } = this;
    const { tag } = this.lines;
    const part = partOf(tag[line[piece]]);
    const isDot = this.isDot(piece);
    return this.tree.search(
      ...this.boxOf(piece, this.tolerance),
      (k) => k < piece && drawn[k].length > 0 && this.isDot(k) === isDot && partOf(tag[line[k]]) === part,
    );
  }

  private isDotRepeated(piece: number): boolean {
    const [x, y] = this.endsOf(piece);
    return this.drawnNear(piece).some((k) => {
      const [otherX, otherY] = this.endsOf(k);
      return distance(x, y, otherX, otherY) <= this.tolerance;
    });
  }

  /** Adds the new parts of the piece to the line under construction, ending the line before each gap. Returns the parts. */
  private addNewParts(piece: number): readonly SegmentPart[] {
    const { builder, tolerance } = this;
    const [x0, y0, x1, y1] = this.endsOf(piece);
    const covered = this.coveredRanges(piece);
    const drawn: SegmentPart[] = [];
    const length = distance(x0, y0, x1, y1);
    const addNew = (from: number, to: number): void => {
      // A remainder shorter than the tolerance is dropped too, to save a pen lift.
      if (covered.length > 0 && (to - from) * length <= tolerance) return;
      if (builder.openPoints === 0) builder.point(mix(x0, x1, from), mix(y0, y1, from));
      builder.point(mix(x0, x1, to), mix(y0, y1, to));
      drawn.push([from, to]);
    };
    let at = 0;
    for (const [from, to] of covered) {
      addNew(at, from);
      if (builder.openPoints > 1) builder.end(this.lines.tag[this.line[piece]]);
      else builder.drop();
      at = Math.max(at, to);
    }
    addNew(at, 1);
    return drawn;
  }

  /** Ranges of t where the piece runs along drawn parts of earlier ones, ascending and apart. */
  private coveredRanges(piece: number): SegmentPart[] {
    const ranges: SegmentPart[] = [];
    for (const k of this.drawnNear(piece)) {
      for (const part of this.drawn[k]) {
        const range = sharedRange(this.lines.xy, this.point[piece], this.point[k], part, this.tolerance);
        if (range !== null) ranges.push(range);
      }
    }
    return merged(ranges, 0);
  }
}

/** The range of t on segment p where the part of segment q is within the tolerance; null if there is none. */
function sharedRange(
  xy: Float64Array,
  p: number,
  q: number,
  part: SegmentPart,
  tolerance: number,
): SegmentPart | null {
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
