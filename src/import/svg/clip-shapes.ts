/** Clip shapes as rings for Clipper: to clip the shapes of a clipPath, and to combine those of a mask. */
import { ClipType, FillRule, type Path64, type Paths64 } from "clipper2-ts";
import {
  RULE_EVENODD,
  VERB_CLOSE,
  VERB_CUBIC,
  VERB_LINE,
  VERB_MOVE,
  type ClipRegion,
} from "../../drawing/drawing.js";
import { flattenCubic } from "../../geometry/cubic.js";
import { PointBuffer } from "../../geometry/growable.js";
import { SCALE, cleanRings, combine } from "../../geometry/region.js";
import type { ClipNode, ClipShapes } from "../clip-node.js";
import { ShapeBuffer } from "../shape-buffer.js";

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
export function outlinesOf(verbs: Uint8Array, c: Float64Array): Outline[] {
  const outlines: Outline[] = [];
  const points = new PointBuffer();
  const end = (isClosed: boolean): void => {
    if (points.pointCount === 0) return;
    const ring = Array.from({ length: points.pointCount }, (_, i) => ({
      x: Math.round(points.data[2 * i] * SCALE),
      y: Math.round(points.data[2 * i + 1] * SCALE),
    }));
    outlines.push({ ring, isClosed });
    points.clear();
  };
  for (let i = 0, at = 0; i < verbs.length; i++) {
    const verb = verbs[i];
    if (verb === VERB_MOVE) end(false);
    if (verb === VERB_CLOSE) end(true);
    else if (verb === VERB_CUBIC) {
      const [x0, y0] = [c[at - 2], c[at - 1]];
      flattenCubic(points, x0, y0, c[at], c[at + 1], c[at + 2], c[at + 3], c[at + 4], c[at + 5], FLATNESS);
      at += 6;
    } else if (verb === VERB_MOVE || verb === VERB_LINE) {
      points.push(c[at], c[at + 1]);
      at += 2;
    }
  }
  end(false);
  return outlines;
}
