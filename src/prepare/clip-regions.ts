/** The file's clip paths as regions on the paper, and lines cut to them. */
import { ClipType, FillRule, type Paths64 } from "clipper2-ts";
import { RULE_EVENODD, type Drawing } from "../drawing/drawing.js";
import type { Affine } from "../geometry/affine.js";
import { LineBuilder, lineCount, type Lines } from "../geometry/polyline.js";
import { cleanRings, combine, cutLines, regionOf, ringOf, type Region } from "../geometry/region.js";
import { flattenVerbs } from "./flatten.js";

/** Cuts each line (its tag a shape) to the clip of its shape, nested clips included. */
export function clipToRegions(lines: Lines, drawing: Drawing, map: Affine, toleranceMm: number): Lines {
  if (drawing.clips.length === 0) return lines;
  const regions = new Map<number, Region>();
  const regionAt = (clip: number): Region => {
    let region = regions.get(clip);
    if (region === undefined) {
      region = regionOf(nestedRings(drawing, clip, map, toleranceMm));
      regions.set(clip, region);
    }
    return region;
  };
  return cutLines(lines, (shape) => {
    const clip = drawing.paths.clip[shape];
    return clip >= 0 ? regionAt(clip) : null;
  });
}

function nestedRings(drawing: Drawing, clip: number, map: Affine, toleranceMm: number): Paths64 {
  let rings = ringsOfClip(drawing, clip, map, toleranceMm);
  const seen = new Set([clip]);
  for (let up = drawing.clips[clip].parent; up >= 0 && !seen.has(up); up = drawing.clips[up].parent) {
    seen.add(up);
    rings = combine(ClipType.Intersection, rings, ringsOfClip(drawing, up, map, toleranceMm));
  }
  return rings;
}

/** The union of the region's shapes, each filled under its own rule. */
function ringsOfClip(drawing: Drawing, index: number, map: Affine, toleranceMm: number): Paths64 {
  const clip = drawing.clips[index];
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
  const filled: Paths64[] = [];
  for (let i = 0, next = 0; i < lineCount(lines); i = next) {
    const shape = clip.shape?.[lines.tag[i]];
    const rings: Paths64 = [];
    for (next = i; next < lineCount(lines) && clip.shape?.[lines.tag[next]] === shape; next++) {
      rings.push(ringOf(lines, next));
    }
    const isEvenOdd = clip.rule[lines.tag[i]] === RULE_EVENODD;
    filled.push(cleanRings(rings, isEvenOdd ? FillRule.EvenOdd : FillRule.NonZero));
  }
  // Clean rings wind the same way round, so shapes that overlap do not cancel.
  return filled.length === 1 ? filled[0] : cleanRings(filled.flat(), FillRule.NonZero);
}
