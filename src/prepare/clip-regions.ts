/** The file's clip paths as regions on the paper. */
import { ClipType } from "clipper2-ts";
import { ringsOfClip } from "../drawing/flatten.js";
import type { Drawing } from "../drawing/drawing.js";
import type { Affine } from "../geometry/affine.js";
import { combine, regionOf, type Region } from "../geometry/region.js";
import { gapOf } from "./flatten.js";

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
      region = nestedRegion(drawing, clip, map, toleranceMm);
      regions.set(clip, region);
    }
    return region;
  };
}

function nestedRegion({ clips }: Drawing, clip: number, map: Affine, toleranceMm: number): Region {
  let rings = ringsOfClip(clips[clip], map, toleranceMm);
  let gap = gapOf(clips[clip], toleranceMm);
  const seen = new Set([clip]);
  for (let up = clips[clip].parent; up >= 0 && !seen.has(up); up = clips[up].parent) {
    seen.add(up);
    rings = combine(ClipType.Intersection, rings, ringsOfClip(clips[up], map, toleranceMm));
    gap = Math.max(gap, gapOf(clips[up], toleranceMm));
  }
  return regionOf(rings, gap);
}
