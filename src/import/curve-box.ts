/** The exact bounding box of a shape's curves, not of their control points. */
import { PAIRS_OF_VERB, VERB_CUBIC } from "../drawing/drawing.js";
import { EMPTY_BOX, type Box } from "../geometry/box.js";
import type { ShapeBuffer } from "./shape-buffer.js";

export const curveBox = (shape: ShapeBuffer): Box =>
  curveBoxOf(shape.verbs.data, 0, shape.verbs.length, shape.coords.data, 0);

/** The box of the verbs [verbFrom, verbTo), whose coordinates begin at `at`. */
export function curveBoxOf(
  verbs: Uint8Array,
  verbFrom: number,
  verbTo: number,
  c: Float64Array,
  at: number,
): Box {
  let { x0, y0, x1, y1 } = EMPTY_BOX;
  const add = (x: number, y: number): void => {
    x0 = Math.min(x0, x);
    x1 = Math.max(x1, x);
    y0 = Math.min(y0, y);
    y1 = Math.max(y1, y);
  };
  for (let i = verbFrom; i < verbTo; i++) {
    const verb = verbs[i];
    if (verb === VERB_CUBIC) {
      for (const axis of [0, 1]) {
        for (const t of extremes(c[at - 2 + axis], c[at + axis], c[at + 2 + axis], c[at + 4 + axis])) {
          const p = (k: number): number => cubicAt(c[at - 2 + k], c[at + k], c[at + 2 + k], c[at + 4 + k], t);
          add(p(0), p(1));
        }
      }
    }
    const pairs = PAIRS_OF_VERB[verb];
    at += 2 * pairs;
    if (pairs > 0) add(c[at - 2], c[at - 1]);
  }
  return { x0, y0, x1, y1 };
}

export function cubicAt(p0: number, p1: number, p2: number, p3: number, t: number): number {
  const s = 1 - t;
  return s * s * s * p0 + 3 * s * s * t * p1 + 3 * s * t * t * p2 + t * t * t * p3;
}

/** Where the derivative along one axis is zero, inside 0 … 1. */
function extremes(p0: number, p1: number, p2: number, p3: number): number[] {
  // B′/3 = a t² + 2 b t + c
  const a = p3 - 3 * p2 + 3 * p1 - p0;
  const b = p2 - 2 * p1 + p0;
  const c = p1 - p0;
  const disc = b * b - a * c;
  if (!(disc >= 0)) return [];
  const q = -(b + (b < 0 ? -1 : 1) * Math.sqrt(disc));
  return [q / a, c / q].filter((t) => t > 0 && t < 1);
}
