/**
 * The file's clip paths: as regions on the paper, and lines cut by them. A fill without a stroke is drawn as the outline
 * of its clipped area, so the clip's edge becomes part of its outline.
 */
import { ClipType } from "clipper2-ts/dist/Core.js";
import type { Drawing } from "../../drawing/drawing.js";
import { gapOf, ringsOfClip } from "../../drawing/flatten.js";
import type { Affine } from "../../geometry/affine.js";
import { cutLine } from "../../geometry/cut-line.js";
import { LineBuilder, tagRanges, totalLength, type Lines } from "../../geometry/polyline.js";
import { addPath, combine, regionOf, type Region } from "../../geometry/region.js";
import { getOrAdd } from "../../get-or-add.js";
import { filledAreas } from "./areas.js";
import type { Work } from "../work.js";

/** If a clip cuts off no more than this, it is rounding, and the shape counts as whole, mm. */
const UNCUT = 0.001;

/**
 * Returns a function for the region that clips a shape, nested clips included; null for a shape without a clip. Each
 * region is computed on first use.
 */
export function clipRegions(
  { paths, clips }: Drawing,
  map: Affine,
  toleranceMm: number,
): (shape: number) => Region | null {
  const regions = new Map<number, Region>();
  const regionOfClip = (clip: number): Region => {
    let rings = ringsOfClip(clips[clip], map, toleranceMm);
    let gap = gapOf(clips[clip], toleranceMm);
    for (let up = clips[clip].parent; up >= 0; up = clips[up].parent) {
      rings = combine(ClipType.Intersection, rings, ringsOfClip(clips[up], map, toleranceMm));
      gap = Math.max(gap, gapOf(clips[up], toleranceMm));
    }
    return regionOf(rings, gap);
  };
  return (shape) => {
    const clip = paths.clip[shape];
    return clip < 0 ? null : getOrAdd(regions, clip, () => regionOfClip(clip));
  };
}

/**
 * `lines` are the shapes' outlines, tag = shape; `clipOf` gives the region that clips a shape, or null; `gaps` are those
 * of `gapsOfShapes`.
 */
export function clipLines(
  lines: Lines,
  drawing: Drawing,
  clipOf: (shape: number) => Region | null,
  gaps: Float64Array,
  work: Work,
): Lines {
  const builder = new LineBuilder();
  for (const [first, end] of tagRanges(lines)) {
    const shape = lines.tag[first];
    const clip = clipOf(shape);
    if (clip === null) copyAll(lines, first, end, builder);
    else if (drawing.paths.stroke[shape] >= 0) cutAll(lines, first, end, gaps[shape], clip, builder);
    else clipFill(lines, first, end, drawing, clip, gaps, builder, work);
  }
  return builder.finish();
}

function copyAll(lines: Lines, from: number, to: number, builder: LineBuilder): void {
  for (let i = from; i < to; i++) builder.copy(lines, i, lines.tag[i]);
}

function cutAll(
  lines: Lines,
  from: number,
  to: number,
  gap: number,
  clip: Region,
  builder: LineBuilder,
): void {
  for (let i = from; i < to; i++) cutLine(lines, i, gap, clip, false, builder);
}

/** Copies the outline if the clip leaves it whole; otherwise adds the outline of the clipped area. */
function clipFill(
  lines: Lines,
  from: number,
  to: number,
  drawing: Drawing,
  clip: Region,
  gaps: Float64Array,
  builder: LineBuilder,
  work: Work,
): void {
  const copy = new LineBuilder();
  copyAll(lines, from, to, copy);
  const outline = copy.finish();
  const shape = lines.tag[from];
  const cut = new LineBuilder();
  cutAll(lines, from, to, gaps[shape], clip, cut);
  if (totalLength(outline) - totalLength(cut.finish()) < UNCUT) {
    copyAll(lines, from, to, builder);
    return;
  }
  const area = filledAreas(outline, drawing, () => clip, gaps, false, work).get(shape);
  for (const ring of area?.rings ?? []) addPath([...ring, ring[0]], shape, builder);
}
