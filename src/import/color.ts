// Ambient declarations apply only where a program includes them, and this project has several programs.
// eslint-disable-next-line @typescript-eslint/triple-slash-reference
/// <reference path="./culori.d.ts" />
/** CSS colours to "#rrggbb" and an opacity. */
import "culori/css";
import { clampRgb, converter, formatHex, parse } from "culori/fn";
import { remembered } from "./get-or-add.js";

export interface Color {
  /** "#rrggbb", lower case. */
  readonly hex: string;
  /** 0 … 1 */
  readonly alpha: number;
}

const CACHE_LIMIT = 4096;
const toRgb = converter("rgb");

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
