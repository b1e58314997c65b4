/** What the caller may say about how a file is to be read, whatever its format. */
import { singleStrokeFont } from "./text/single-stroke-font.js";
import type { TextFont } from "./text/text-font.js";

export const TEXT_MODES = ["single-stroke", "outline", "none"] as const;
export type TextMode = (typeof TEXT_MODES)[number];

export interface ImportOptions {
  /** SVG: what a px, and a number without unit, is worth: 96 by CSS; 72 or 90 in files of some programs. */
  readonly pxPerInch?: number;
  /**
   * How text is drawn: in the built-in single-stroke letters (default), as outlines of `font`,
   * or not at all. Outlines without a font fall back to single strokes.
   */
  readonly text?: TextMode;
  /** From `openOutlineFont`, for outlines. */
  readonly font?: TextFont;
  /** For SVG's `switch` and `systemLanguage`, best first. Default: English. */
  readonly languages?: readonly string[];
}

/** What draws the text; null for none. */
export const fontOf = ({ text = "single-stroke", font }: ImportOptions): TextFont | null =>
  text === "none" ? null : text === "outline" && font !== undefined ? font : singleStrokeFont;
