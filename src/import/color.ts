// Ambient declarations apply only where a program includes them, and this project has several programs.
// eslint-disable-next-line @typescript-eslint/triple-slash-reference
/// <reference path="./culori.d.ts" />
/** CSS colours to "#rrggbb" and an opacity. */
import "culori/css";
import { clampRgb, converter, formatHex, parse } from "culori/fn";

export interface Color {
  /** "#rrggbb", lower case. */
  readonly hex: string;
  /** 0 … 1 */
  readonly alpha: number;
}

const cache = new Map<string, Color | null>();
const CACHE_LIMIT = 4096;
const toRgb = converter("rgb");

/** The colour, or null if the text is not one (the caller handles `currentColor` and `none`). */
export function parseColor(text: string): Color | null {
  const known = cache.get(text);
  if (known !== undefined) return known;
  const color = parsed(text.trim().toLowerCase());
  if (cache.size >= CACHE_LIMIT) cache.clear();
  cache.set(text, color);
  return color;
}

function parsed(text: string): Color | null {
  try {
    const color = parse(text);
    return color ? { hex: formatHex(clampRgb(toRgb(color))), alpha: color.alpha ?? 1 } : null;
  } catch {
    // culori throws for a function whose list ends early, such as "color(".
    return null;
  }
}
