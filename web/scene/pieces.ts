/** The line pieces that the preview draws, as bytes that workers transfer and renderers read. */
import type { Box } from "../../src/internal.js";

/**
 * f32 x0 y0 x1 y1 (mm), f32 t0 t1 (s), u16 value0 value1, u16 layer, u16 spare. The values at both ends are shares of the
 * colour ramp: of the top speed, unless the view mode shows something else.
 */
export const PIECE_BYTES = 32;
export const PIECE_FLOATS = 8;
export const PIECE_SHORTS = 16;
/** Index of the first u16 in a piece: value0, value1, layer, spare. */
export const VALUE_SHORT = 12;
export const LAYER_SHORT = 14;

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
