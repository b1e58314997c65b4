/** Clip shapes as rings for Clipper: to clip the shapes of a clipPath, and to combine those of a mask. */
import { ClipType, type Path64, type Paths64 } from "clipper2-ts/dist/Core.js";
import type { ClipRegion, Curves } from "../../../drawing/drawing.js";
import { ringsOfClip, subpathsOf } from "../../../drawing/flatten.js";
import { IDENTITY } from "../../../geometry/affine.js";
import { boxOfPoints } from "../../../geometry/box.js";
import { SCALE, combine, ringOf } from "../../../geometry/region.js";
import type { ClipNode, ClipShapes } from "../../clip-node.js";
import { ShapeBuffer } from "../../shape-buffer.js";
import { clamp } from "../../../geometry/polyline.js";

/** Max gap between a curve and its chords, as a share of the shapes' size: the drawing may be enlarged. */
const FLATNESS = 1e-5;
/** The same in mm. */
const MIN_FLATNESS_MM = 1 / SCALE;
const MAX_FLATNESS_MM = 0.005;

/** A flattened subpath in Clipper units. */
interface Outline {
  readonly ring: Path64;
  readonly isClosed: boolean;
}

/** Input and result are in page mm. The result's rings are wound so that either fill rule fills them. */
export function clippedShape(given: ClipShapes, clip: ClipNode): ShapeBuffer {
  let rings = ringsOf(given);
  for (let at: ClipNode | null = clip; at !== null; at = at.parent) {
    rings = combine(ClipType.Intersection, rings, ringsOf(at.shapes));
  }
  return shapeOf(rings);
}

/** Rings of one shape, in page mm. */
export function clipShapesOf(rings: Paths64): ClipShapes {
  const { verbs, coords } = shapeOf(rings);
  return {
    verbs: verbs.toArray(),
    coords: coords.toArray(),
    rule: new Uint8Array(rings.length),
    shape: new Uint32Array(rings.length),
  };
}

function shapeOf(rings: Paths64): ShapeBuffer {
  const shape = new ShapeBuffer();
  for (const ring of rings) {
    ring.forEach(({ x, y }, i) => {
      if (i === 0) shape.moveTo(x / SCALE, y / SCALE);
      else shape.lineTo(x / SCALE, y / SCALE);
    });
    shape.close();
  }
  shape.finish();
  return shape;
}

/** The union of the shapes, each filled by its own rule. */
export const ringsOf = (clip: Omit<ClipRegion, "parent">): Paths64 =>
  ringsOfClip(clip, IDENTITY, flatnessOf(clip));

/** The subpaths of a path in page mm. */
export const outlinesOf = (curves: Curves): Outline[] =>
  subpathsOf(curves, flatnessOf(curves)).map(({ xy, isClosed }) => ({ ring: ringOf(xy), isClosed }));

function flatnessOf({ coords }: Curves): number {
  const { x0, y0, x1, y1 } = boxOfPoints(coords);
  const size = Math.max(x1 - x0, y1 - y0);
  return clamp(FLATNESS * size, MIN_FLATNESS_MM, MAX_FLATNESS_MM);
}
