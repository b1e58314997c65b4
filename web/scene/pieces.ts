/** The line pieces that the preview draws, as bytes that workers transfer and renderers read. */

/** f32 x0 y0 x1 y1 (mm), f32 t0 t1 (s), u16 speed0 speed1 (of the top speed), u16 layer, u16 spare. */
export const PIECE_BYTES = 32;
export const PIECE_FLOATS = 8;
export const PIECE_SHORTS = 16;
/** Index of the first u16 in a piece: speed0, speed1, layer, spare. */
export const SPEED_SHORT = 12;
export const LAYER_SHORT = 14;

export interface Pieces {
  readonly count: number;
  readonly bytes: ArrayBuffer;
}
