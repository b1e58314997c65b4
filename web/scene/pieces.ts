/** The line pieces that the preview draws, as bytes that workers transfer and renderers read. */
import type { Box } from "../../src/internal.js";

/**
 * f32 x0 y0 x1 y1 (mm), f32 t0 t1 (s), u16 value0 value1, u16 layer, u16 joints. The values at both ends are shares of the
 * colour ramp: of the top speed, unless the view mode shows something else.
 */
export const PIECE_BYTES = 32;
export const PIECE_FLOATS = 8;
export const PIECE_SHORTS = 16;
/** Index of the first u16 in a piece: value0, value1, layer, joints. */
export const VALUE_SHORT = 12;
export const LAYER_SHORT = 14;
/** How the stroke turns where the piece begins (low byte) and where it ends (high byte), as a `jointCode`. */
export const JOINT_SHORT = 15;

/** Steps of the tangent of half the turn. */
export const JOINT_STEP = 1e-3;

/** For a stroke that turns from direction a to b: 1 and the tangent of half the turn in steps. 0: by more than 28°, or it ends. */
export const jointCode = (ax: number, ay: number, bx: number, by: number): number => {
  const lengths = Math.sqrt((ax * ax + ay * ay) * (bx * bx + by * by));
  const tangent = Math.abs(ax * by - ay * bx) / (lengths + ax * bx + ay * by);
  const code = 1 + Math.ceil(tangent / JOINT_STEP);
  return lengths > 0 && code <= 255 ? code : 0;
};

/** A joint is flush if its pieces, cut off straight, differ from the line by less than this, device px. */
export const FLUSH_PX = 0.25;
/** Wider lines keep their round ends: what is drawn twice is only their edge. Half a width, device px. */
export const FLUSH_REACH_PX = 4;
/** Pieces overlap by this, px, so that rounding leaves no gap: more than the card's, and seldom a pixel's middle. */
export const OVERLAP_PX = 0.004;

/**
 * How far a piece is drawn beyond a joint, device px; null: to its round end. Where pieces that follow each other both cover
 * the smooth edge of a line, it looks thicker.
 */
export const beyondJoint = (code: number, reachPx: number): number | null => {
  const beyondPx = (code - 1) * JOINT_STEP * reachPx;
  const isFlush = code > 0 && beyondPx < FLUSH_PX && reachPx < FLUSH_REACH_PX;
  return isFlush ? 2 * beyondPx + OVERLAP_PX : null;
};

export interface Pieces {
  readonly count: number;
  readonly bytes: ArrayBuffer;
}

/** The box around the pieces `from` … `to` − 1. */
export const boxOfPieces = (floats: Float32Array, from: number, to: number): Box => {
  let [x0, y0, x1, y1] = [Infinity, Infinity, -Infinity, -Infinity];
  for (let f = from * PIECE_FLOATS; f < to * PIECE_FLOATS; f += PIECE_FLOATS) {
    x0 = Math.min(x0, floats[f], floats[f + 2]);
    x1 = Math.max(x1, floats[f], floats[f + 2]);
    y0 = Math.min(y0, floats[f + 1], floats[f + 3]);
    y1 = Math.max(y1, floats[f + 1], floats[f + 3]);
  }
  return { x0, y0, x1, y1 };
};
