/** Converts shapes to polylines. */
import { VERB_CUBIC, curvesOf, type Curves, type DrawingPaths } from "../drawing/drawing.js";
import { flattenVerbs } from "../drawing/flatten.js";
import type { Affine } from "../geometry/affine.js";
import { LineBuilder, type Lines } from "../geometry/polyline.js";
import { stopIfCancelled, type Work } from "./work.js";

/**
 * Makes one line from each subpath of the shapes for which `wanted` is 1; its tag is the shape. A subpath of zero
 * length becomes a dot. A shape without a stroke is drawn as the outline of its fill: its subpaths are closed, and its
 * dots are dropped.
 */
export function flattenShapes(
  paths: DrawingPaths,
  map: Affine,
  toleranceMm: number,
  wanted: Uint8Array,
  work: Work,
): Lines {
  const builder = new LineBuilder();
  for (let shape = 0; shape < paths.count; shape++) {
    stopIfCancelled(work);
    if (wanted[shape] === 0) continue;
    const isArea = paths.stroke[shape] < 0;
    flattenVerbs(curvesOf(paths, shape), map, toleranceMm, isArea, builder, () => shape);
  }
  return builder.finish();
}

/** Max gap between the chords of `flattenShapes` and their curves, mm, by shape. */
export const gapsOfShapes = (paths: DrawingPaths, toleranceMm: number): Float64Array =>
  Float64Array.from({ length: paths.count }, (_, shape) => gapOf(curvesOf(paths, shape), toleranceMm));

/** The same for the curves of one shape or clip. Straight lines stay as they are. */
export const gapOf = ({ verbs }: Pick<Curves, "verbs">, toleranceMm: number): number =>
  verbs.includes(VERB_CUBIC) ? toleranceMm : 0;
