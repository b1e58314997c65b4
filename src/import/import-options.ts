/** Options for reading a file of any format. */
import { checkNames, checkObject, refuseSetting } from "../check-arguments.js";
import { type TextFont, TEXT_MODES, type TextMode } from "./text/text-font.js";

/** How to read a file. Every option has a default. */
export interface ImportOptions {
  /** SVG: px per inch, also for numbers without a unit. Default: as the program that wrote the file, otherwise 96, as in CSS. */
  readonly pxPerInch?: number;
  /**
   * How text is drawn: in the built-in single-stroke letters (default), as outlines of `font`, or not at all.
   * Outlines without a font fall back to single strokes.
   */
  readonly text?: TextMode;
  /** The font for outlines, from `openOutlineFont`. */
  readonly font?: TextFont;
  /** The user's languages for SVG's `switch` and `systemLanguage`, preferred first. Default: English. */
  readonly languages?: readonly string[];
}

const NAMES = ["pxPerInch", "text", "font", "languages"];

/** @throws TypeError or PlotwrightError "bad-setting" for invalid options */
export function checkImportOptions(options: ImportOptions): void {
  const { text, font } = options;
  checkNames("import", options, NAMES);
  if (text !== undefined && !TEXT_MODES.includes(text))
    refuseSetting("import text", text, `one of ${TEXT_MODES.join(", ")}`);
  if (font !== undefined)
    checkObject("import", "the font", font, ["layout"], "what openOutlineFont returns, awaited");
}
