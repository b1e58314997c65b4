/**
 * Exact bounding boxes of curves: a cubic's extremes are where its derivative is zero, not at its control points.
 *
 *   B′(t)/3 = a t² + b t + c,  a = −p0 + 3p1 − 3p2 + p3,  b = 2 (p0 − 2p1 + p2),  c = p1 − p0
 */
import { VERB_CLOSE, VERB_CUBIC, VERB_MOVE, type Curves } from "./drawing.js";
import { applyX, applyY, type Affine } from "../geometry/affine.js";
import type { Box } from "../geometry/box.js";

/** The box of curves transformed by `map`. Moves that draw nothing are ignored. */
export function curveBoxOf({ verbs, coords }: Curves, map: Affine): Box {
  let x0 = Infinity;
  let y0 = Infinity;
  let x1 = -Infinity;
  let y1 = -Infinity;
  const include = (px: number, py: number): void => {
    x0 = Math.min(x0, px);
    y0 = Math.min(y0, py);
    x1 = Math.max(x1, px);
    y1 = Math.max(y1, py);
  };
  let x = 0;
  let y = 0;
  let at = 0;
  for (const verb of verbs) {
    if (verb !== VERB_MOVE) include(x, y);
    if (verb === VERB_CLOSE) continue;
    const endAt = verb === VERB_CUBIC ? at + 4 : at;
    const endX = applyX(map, coords[endAt], coords[endAt + 1]);
    const endY = applyY(map, coords[endAt], coords[endAt + 1]);
    if (verb === VERB_CUBIC) {
      const [ux, uy, wx, wy] = [coords[at], coords[at + 1], coords[at + 2], coords[at + 3]];
      const [minX, maxX] = extremesOf(x, applyX(map, ux, uy), applyX(map, wx, wy), endX);
      const [minY, maxY] = extremesOf(y, applyY(map, ux, uy), applyY(map, wx, wy), endY);
      include(minX, minY);
      include(maxX, maxY);
    }
    x = endX;
    y = endY;
    at = endAt + 2;
    if (verb !== VERB_MOVE) include(x, y);
  }
  return { x0, y0, x1, y1 };
}

/** Beyond this the squares below might overflow, so the control points are used as the bound. */
const OVERFLOWING = 1e100;

/** The range of one coordinate of a curve, min and max: its ends, and its extremes between them. */
function extremesOf(p0: number, p1: number, p2: number, p3: number): readonly [number, number] {
  const min = Math.min(p0, p3);
  const max = Math.max(p0, p3);
  if (p1 >= min && p1 <= max && p2 >= min && p2 <= max) return [min, max];
  if (Math.abs(p1) > OVERFLOWING || Math.abs(p2) > OVERFLOWING) {
    return [Math.min(min, p1, p2), Math.max(max, p1, p2)];
  }
  const a = p3 - p0 + 3 * (p1 - p2);
  const b = 2 * (p0 - 2 * p1 + p2);
  const c = p1 - p0;
  const root = Math.sqrt(Math.max(b * b - 4 * a * c, 0));
  // Avoids cancellation: one root is q/a, the other c/q.
  const q = -(b + (b >= 0 ? root : -root)) / 2;
  const extremes = [q / a, c / q].filter((t) => t > 0 && t < 1).map((t) => cubicAt(p0, p1, p2, p3, t));
  return [Math.min(min, ...extremes), Math.max(max, ...extremes)];
}

/** One coordinate of a cubic at parameter `t`. */
export function cubicAt(p0: number, p1: number, p2: number, p3: number, t: number): number {
  const s = 1 - t;
  return s * s * s * p0 + 3 * s * s * t * p1 + 3 * s * t * t * p2 + t * t * t * p3;
}
