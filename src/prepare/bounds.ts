/**
 * How far shapes reach, exactly: a cubic's extremes are where its derivative is zero, not its controls.
 *
 *   B′(t)/3 = a t² + b t + c,  a = −p0 + 3p1 − 3p2 + p3,  b = 2 (p0 − 2p1 + p2),  c = p1 − p0
 */
import { VERB_CLOSE, VERB_CUBIC, VERB_MOVE } from "../drawing/drawing.js";
import type { Affine } from "../geometry/affine.js";
import { EMPTY_BOX, type Box } from "../geometry/box.js";

/** Box of verbs [verbFrom, verbTo) with coordinates from `at`, under `map`. Moves that draw nothing do not count. */
export function boundsOfVerbs(
  verbs: Uint8Array,
  verbFrom: number,
  verbTo: number,
  coords: Float64Array,
  at: number,
  map: Affine,
): Box {
  const reach = new Reach();
  let x = 0;
  let y = 0;
  const mapped = (k: number): [number, number] => [
    map.a * coords[k] + map.c * coords[k + 1] + map.e,
    map.b * coords[k] + map.d * coords[k + 1] + map.f,
  ];
  for (let v = verbFrom; v < verbTo; v++) {
    const verb = verbs[v];
    if (verb !== VERB_MOVE) reach.add(x, y);
    if (verb === VERB_CLOSE) continue;
    if (verb === VERB_CUBIC) {
      const [x1, y1] = mapped(at);
      const [x2, y2] = mapped(at + 2);
      const [x3, y3] = mapped(at + 4);
      addExtremes(x, x1, x2, x3, (value) => reach.addX(value));
      addExtremes(y, y1, y2, y3, (value) => reach.addY(value));
      at += 4;
    }
    [x, y] = mapped(at);
    at += 2;
    if (verb !== VERB_MOVE) reach.add(x, y);
  }
  return reach.box();
}

class Reach {
  private x0 = EMPTY_BOX.x0;
  private y0 = EMPTY_BOX.y0;
  private x1 = EMPTY_BOX.x1;
  private y1 = EMPTY_BOX.y1;

  addX(x: number): void {
    if (x < this.x0) this.x0 = x;
    if (x > this.x1) this.x1 = x;
  }

  addY(y: number): void {
    if (y < this.y0) this.y0 = y;
    if (y > this.y1) this.y1 = y;
  }

  add(x: number, y: number): void {
    this.addX(x);
    this.addY(y);
  }

  box(): Box {
    return { x0: this.x0, y0: this.y0, x1: this.x1, y1: this.y1 };
  }
}

/** Beyond this the squares below might overflow; the controls then stand for the curve, as a bound. */
const OVERFLOWING = 1e100;

/** Calls `add` with the curve's values where it turns, for one coordinate. */
function addExtremes(p0: number, p1: number, p2: number, p3: number, add: (value: number) => void): void {
  const low = Math.min(p0, p3);
  const high = Math.max(p0, p3);
  if (p1 >= low && p1 <= high && p2 >= low && p2 <= high) return;
  if (Math.abs(p1) > OVERFLOWING || Math.abs(p2) > OVERFLOWING) {
    add(p1);
    return add(p2);
  }
  const a = p3 - p0 + 3 * (p1 - p2);
  const b = 2 * (p0 - 2 * p1 + p2);
  const c = p1 - p0;
  const root = Math.sqrt(Math.max(b * b - 4 * a * c, 0));
  // The form without cancellation: one root by q/a, the other by c/q.
  const q = -(b + (b >= 0 ? root : -root)) / 2;
  for (const t of [q / a, c / q]) {
    if (!(t > 0 && t < 1)) continue;
    const s = 1 - t;
    add(s * s * s * p0 + 3 * s * s * t * p1 + 3 * s * t * t * p2 + t * t * t * p3);
  }
}
