/** The part of a shape inside a clip, as a shape: for clips on the shapes of a clipPath. */
import { ClipType, FillRule, type Paths64 } from "clipper2-ts";
import { RULE_EVENODD, VERB_CLOSE, VERB_CUBIC, VERB_LINE, VERB_MOVE } from "../../drawing/drawing.js";
import { flattenCubic } from "../../geometry/cubic.js";
import { PointBuffer } from "../../geometry/growable.js";
import { SCALE, cleanRings, combine } from "../../geometry/region.js";
import type { ClipNode, ClipShapes } from "../clip-node.js";
import { ShapeBuffer } from "../shape-buffer.js";

/** mm */
const FLATNESS = 0.005;

/** Input and result are in page mm. The result's rings are wound so that either fill rule fills them. */
export function clippedShape(given: ClipShapes, clip: ClipNode): ShapeBuffer {
  let rings = ringsOf(given);
  for (let at: ClipNode | null = clip; at !== null; at = at.parent) {
    rings = combine(ClipType.Intersection, rings, ringsOf(at.shapes));
  }
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
function ringsOf({ verbs, coords: c, rule, shape }: ClipShapes): Paths64 {
  const byShape = new Map<number, { rings: Paths64; rule: FillRule }>();
  const points = new PointBuffer();
  let subpath = -1;
  const endRing = (): void => {
    if (subpath < 0) return;
    const entry = byShape.get(shape[subpath]) ?? {
      rings: [],
      rule: rule[subpath] === RULE_EVENODD ? FillRule.EvenOdd : FillRule.NonZero,
    };
    entry.rings.push(
      Array.from({ length: points.pointCount }, (_, i) => ({
        x: Math.round(points.data[2 * i] * SCALE),
        y: Math.round(points.data[2 * i + 1] * SCALE),
      })),
    );
    byShape.set(shape[subpath], entry);
    points.clear();
  };
  for (let i = 0, at = 0; i < verbs.length; i++) {
    const verb = verbs[i];
    if (verb === VERB_MOVE) {
      endRing();
      subpath++;
    }
    if (verb === VERB_CUBIC) {
      const [x0, y0] = [c[at - 2], c[at - 1]];
      flattenCubic(points, x0, y0, c[at], c[at + 1], c[at + 2], c[at + 3], c[at + 4], c[at + 5], FLATNESS);
      at += 6;
    } else if (verb === VERB_MOVE || verb === VERB_LINE) {
      points.push(c[at], c[at + 1]);
      at += 2;
    } else if (verb !== VERB_CLOSE) break;
  }
  endRing();
  const filled = [...byShape.values()].map((entry) => cleanRings(entry.rings, entry.rule));
  return cleanRings(filled.flat(), FillRule.NonZero);
}
