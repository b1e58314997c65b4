/** The areas of filled shapes on the paper, used for hatching and for hiding lines. */
import { ClipType, FillRule, type Paths64 } from "clipper2-ts/dist/Core.js";
import { RULE_EVENODD, type Drawing } from "../../drawing/drawing.js";
import { boxContains, type Box } from "../../geometry/box.js";
import { isClosedLine, tagRanges, type Lines } from "../../geometry/polyline.js";
import { cleanRings, combine, regionOf, ringOf, ringOfLine, type Region } from "../../geometry/region.js";
import { stopIfCancelled, type Work } from "../work.js";

/**
 * The region of each filled shape, in paint order, by its fill rule, cut to its clip. With `hasOutlines`,
 * shapes without a fill also have a region: the inside of their closed lines. `lines` are the shapes' subpaths, tagged
 * with their shape, `gaps` those of `gapsOfShapes`. An open subpath of a filled shape is closed by a straight line, as in SVG.
 */
export function filledAreas(
  lines: Lines,
  drawing: Drawing,
  clipOf: (shape: number) => Region | null,
  gaps: Float64Array,
  hasOutlines: boolean,
  work: Work,
): Map<number, Region> {
  const areas = new Map<number, Region>();
  for (const [first, end] of tagRanges(lines)) {
    stopIfCancelled(work);
    const shape = lines.tag[first];
    const isFilled = drawing.paths.fill[shape] >= 0;
    const rings: Paths64 = [];
    for (let i = first; i < end; i++) {
      const isRing = isFilled || (hasOutlines && isClosedLine(lines, i));
      if (isRing && lines.offsets[i + 1] - lines.offsets[i] > 2) rings.push(ringOfLine(lines, i));
    }
    if (rings.length === 0) continue;
    const isEvenOdd = !isFilled || drawing.paths.fillRule[shape] === RULE_EVENODD;
    const rule = isEvenOdd ? FillRule.EvenOdd : FillRule.NonZero;
    let area = cleanRings(rings, rule);
    let gap = gaps[shape];
    const clip = clipOf(shape);
    if (clip !== null) {
      area = combine(ClipType.Intersection, area, clip.rings);
      gap = Math.max(gap, clip.gap);
    }
    if (area.length > 0) areas.set(shape, regionOf(area, gap));
  }
  return areas;
}

/** Cuts the areas to `limit`. Areas entirely outside are dropped. */
export function cropAreas(areas: ReadonlyMap<number, Region>, limit: Box): Map<number, Region> {
  const { x0, y0, x1, y1 } = limit;
  const frame = ringOf([x0, y0, x1, y0, x1, y1, x0, y1]);
  const kept = new Map<number, Region>();
  for (const [shape, area] of areas) {
    const inside = boxContains(limit, area.box)
      ? area
      : regionOf(combine(ClipType.Intersection, area.rings, [frame]), area.gap);
    if (inside.rings.length > 0) kept.set(shape, inside);
  }
  return kept;
}

/** The areas of filled shapes only, because an outline hides nothing. */
export const filledOnly = (areas: ReadonlyMap<number, Region>, drawing: Drawing): Map<number, Region> =>
  new Map([...areas].filter(([shape]) => drawing.paths.fill[shape] >= 0));
