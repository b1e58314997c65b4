/** The file's clip paths as regions on the paper. */
import { ClipType, type Paths64 } from "clipper2-ts";
import { ringsOfClip } from "../drawing/flatten.js";
import type { Drawing } from "../drawing/drawing.js";
import type { Affine } from "../geometry/affine.js";
import { combine, regionOf, type Region } from "../geometry/region.js";

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
