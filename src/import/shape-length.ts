/** Length of a shape's lines and curves, in its own units, to about one part in ten thousand. */
import { VERB_CLOSE, VERB_CUBIC, VERB_LINE, VERB_MOVE } from "../drawing/drawing.js";
import { cubicAt } from "./curve-box.js";
import type { ShapeBuffer } from "./shape-buffer.js";

const STEPS_PER_CURVE = 64;

export function polylineLength(shape: ShapeBuffer): number {
  const c = shape.coords.data;
  let total = 0;
  let startX = 0;
  let startY = 0;
  let x = 0;
  let y = 0;
  const to = (nx: number, ny: number): void => {
    total += Math.hypot(nx - x, ny - y);
    x = nx;
    y = ny;
  };
  for (let i = 0, at = 0; i < shape.verbs.length; i++) {
    const verb = shape.verbs.data[i];
    if (verb === VERB_MOVE) {
      x = startX = c[at];
      y = startY = c[at + 1];
      at += 2;
    } else if (verb === VERB_LINE) {
      to(c[at], c[at + 1]);
      at += 2;
    } else if (verb === VERB_CUBIC) {
      const x0 = x;
      const y0 = y;
      for (let k = 1; k <= STEPS_PER_CURVE; k++) {
        const t = k / STEPS_PER_CURVE;
        to(cubicAt(x0, c[at], c[at + 2], c[at + 4], t), cubicAt(y0, c[at + 1], c[at + 3], c[at + 5], t));
      }
      at += 6;
    } else if (verb === VERB_CLOSE) {
      to(startX, startY);
    }
  }
  return total;
}
