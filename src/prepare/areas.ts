/** The areas of filled shapes on the paper, used for hatching and for hiding lines. */
import { ClipType, FillRule, type Paths64 } from "clipper2-ts";
import { RULE_EVENODD, type Drawing } from "../drawing/drawing.js";
import { boxContains, type Box } from "../geometry/box.js";
import { isClosedLine, lineCount, type Lines } from "../geometry/polyline.js";
import { SCALE, cleanRings, combine, regionOf, ringOf, type Region } from "../geometry/region.js";
import { stopIfCancelled, type Work } from "./work.js";

/**
 * The region of each filled shape, in paint order, by its fill rule, cut to its clip. With `hasOutlines`,
 * shapes without a fill also have a region: the inside of their closed lines. `lines` are the shapes' subpaths, tagged
 * with their shape. An open subpath of a filled shape is closed by a straight line, as in SVG.
 */
export function filledAreas(
  lines: Lines,
  drawing: Drawing,
  clipOf: (shape: number) => Region | null,
  hasOutlines: boolean,
  work: Work,
): Map<number, Region> {
  const areas = new Map<number, Region>();
  for (let i = 0, next = 0; i < lineCount(lines); i = next) {
    stopIfCancelled(work);
    const shape = lines.tag[i];
    const isFilled = drawing.paths.fill[shape] >= 0;
    const rings: Paths64 = [];
    for (next = i; next < lineCount(lines) && lines.tag[next] === shape; next++) {
      const isRing = isFilled || (hasOutlines && isClosedLine(lines, next));
      if (isRing && lines.offsets[next + 1] - lines.offsets[next] > 2) rings.push(ringOf(lines, next));
    }
    if (rings.length === 0) continue;
    const isEvenOdd = !isFilled || drawing.paths.fillRule[shape] === RULE_EVENODD;
    const rule = isEvenOdd ? FillRule.EvenOdd : FillRule.NonZero;
    let area = cleanRings(rings, rule);
    const clip = clipOf(shape);
    if (clip !== null) area = combine(ClipType.Intersection, area, clip.rings);
    if (area.length > 0) areas.set(shape, regionOf(area));
  }
  return areas;
}

/** Cuts the areas to `limit`. Areas entirely outside are dropped. */
export function cropAreas(areas: ReadonlyMap<number, Region>, limit: Box): Map<number, Region> {
  const frame = frameOf(limit);
  const kept = new Map<number, Region>();
  for (const [shape, area] of areas) {
    const inside = boxContains(limit, area.box)
      ? area
      : regionOf(combine(ClipType.Intersection, area.rings, [frame]));
    if (inside.rings.length > 0) kept.set(shape, inside);
  }
  return kept;
}

/** The areas of filled shapes only, because an outline hides nothing. */
export const filledOnly = (areas: ReadonlyMap<number, Region>, drawing: Drawing): Map<number, Region> =>
  new Map([...areas].filter(([shape]) => drawing.paths.fill[shape] >= 0));

const frameOf = (box: Box): { x: number; y: number }[] =>
  [
    [box.x0, box.y0],
    [box.x1, box.y0],
    [box.x1, box.y1],
    [box.x0, box.y1],
  ].map(([x, y]) => ({ x: Math.round(x * SCALE), y: Math.round(y * SCALE) }));
