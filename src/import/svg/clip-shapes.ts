/** Clip shapes as rings for Clipper: to clip the shapes of a clipPath, and to combine those of a mask. */
import { ClipType, FillRule, type Path64, type Paths64 } from "clipper2-ts";
import { RULE_EVENODD, type ClipRegion } from "../../drawing/drawing.js";
import { SCALE, cleanRings, combine } from "../../geometry/region.js";
import type { ClipNode, ClipShapes } from "../clip-node.js";
import { ShapeBuffer } from "../shape-buffer.js";
import { subpathsOf } from "../subpaths.js";

/** mm */
const FLATNESS = 0.005;

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
export function ringsOf({ verbs, coords, rule, shape }: Omit<ClipRegion, "parent">): Paths64 {
  const byShape = new Map<number, { rings: Paths64; rule: FillRule }>();
  outlinesOf(verbs, coords).forEach(({ ring }, subpath) => {
    const index = shape?.[subpath] ?? 0;
    const entry = byShape.get(index) ?? {
      rings: [],
      rule: rule[subpath] === RULE_EVENODD ? FillRule.EvenOdd : FillRule.NonZero,
    };
    entry.rings.push(ring);
    byShape.set(index, entry);
  });
  const filled = [...byShape.values()].map((entry) => cleanRings(entry.rings, entry.rule));
  return cleanRings(filled.flat(), FillRule.NonZero);
}

/** The subpaths of a path in page mm. */
export const outlinesOf = (verbs: Uint8Array, coords: Float64Array): Outline[] =>
  subpathsOf(verbs, coords, FLATNESS).map(({ xy, isClosed }) => ({ ring: ringOf(xy), isClosed }));

const ringOf = (xy: Float64Array): Path64 =>
  Array.from({ length: xy.length / 2 }, (_, i) => ({
    x: Math.round(xy[2 * i] * SCALE),
    y: Math.round(xy[2 * i + 1] * SCALE),
  }));
