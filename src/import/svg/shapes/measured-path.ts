/**
 * A shape's outline by arc length: its length, and the position at a given length.
 *
 *        start ↗─ chord ─→ end        s counts all chords of all subpaths; a move between
 *             from       s            subpaths has no length
 *
 * A curve is divided into STEPS chords; its length is accurate to about one part in ten thousand. Along a
 * chord the direction changes linearly from the curve's tangent at its start to the one at its end.
 */
import { VERB_CLOSE, VERB_CUBIC, VERB_LINE, VERB_MOVE } from "../../../drawing/drawing.js";
import { firstWhere } from "../../../geometry/binary-search.js";
import { cubicAt } from "../../../drawing/curve-box.js";
import type { ShapeBuffer } from "../../shape-buffer.js";
import { clamp } from "../../../geometry/polyline.js";

const STEPS = 64;

export interface PathPosition {
  readonly x: number;
  readonly y: number;
  /** Direction of travel, rad; +x towards +y. */
  readonly angle: number;
}

interface Chord {
  /** Arc length at its end. */
  readonly end: number;
  readonly length: number;
  readonly x: number;
  readonly y: number;
  readonly dx: number;
  readonly dy: number;
  readonly startAngle: number;
  /** Change of direction along it, −π … π. */
  readonly turn: number;
}

export class MeasuredPath {
  readonly length: number;
  /** A single subpath that ends where it begins. */
  readonly isClosed: boolean;
  private readonly chords: readonly Chord[];

  constructor(shape: ShapeBuffer) {
    const chords: Chord[] = [];
    this.length = measure(shape, chords);
    this.chords = chords;
    const verbs = shape.verbs.data.subarray(0, shape.verbs.length);
    this.isClosed = verbs.lastIndexOf(VERB_MOVE) === 0 && verbs[verbs.length - 1] === VERB_CLOSE;
  }

  /** The position at length `along`, clamped to the path's ends; null if the path has no length. */
  positionAt(along: number): PathPosition | null {
    const { chords } = this;
    if (chords.length === 0) return null;
    const at = firstWhere(0, chords.length - 1, (i) => chords[i].end >= along);
    const { end, length, x, y, dx, dy, startAngle, turn } = chords[at];
    const t = clamp(1 - (end - along) / length, 0, 1);
    return { x: x + t * dx, y: y + t * dy, angle: startAngle + t * turn };
  }
}

/** Adds the chords of all verbs; returns their total length. */
function measure(shape: ShapeBuffer, chords: Chord[]): number {
  const c = shape.coords.data;
  let total = 0;
  let startX = 0;
  let startY = 0;
  let x = 0;
  let y = 0;
  const to = (nx: number, ny: number, startAngle?: number, endAngle?: number): void => {
    const dx = nx - x;
    const dy = ny - y;
    const length = Math.hypot(dx, dy);
    if (length > 0) {
      total += length;
      const from = startAngle ?? Math.atan2(dy, dx);
      const turn =
        endAngle === undefined ? 0 : Math.atan2(Math.sin(endAngle - from), Math.cos(endAngle - from));
      chords.push({ end: total, length, x, y, dx, dy, startAngle: from, turn });
    }
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
      measureCubic([x, c[at], c[at + 2], c[at + 4]], [y, c[at + 1], c[at + 3], c[at + 5]], to);
      at += 6;
    } else {
      to(startX, startY);
    }
  }
  return total;
}

type Four = readonly [number, number, number, number];

function measureCubic(
  px: Four,
  py: Four,
  to: (x: number, y: number, startAngle?: number, endAngle?: number) => void,
): void {
  let before = tangent(px, py, 0);
  for (let k = 1; k <= STEPS; k++) {
    const t = k / STEPS;
    const after = tangent(px, py, t);
    to(cubicAt(...px, t), cubicAt(...py, t), before, after);
    before = after;
  }
}

/** Undefined where the derivative is zero, as at an end point that coincides with its control point. */
function tangent(px: Four, py: Four, t: number): number | undefined {
  const dx = slope(px, t);
  const dy = slope(py, t);
  return dx === 0 && dy === 0 ? undefined : Math.atan2(dy, dx);
}

function slope([p0, p1, p2, p3]: Four, t: number): number {
  const s = 1 - t;
  return s * s * (p1 - p0) + 2 * s * t * (p2 - p1) + t * t * (p3 - p2);
}
