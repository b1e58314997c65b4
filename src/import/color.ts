/**
 * Colours in hexadecimal. css-color.ts reads all others; it is imported only for files that have them, so culori must not
 * be used here.
 */

export interface Color {
  /** "#rrggbb", lower case. */
  readonly hex: string;
  /** 0 … 1 */
  readonly alpha: number;
}

/** The colour, or null if the text is not one (the caller handles `currentColor` and `none`). */
export type ColorParser = (text: string) => Color | null;

/** "#rgb", "#rgba", "#rrggbb" and "#rrggbbaa". */
export const parseHexColor: ColorParser = (text) => {
  const digits = /^\s*#([\da-f]{3,4}|[\da-f]{6}|[\da-f]{8})\s*$/i.exec(text)?.[1].toLowerCase();
  if (digits === undefined) return null;
  const all = digits.length <= 4 ? digits.replace(/./g, "$&$&") : digits;
  return { hex: `#${all.slice(0, 6)}`, alpha: all.length === 8 ? parseInt(all.slice(6), 16) / 255 : 1 };
};

/** The distance from white, in Oklab, below which a colour looks like paper: ivory, linen and #f0f0f0 do, #ebebeb does not. */
const NEAR_WHITE = 0.05;

export function isNearWhite(hex: string): boolean {
  const [red, green, blue] = [1, 3, 5].map((at) => linear(parseInt(hex.slice(at, at + 2), 16) / 255));
  // Oklab as its author, Björn Ottosson, defines it for linear sRGB.
  const long = Math.cbrt(0.4122214708 * red + 0.5363325363 * green + 0.0514459929 * blue);
  const medium = Math.cbrt(0.2119034982 * red + 0.6806995451 * green + 0.1073969566 * blue);
  const short = Math.cbrt(0.0883024619 * red + 0.2817188376 * green + 0.6299787005 * blue);
  const l = 0.2104542553 * long + 0.793617785 * medium - 0.0040720468 * short;
  const a = 1.9779984951 * long - 2.428592205 * medium + 0.4505937099 * short;
  const b = 0.0259040371 * long + 0.7827717662 * medium - 0.808675766 * short;
  return Math.hypot(1 - l, a, b) < NEAR_WHITE;
}

/** A channel of sRGB, 0 … 1, as an amount of light. */
const linear = (channel: number): number =>
  channel <= 0.04045 ? channel / 12.92 : ((channel + 0.055) / 1.055) ** 2.4;
