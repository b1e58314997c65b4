// Ambient declarations apply only where a program includes them, and this project has several programs.
// eslint-disable-next-line @typescript-eslint/triple-slash-reference
/// <reference path="../packages.d.ts" />
/** All colours of CSS. */
import "culori/css";
import { clampRgb, converter, formatHex, parse } from "culori/fn";
import { remembered } from "../get-or-add.js";
import type { ColorParser } from "./color.js";

const CACHE_LIMIT = 4096;
const toRgb = converter("rgb");

export const parseCssColor: ColorParser = remembered(CACHE_LIMIT, (text) => {
  try {
    const color = parse(text.trim().toLowerCase());
    return color ? { hex: formatHex(clampRgb(toRgb(color))), alpha: color.alpha ?? 1 } : null;
  } catch {
    // culori throws for a function whose list ends early, such as "color(".
    return null;
  }
});
