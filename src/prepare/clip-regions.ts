/** The file's clip paths as regions on the paper. */
import { ClipType, FillRule, type Paths64 } from "clipper2-ts";
import { RULE_EVENODD, type ClipRegion, type Drawing } from "../drawing/drawing.js";
import type { Affine } from "../geometry/affine.js";
import { LineBuilder, lineCount } from "../geometry/polyline.js";
import { cleanRings, combine, regionOf, ringOf, type Region } from "../geometry/region.js";
import { flattenVerbs } from "./flatten.js";

/**
 * Returns a function for the region that clips a shape, nested clips included; null for a shape without a clip. Each
 * region is computed on first use.
 */
export function clipRegions(
  drawing: Drawing,
  map: Affine,
  toleranceMm: number,
): (shape: number) => Region | null {
  const regions = new Map<number, Region>();
  return (shape) => {
    const clip = drawing.paths.clip[shape];
    if (clip < 0) return null;
    let region = regions.get(clip);
    if (region === undefined) {
      region = regionOf(nestedRings(drawing, clip, map, toleranceMm));
      regions.set(clip, region);
    }
    return region;
  };
}

function nestedRings(drawing: Drawing, clip: number, map: Affine, toleranceMm: number): Paths64 {
  let rings = ringsOfClip(drawing.clips[clip], map, toleranceMm);
  const seen = new Set([clip]);
  for (let up = drawing.clips[clip].parent; up >= 0 && !seen.has(up); up = drawing.clips[up].parent) {
    seen.add(up);
    rings = combine(ClipType.Intersection, rings, ringsOfClip(drawing.clips[up], map, toleranceMm));
  }
  return rings;
}

/** The union of the clip's shapes, each filled by its own rule. */
function ringsOfClip(clip: ClipRegion, map: Affine, toleranceMm: number): Paths64 {
  const builder = new LineBuilder();
  const range = {
    verbs: clip.verbs,
    verbFrom: 0,
    verbTo: clip.verbs.length,
    coords: clip.coords,
    coordFrom: 0,
  };
  flattenVerbs(range, map, toleranceMm, true, builder, (subpath) => subpath);
  const lines = builder.finish();
  const shapes = new Map<string, { rings: Paths64; rule: FillRule }>();
  for (let i = 0; i < lineCount(lines); i++) {
    const subpath = lines.tag[i];
    const rule = clip.rule[subpath] === RULE_EVENODD ? FillRule.EvenOdd : FillRule.NonZero;
    const key = `${rule} ${clip.shape?.[subpath] ?? ""}`;
    const shape = shapes.get(key);
    if (shape === undefined) shapes.set(key, { rings: [ringOf(lines, i)], rule });
    else shape.rings.push(ringOf(lines, i));
  }
  const filled = [...shapes.values()].map(({ rings, rule }) => cleanRings(rings, rule));
  // Clean rings wind in the same direction, so overlapping shapes do not cancel.
  return filled.length === 1 ? filled[0] : cleanRings(filled.flat(), FillRule.NonZero);
}
