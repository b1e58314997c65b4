/** A shape's subpaths as polylines, with chords for its curves. */
import { PAIRS_OF_VERB, VERB_CLOSE, VERB_CUBIC, VERB_MOVE, type Curves } from "../drawing/drawing.js";
import { flattenCubic } from "../geometry/cubic.js";
import { PointBuffer } from "../geometry/growable.js";

export interface Subpath {
  /** x, y, x, y …; the line that closes it is left out. */
  readonly xy: Float64Array;
  readonly isClosed: boolean;
}

/** @param tolerance max gap between a curve and its chords, in the units of `coords` */
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
