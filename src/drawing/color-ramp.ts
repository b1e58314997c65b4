/**
 * Colours for numbers and for lists: in OKLCH, the polar form of Björn Ottosson's OKLab. There, equal differences of a
 * coordinate look equally different.
 */
// The single conversions: with the colour spaces' records culori's parsers would be loaded with the page.
import { convertLchToLab, convertOklabToRgb, serializeHex } from "culori/fn";

const DARKEST = 0.25;
const LIGHTEST = 0.725;
const CHROMA = 0.16;
const FIRST_HUE_DEG = 268;
const LAST_HUE_DEG = 425;

/**
 * "#rrggbb" for a share of a scale, 0 … 1. Lightness and hue increase evenly. So the order is visible in grey too, and
 * even the lightest colour is dark enough for a thin line on white paper. All of these colours are in sRGB.
 *
 *   share 0  deep indigo (slow, first)  …  magenta  …  orange (fast, last)  share 1
 */
export function rampColor(share: number): string {
  const at = Math.min(1, Math.max(0, share));
  return oklchHex(
    DARKEST + (LIGHTEST - DARKEST) * at,
    CHROMA,
    FIRST_HUE_DEG + (LAST_HUE_DEG - FIRST_HUE_DEG) * at,
  );
}

/** One of many colours that are easy to tell apart, for what has no colour of its own. */
export function listColor(index: number): string {
  // The golden angle: no hue comes close to an earlier one soon.
  return oklchHex(0.55, 0.15, 255 + index * 137.508);
}

function oklchHex(lightness: number, chroma: number, hueDeg: number): string {
  return serializeHex(convertOklabToRgb(convertLchToLab({ l: lightness, c: chroma, h: hueDeg }, "oklab")));
}
