/**
 * Exact bounding boxes: a cubic's extremes are where its derivative is zero, not at its control points.
 *
 *   B′(t)/3 = a t² + b t + c,  a = −p0 + 3p1 − 3p2 + p3,  b = 2 (p0 − 2p1 + p2),  c = p1 − p0
 */
import { VERB_CLOSE, VERB_CUBIC, VERB_MOVE } from "../drawing/drawing.js";
import type { Affine } from "../geometry/affine.js";

/**
 * Writes the box of verbs [verbFrom, verbTo), whose coordinates start at `at`, transformed by `map`, to `out` from
 * `outAt` on: x0, y0, x1, y1. Moves that draw nothing are ignored.
 */
export function boundsOfVerbs(
  verbs: Uint8Array,
  verbFrom: number,
  verbTo: number,
  coords: Float64Array,
  at: number,
  map: Affine,
  out: Float64Array,
  outAt: number,
): void {
  const { a, b, c, d, e, f } = map;
  let x0 = Infinity;
  let y0 = Infinity;
  let x1 = -Infinity;
  let y1 = -Infinity;
  let x = 0;
  let y = 0;
  for (let v = verbFrom; v < verbTo; v++) {
    const verb = verbs[v];
    if (verb !== VERB_MOVE) {
      x0 = Math.min(x0, x);
      y0 = Math.min(y0, y);
      x1 = Math.max(x1, x);
      y1 = Math.max(y1, y);
    }
    if (verb === VERB_CLOSE) continue;
    const endAt = verb === VERB_CUBIC ? at + 4 : at;
    const endX = a * coords[endAt] + c * coords[endAt + 1] + e;
    const endY = b * coords[endAt] + d * coords[endAt + 1] + f;
    if (verb === VERB_CUBIC) {
      const [ux, uy, wx, wy] = [coords[at], coords[at + 1], coords[at + 2], coords[at + 3]];
      const rangeX = extremesOf(x, a * ux + c * uy + e, a * wx + c * wy + e, endX);
      x0 = Math.min(x0, rangeX.low);
      x1 = Math.max(x1, rangeX.high);
      const rangeY = extremesOf(y, b * ux + d * uy + f, b * wx + d * wy + f, endY);
      y0 = Math.min(y0, rangeY.low);
      y1 = Math.max(y1, rangeY.high);
    }
    x = endX;
    y = endY;
    at = endAt + 2;
    if (verb !== VERB_MOVE) {
      x0 = Math.min(x0, x);
      y0 = Math.min(y0, y);
      x1 = Math.max(x1, x);
      y1 = Math.max(y1, y);
    }
  }
  out[outAt] = x0;
  out[outAt + 1] = y0;
  out[outAt + 2] = x1;
  out[outAt + 3] = y1;
}

/** Beyond this the squares below might overflow, so the control points are used as the bound. */
const OVERFLOWING = 1e100;

/** Reused by each call of `extremesOf`. */
const range = { low: 0, high: 0 };

/** The range of one coordinate of a curve: its ends, and its extremes between them. */
function extremesOf(
  p0: number,
  p1: number,
  p2: number,
  p3: number,
): { readonly low: number; readonly high: number } {
  range.low = Math.min(p0, p3);
  range.high = Math.max(p0, p3);
  if (p1 >= range.low && p1 <= range.high && p2 >= range.low && p2 <= range.high) return range;
  if (Math.abs(p1) > OVERFLOWING || Math.abs(p2) > OVERFLOWING) {
    range.low = Math.min(range.low, p1, p2);
    range.high = Math.max(range.high, p1, p2);
    return range;
  }
  const a = p3 - p0 + 3 * (p1 - p2);
  const b = 2 * (p0 - 2 * p1 + p2);
  const c = p1 - p0;
  const root = Math.sqrt(Math.max(b * b - 4 * a * c, 0));
  // Avoids cancellation: one root is q/a, the other c/q.
  const q = -(b + (b >= 0 ? root : -root)) / 2;
  addExtreme(p0, p1, p2, p3, q / a);
  addExtreme(p0, p1, p2, p3, c / q);
  return range;
}

function addExtreme(p0: number, p1: number, p2: number, p3: number, t: number): void {
  if (!(t > 0 && t < 1)) return;
  const s = 1 - t;
  const value = s * s * s * p0 + 3 * s * s * t * p1 + 3 * s * t * t * p2 + t * t * t * p3;
  range.low = Math.min(range.low, value);
  range.high = Math.max(range.high, value);
}
