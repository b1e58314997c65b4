/**
 * Removes hidden lines: a filled shape covers everything painted before it. A shape's fill does not hide its own lines.
 *
 * The drawing is divided into quarters, each again, while that makes the work less (J. Warnock, "A Hidden Surface
 * Algorithm for Computer Generated Halftone Pictures", 1969). A shape that covers a whole tile hides everything below it
 * there, so that a pile of shapes costs no more than its visible part. In a tile that is not divided, the shapes are
 * joined from the top down, and each segment is cut by what was joined above it.
 */
import { FillRule, type Paths64 } from "clipper2-ts/dist/Core.js";
import { PlotwrightError } from "../../errors.js";
import { boxContains, boxOfPoints, boxesTouch, grownBox, insideRange, type Box } from "../../geometry/box.js";
import { addParts, addPieces } from "../../geometry/cut-line.js";
import { LineBuilder, SAME_POINT_MM, distance, lineCount, mix, type Lines } from "../../geometry/polyline.js";
import {
  SCALE,
  cleanRings,
  regionContains,
  regionOf,
  ringsInBox,
  type Region,
} from "../../geometry/region.js";
import { longRun, merged, onEdgeFor, type SegmentPart } from "../../geometry/region-edges.js";
import { stopIfCancelled, type Work } from "../work.js";

/** A tile with fewer pairs of an edge and a segment is not divided. */
const FEW_PAIRS = 50_000;
/** Dividing continues only if it leaves less than this share of the pairs. */
const WORTH_DIVIDING = 0.8;
/** Smaller tiles are not divided, mm. */
const SMALLEST_TILE = 0.1;
/** Larger unions cost more than they save. */
const MAX_UNION_POINTS = 400;
/** Cost of cutting a segment by a cover, in pairs that are only compared. */
const PAIRS_OF_CUT = 30;
/** About half a minute. */
const MAX_PAIRS = 1_000_000_000;

/** The area of one shape in a tile. */
interface Cover {
  readonly shape: number;
  readonly region: Region;
  readonly points: number;
}

const WHOLE: readonly SegmentPart[] = [[0, 1]];

interface Tile {
  readonly box: Box;
  /** The topmost first. */
  readonly covers: readonly Cover[];
  /** Segments by the number of their first point, the topmost first. */
  readonly segments: readonly number[];
}

/**
 * The tag of each line is its shape; `areas` by shape. A shape with a higher index is painted later. Shapes for which
 * `takesPart` is false (hidden layers) cover nothing, and nothing covers them. `gaps` are those of `gapsOfShapes`. Throws
 * `too-large` if more than `maxPairs` pairs of an edge and a segment must be compared.
 */
export function hideCovered(
  lines: Lines,
  areas: ReadonlyMap<number, Region>,
  takesPart: (shape: number) => boolean,
  gaps: Float64Array,
  work: Work,
  maxPairs = MAX_PAIRS,
): Lines {
  const covers = [...areas]
    .filter(([shape]) => takesPart(shape))
    .sort(([a], [b]) => b - a)
    .map(([shape, region]) => coverOf(shape, region));
  if (covers.length === 0) return lines;
  const hiding = new Hiding(lines, gaps, work, maxPairs);
  hiding.run(covers, takesPart);
  const builder = new LineBuilder();
  for (let i = 0; i < lineCount(lines); i++) hiding.addVisible(i, builder);
  return builder.finish();
}

class Hiding {
  /** The hidden parts of each segment that has any, by the number of its first point. */
  private readonly hidden: (SegmentPart[] | undefined)[];
  /** The line of each point. */
  private readonly lineOf: Uint32Array;
  private readonly maxGap: number;
  /** 1 for the point of a dot, which is a segment to itself. */
  private readonly isDot: Uint8Array;
  private pairs = 0;

  constructor(
    private readonly lines: Lines,
    private readonly gaps: Float64Array,
    private readonly work: Work,
    private readonly maxPairs: number,
  ) {
    this.maxGap = gaps.reduce((max, gap) => Math.max(max, gap), 0);
    this.lineOf = new Uint32Array(lines.xy.length / 2);
    this.hidden = Array.from({ length: lines.xy.length / 2 });
    this.isDot = new Uint8Array(lines.xy.length / 2);
  }

  run(covers: readonly Cover[], takesPart: (shape: number) => boolean): void {
    const { tag, offsets, xy } = this.lines;
    const segments: number[] = [];
    for (let i = 0; i < lineCount(this.lines); i++) {
      const [first, end] = [offsets[i], offsets[i + 1]];
      this.lineOf.fill(i, first, end);
      if (end - first === 1) this.isDot[first] = 1;
      if (!takesPart(tag[i])) continue;
      for (let p = first; p < Math.max(end - 1, first + 1); p++) segments.push(p);
    }
    segments.sort((p, q) => this.shapeOf(q) - this.shapeOf(p));
    this.hideIn({ box: boxOfPoints(xy), covers, segments });
  }

  /** Adds the visible pieces of line `i`. */
  addVisible(i: number, builder: LineBuilder): void {
    const { lines, hidden, isDot } = this;
    const first = lines.offsets[i];
    const end = lines.offsets[i + 1];
    let isWhole = true;
    for (let p = first; p < end && isWhole; p++) isWhole = hidden[p] === undefined;
    if (isWhole) return builder.copy(lines, i, lines.tag[i]);
    if (isDot[first] === 1) return;
    const visible: SegmentPart[] = [];
    for (let p = first; p < end - 1; p++) addParts(this.visibleOf(p), p - first, visible);
    addPieces(lines, i, visible, builder);
  }

  private visibleOf(p: number): readonly SegmentPart[] {
    const parts = this.hidden[p];
    if (parts === undefined) return WHOLE;
    const rounding = SAME_POINT_MM / distance(...this.endsOf(p));
    return merged(outsideOf(merged(parts, rounding)), rounding);
  }

  private hideIn(tile: Tile): void {
    stopIfCancelled(this.work);
    const { box } = tile;
    const pairs = pairsIn(tile);
    if (pairs === 0) return;
    if (pairs <= FEW_PAIRS || Math.max(box.x1 - box.x0, box.y1 - box.y0) < SMALLEST_TILE) {
      this.cutIn(tile);
      return;
    }
    const quarters = quartersOf(box).map((quarter) => this.tileIn(tile, quarter));
    const left = quarters.reduce((sum, quarter) => sum + pairsIn(quarter), 0);
    if (left > WORTH_DIVIDING * pairs) this.cutIn(tile);
    else for (const quarter of quarters) this.hideIn(quarter);
  }

  /** The part of a tile in a smaller box. What lies below a cover of the whole box is hidden at once. */
  private tileIn(tile: Tile, box: Box): Tile {
    this.spend(tile.segments.length);
    let segments = tile.segments.filter((p) => this.touches(p, box));
    const covers: Cover[] = [];
    for (const cover of tile.covers) {
      if (segments.length === 0 || this.shapeOf(segments[segments.length - 1]) >= cover.shape) break;
      this.spend(cover.points);
      const inside = coverIn(cover, box, this.maxGap);
      if (inside === "whole") {
        const above = segments.filter((p) => this.shapeOf(p) >= cover.shape);
        for (const p of segments.slice(above.length)) this.hide(p, this.rangeIn(p, box));
        segments = above;
        break;
      }
      if (inside !== null) covers.push(inside);
    }
    const top = covers[0]?.shape ?? 0;
    return { box, covers, segments: segments.filter((p) => this.shapeOf(p) < top) };
  }

  private cutIn({ box, covers, segments }: Tile): void {
    const joined: Cover[] = [];
    let next = 0;
    for (const p of segments) {
      for (; next < covers.length && covers[next].shape > this.shapeOf(p); next++) join(joined, covers[next]);
      this.cut(p, this.rangeIn(p, box), joined);
    }
    this.spend(segments.length + covers.length);
  }

  private cut(p: number, range: SegmentPart, covers: readonly Cover[]): void {
    const [x0, y0, x1, y1] = this.endsOf(p);
    let [enter, leave] = range;
    for (const { region } of covers) {
      const part = boxOfPoints([
        mix(x0, x1, enter),
        mix(y0, y1, enter),
        mix(x0, x1, leave),
        mix(y0, y1, leave),
      ]);
      if (!boxesTouch(part, region.box)) continue;
      if (x0 === x1 && y0 === y1) {
        if (regionContains(region, x0, y0)) return this.hide(p, range);
        continue;
      }
      this.spend(PAIRS_OF_CUT);
      const onEdge = onEdgeFor(this.gaps[this.shapeOf(p)], region.gap);
      const { parts } = region.edges().partsOf(this.lines, this.lineOf[p], p, true, onEdge, null);
      for (const [from, to] of outsideOf(parts)) {
        this.hide(p, [Math.max(from, enter), Math.min(to, leave)]);
        if (from <= enter) enter = Math.max(enter, to);
        if (to >= leave) leave = Math.min(leave, from);
        if (enter >= leave) return;
      }
    }
    this.spend(covers.length);
  }

  private shapeOf(p: number): number {
    return this.lines.tag[this.lineOf[p]];
  }

  private hide(p: number, part: SegmentPart): void {
    (this.hidden[p] ??= []).push(part);
  }

  private touches(p: number, box: Box): boolean {
    const { xy } = this.lines;
    const q = this.isDot[p] === 1 ? p : p + 1;
    return segmentTouches(xy[2 * p], xy[2 * p + 1], xy[2 * q], xy[2 * q + 1], box);
  }

  private endsOf(p: number): [x0: number, y0: number, x1: number, y1: number] {
    const { xy } = this.lines;
    const q = this.isDot[p] === 1 ? p : p + 1;
    return [xy[2 * p], xy[2 * p + 1], xy[2 * q], xy[2 * q + 1]];
  }

  /** The part of a segment in a box; an empty one if it misses the box. */
  private rangeIn(p: number, box: Box): SegmentPart {
    return insideRange(...this.endsOf(p), box) ?? [0, 0];
  }

  private spend(pairs: number): void {
    this.pairs += pairs;
    if (this.pairs <= this.maxPairs) return;
    throw new PlotwrightError(
      "too-large",
      "Hiding covered lines takes too long here: too many filled shapes cross too many lines. Draw hidden lines too, or plot the drawing in parts.",
    );
  }
}

/** Whether a segment has a point in common with a box. Called for every segment in every tile, so it makes no objects. */
function segmentTouches(x0: number, y0: number, x1: number, y1: number, box: Box): boolean {
  if (x0 < box.x0 && x1 < box.x0) return false;
  if (x0 > box.x1 && x1 > box.x1) return false;
  if (y0 < box.y0 && y1 < box.y0) return false;
  if (y0 > box.y1 && y1 > box.y1) return false;
  // The corner furthest to the left of the segment's line, and the one furthest to the right.
  const [dx, dy] = [x1 - x0, y1 - y0];
  const left = dx * ((dx > 0 ? box.y1 : box.y0) - y0) - dy * ((dy > 0 ? box.x0 : box.x1) - x0);
  const right = dx * ((dx > 0 ? box.y0 : box.y1) - y0) - dy * ((dy > 0 ? box.x1 : box.x0) - x0);
  return left >= 0 && right <= 0;
}

/**
 * The part of a cover in a box: "whole" if it covers the box, null if it misses it. It is cut so far outside the box that
 * the cut is no edge of the lines inside.
 */
function coverIn(cover: Cover, box: Box, gapOfLines: number): Cover | "whole" | null {
  const { shape, region } = cover;
  if (!boxesTouch(region.box, box)) return null;
  const onEdge = onEdgeFor(gapOfLines, region.gap);
  const around = grownBox(box, 2 * longRun(onEdge));
  if (boxContains(around, region.box)) return cover;
  const near = grownBox(box, onEdge);
  const rings = ringsInBox(region.rings, around);
  const hasEdge = rings.some((ring) =>
    ring.some((p, k) => {
      const q = ring[(k + 1) % ring.length];
      return segmentTouches(p.x / SCALE, p.y / SCALE, q.x / SCALE, q.y / SCALE, near);
    }),
  );
  const inside = regionOf(rings, region.gap);
  if (hasEdge) return coverOf(shape, inside);
  return regionContains(inside, (box.x0 + box.x1) / 2, (box.y0 + box.y1) / 2) ? "whole" : null;
}

/** Adds a cover below the others, joined with the last of them if that makes their edges fewer. */
function join(covers: Cover[], cover: Cover): void {
  const last = covers.at(-1);
  if (
    last !== undefined &&
    last.points <= MAX_UNION_POINTS &&
    boxesTouch(last.region.box, cover.region.box)
  ) {
    const rings = cleanRings([...last.region.rings, ...cover.region.rings], FillRule.NonZero);
    if (pointsOf(rings) <= last.points + cover.points) {
      const gap = Math.max(last.region.gap, cover.region.gap);
      covers[covers.length - 1] = coverOf(cover.shape, regionOf(rings, gap));
      return;
    }
  }
  covers.push(cover);
}

const coverOf = (shape: number, region: Region): Cover => ({ shape, region, points: pointsOf(region.rings) });

const pointsOf = (rings: Paths64): number => rings.reduce((sum, ring) => sum + ring.length, 0);

const pairsIn = ({ covers, segments }: Tile): number =>
  segments.length * covers.reduce((sum, { points }) => sum + points, 0);

function quartersOf({ x0, y0, x1, y1 }: Box): Box[] {
  const x = (x0 + x1) / 2;
  const y = (y0 + y1) / 2;
  return [
    { x0, y0, x1: x, y1: y },
    { x0: x, y0, x1, y1: y },
    { x0, y0: y, x1: x, y1 },
    { x0: x, y0: y, x1, y1 },
  ];
}

/** What these parts, which ascend, leave of 0 to 1. */
function outsideOf(parts: readonly SegmentPart[]): SegmentPart[] {
  const outside: SegmentPart[] = [];
  let at = 0;
  for (const [from, to] of parts) {
    if (from > at) outside.push([at, from]);
    at = to;
  }
  if (at < 1) outside.push([at, 1]);
  return outside;
}
