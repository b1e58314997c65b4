// Ambient declarations apply only where a program includes them, and this project has several programs.
// eslint-disable-next-line @typescript-eslint/triple-slash-reference
/// <reference path="../packages.d.ts" />
/** CSS colours to "#rrggbb" and an opacity. */
import "culori/css";
import { clampRgb, converter, formatHex, parse } from "culori/fn";
import { remembered } from "../get-or-add.js";

export interface Color {
  /** "#rrggbb", lower case. */
  readonly hex: string;
  /** 0 … 1 */
  readonly alpha: number;
}

const CACHE_LIMIT = 4096;
const toRgb = converter("rgb");
const toOklab = converter("oklab");

/** The distance from white, in Oklab, below which a colour looks like paper: ivory, linen and #f0f0f0 do, #ebebeb does not. */
const NEAR_WHITE = 0.05;

export function isNearWhite(hex: string): boolean {
  const color = toOklab(hex);
  return color !== undefined && Math.hypot(1 - color.l, color.a, color.b) < NEAR_WHITE;
}

/** The colour, or null if the text is not one (the caller handles `currentColor` and `none`). */
export const parseColor = remembered(CACHE_LIMIT, (text): Color | null => {
  try {
    const color = parse(text.trim().toLowerCase());
    return color ? { hex: formatHex(clampRgb(toRgb(color))), alpha: color.alpha ?? 1 } : null;
  } catch {
    // culori throws for a function whose list ends early, such as "color(".
    return null;
  }
});
