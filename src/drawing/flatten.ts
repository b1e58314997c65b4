/** Verbs to polylines: curves become chords within a tolerance in mm, after mapping to the paper. Clips to rings. */
import { FillRule, type Paths64 } from "clipper2-ts/dist/Core.js";
import { applyX, applyY, type Affine } from "../geometry/affine.js";
import { flattenCubic } from "../geometry/cubic.js";
import { PointBuffer } from "../geometry/growable.js";
import { LineBuilder, lineCount } from "../geometry/polyline.js";
import { cleanRings, ringOfLine } from "../geometry/region.js";
import {
  RULE_EVENODD,
  VERB_CLOSE,
  VERB_CUBIC,
  VERB_MOVE,
  type ClipRegion,
  type Curves,
  PAIRS_OF_VERB,
} from "./drawing.js";
import { getOrAdd } from "../get-or-add.js";

const chords = new PointBuffer(1024);

/**
 * Adds a line for each subpath; `tagOf` gets the number of the subpath, counted by VERB_MOVE. With `asArea`, subpaths
 * are closed, and those without an area are dropped.
 */
export function flattenVerbs(
  { verbs, coords }: Curves,
  map: Affine,
  toleranceMm: number,
  asArea: boolean,
  builder: LineBuilder,
  tagOf: (subpath: number) => number,
): void {
  let at = 0;
  let subpath = -1;
  let startX = 0;
  let startY = 0;
  let x = 0;
  let y = 0;
  for (const verb of verbs) {
    if (verb === VERB_CLOSE) {
      if (builder.openPoints === 0) builder.point(x, y);
      x = startX;
      y = startY;
      builder.point(x, y);
      endSubpath(builder, asArea, tagOf(subpath));
      continue;
    }
    const end = verb === VERB_CUBIC ? at + 4 : at;
    const endX = applyX(map, coords[end], coords[end + 1]);
    const endY = applyY(map, coords[end], coords[end + 1]);
    if (verb === VERB_MOVE) {
      endSubpath(builder, asArea, tagOf(subpath));
      subpath++;
      startX = endX;
      startY = endY;
    } else {
      if (builder.openPoints === 0) builder.point(x, y);
      if (verb === VERB_CUBIC) {
        const x1 = applyX(map, coords[at], coords[at + 1]);
        const y1 = applyY(map, coords[at], coords[at + 1]);
        const x2 = applyX(map, coords[at + 2], coords[at + 3]);
        const y2 = applyY(map, coords[at + 2], coords[at + 3]);
        chords.clear();
        flattenCubic(chords, x, y, x1, y1, x2, y2, endX, endY, toleranceMm);
        for (let k = 0; k < chords.length - 2; k += 2) builder.point(chords.data[k], chords.data[k + 1]);
      }
      builder.point(endX, endY);
    }
    x = endX;
    y = endY;
    at = end + 2;
  }
  endSubpath(builder, asArea, tagOf(subpath));
}

function endSubpath(builder: LineBuilder, asArea: boolean, tag: number): void {
  if (asArea) builder.endArea(tag);
  else builder.end(tag);
}

/** The union of the clip's shapes, each filled by its own rule. */
export function ringsOfClip(clip: Omit<ClipRegion, "parent">, map: Affine, toleranceMm: number): Paths64 {
  const builder = new LineBuilder();
  flattenVerbs(clip, map, toleranceMm, true, builder, (subpath) => subpath);
  const lines = builder.finish();
  const shapes = new Map<string, { rings: Paths64; rule: FillRule }>();
  for (let i = 0; i < lineCount(lines); i++) {
    const subpath = lines.tag[i];
    const rule = clip.rule[subpath] === RULE_EVENODD ? FillRule.EvenOdd : FillRule.NonZero;
    const key = `${rule} ${clip.shape?.[subpath] ?? ""}`;
    getOrAdd(shapes, key, () => ({ rings: [], rule })).rings.push(ringOfLine(lines, i));
  }
  const filled = [...shapes.values()].map(({ rings, rule }) => cleanRings(rings, rule));
  // Clean rings wind in the same direction, so overlapping shapes do not cancel.
  return filled.length === 1 ? filled[0] : cleanRings(filled.flat(), FillRule.NonZero);
}

/** Max gap between chords and the curves of a shape or clip. Straight lines stay as they are. */
export const gapOf = ({ verbs }: Pick<Curves, "verbs">, toleranceMm: number): number =>
  verbs.includes(VERB_CUBIC) ? toleranceMm : 0;

interface Subpath {
  /** x, y, x, y …; the line that closes it is left out. */
  readonly xy: Float64Array;
  readonly isClosed: boolean;
}

/**
 * The subpaths of a shape, point by point.
 *
 * @param tolerance max gap between a curve and its chords, in the units of `coords`
 */
export function subpathsOf({ verbs, coords }: Curves, tolerance: number): Subpath[] {
  const subpaths: Subpath[] = [];
  const points = new PointBuffer();
  const end = (isClosed: boolean): void => {
    if (points.length > 0) subpaths.push({ xy: points.toArray(), isClosed });
    points.clear();
  };
  let at = 0;
  for (const verb of verbs) {
    if (verb === VERB_MOVE) end(false);
    const [a, b, c, d, e, f] = coords.subarray(at, at + 6);
    if (verb === VERB_CLOSE) end(true);
    else if (verb === VERB_CUBIC)
      flattenCubic(points, coords[at - 2], coords[at - 1], a, b, c, d, e, f, tolerance);
    else points.push(a, b);
    at += 2 * PAIRS_OF_VERB[verb];
  }
  end(false);
  return subpaths;
}
