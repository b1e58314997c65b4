/** Colours as bytes, for the renderers. */
import { parseHex } from "culori/fn";
import { rampColor } from "../../src/internal.js";

export const RAMP_SIZE = 256;

/** The colour ramp as RAMP_SIZE × 4 bytes, RGBA. */
export const rampBytes = (): Uint8Array => {
  const bytes = new Uint8Array(RAMP_SIZE * 4);
  for (let i = 0; i < RAMP_SIZE; i++)
    bytes.set([...bytesFromHex(rampColor(i / (RAMP_SIZE - 1))), 255], i * 4);
  return bytes;
};

/** From "#rrggbb". */
export const bytesFromHex = (hex: string): [number, number, number] => {
  const { r, g, b } = parseHex(hex) ?? { r: 0, g: 0, b: 0 };
  return [Math.round(255 * r), Math.round(255 * g), Math.round(255 * b)];
};
