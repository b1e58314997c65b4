/**
 * One shape under construction: verbs and coordinates as in `DrawingPaths`, in the units of the caller.
 *
 * Invariants: every subpath begins with VERB_MOVE and has at least one more verb; a lone move is removed when
 * the next one begins. A dot is a move and a line to the same point.
 */
import { curveBoxOf } from "../drawing/curve-box.js";
import { PAIRS_OF_VERB, VERB_CLOSE, VERB_CUBIC, VERB_LINE, VERB_MOVE } from "../drawing/drawing.js";
import { applyX, applyY, IDENTITY, type Affine } from "../geometry/affine.js";
import type { Box } from "../geometry/box.js";
import { ColumnBuffer, PointBuffer } from "../geometry/growable.js";

export class ShapeBuffer {
  readonly verbs = new ColumnBuffer(Uint8Array, 256);
  readonly coords = new PointBuffer(256);
  /** The pen's position, and the start of the open subpath. */
  x = 0;
  y = 0;
  startX = 0;
  startY = 0;
  /** Verbs that end between the pieces of an arc: these points are not vertices of the original path. */
  readonly innerVerbs: number[] = [];
  /** Closes that were closed again: each repetition draws nothing, but is a vertex for markers. */
  readonly closedAgain: number[] = [];
  /** The number of subpaths with a lone move, which draw nothing. */
  lonePoints = 0;

  clear(): void {
    this.verbs.length = 0;
    this.coords.length = 0;
    this.innerVerbs.length = 0;
    this.closedAgain.length = 0;
    this.lonePoints = 0;
    this.x = this.y = this.startX = this.startY = 0;
  }

  get isEmpty(): boolean {
    return this.verbs.length === 0;
  }

  moveTo(x: number, y: number): void {
    this.finish();
    this.verbs.push(VERB_MOVE);
    this.coords.push(x, y);
    this.x = this.startX = x;
    this.y = this.startY = y;
  }

  lineTo(x: number, y: number): void {
    this.reopen();
    this.verbs.push(VERB_LINE);
    this.coords.push(x, y);
    this.x = x;
    this.y = y;
  }

  cubicTo(x1: number, y1: number, x2: number, y2: number, x: number, y: number): void {
    this.reopen();
    this.verbs.push(VERB_CUBIC);
    this.coords.push(x1, y1);
    this.coords.push(x2, y2);
    this.coords.push(x, y);
    this.x = x;
    this.y = y;
  }

  /** The curve as a cubic, exactly. */
  quadraticTo(qx: number, qy: number, x: number, y: number): void {
    const x0 = this.x;
    const y0 = this.y;
    this.cubicTo(
      x0 + (2 / 3) * (qx - x0),
      y0 + (2 / 3) * (qy - y0),
      x + (2 / 3) * (qx - x),
      y + (2 / 3) * (qy - y),
      x,
      y,
    );
  }

  close(): void {
    const verbs = this.verbs;
    if (verbs.length === 0) return;
    const last = verbs.data[verbs.length - 1];
    if (last === VERB_CLOSE) {
      this.closedAgain.push(verbs.length - 1);
      return;
    }
    if (last === VERB_MOVE) this.lineTo(this.startX, this.startY);
    verbs.push(VERB_CLOSE);
    this.x = this.startX;
    this.y = this.startY;
  }

  /** A closed rectangle from one corner to the opposite one. */
  rectangle(x0: number, y0: number, x1: number, y1: number): void {
    this.moveTo(x0, y0);
    this.lineTo(x1, y0);
    this.lineTo(x1, y1);
    this.lineTo(x0, y1);
    this.close();
  }

  /** Appends another, finished shape with its points mapped. */
  append({ verbs, coords }: ShapeBuffer, map: Affine): void {
    this.finish();
    for (let i = 0, at = 0; i < verbs.length; i++) {
      const verb = verbs.data[i];
      this.verbs.push(verb);
      for (const end = at + 2 * PAIRS_OF_VERB[verb]; at < end; at += 2) {
        this.x = applyX(map, coords.data[at], coords.data[at + 1]);
        this.y = applyY(map, coords.data[at], coords.data[at + 1]);
        this.coords.push(this.x, this.y);
      }
      if (verb === VERB_MOVE) {
        this.startX = this.x;
        this.startY = this.y;
      } else if (verb === VERB_CLOSE) {
        this.x = this.startX;
        this.y = this.startY;
      }
    }
  }

  /** Call when the shape is complete: removes a lone move at its end. */
  finish(): void {
    const verbs = this.verbs;
    if (verbs.length === 0 || verbs.data[verbs.length - 1] !== VERB_MOVE) return;
    verbs.length--;
    this.coords.length -= 2;
    this.lonePoints++;
  }

  /** After a close the next segment starts a new subpath at the same start. */
  private reopen(): void {
    const verbs = this.verbs;
    if (verbs.length > 0 && verbs.data[verbs.length - 1] === VERB_CLOSE) {
      verbs.push(VERB_MOVE);
      this.coords.push(this.startX, this.startY);
    }
  }
}

/** The box of a finished shape's curves, not of their control points. */
export const curveBox = ({ verbs, coords }: ShapeBuffer): Box =>
  curveBoxOf({ verbs: verbs.view(), coords: coords.data }, IDENTITY);
