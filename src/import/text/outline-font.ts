// Ambient declarations apply only where a program includes them, and this project has several programs.
// eslint-disable-next-line @typescript-eslint/triple-slash-reference
/// <reference path="../../packages.d.ts" />
/** Letters as outlines of a font file: TrueType, OpenType, WOFF, WOFF2, or the first font of a collection. */
import type { Font } from "fontkit";
import { PlotwrightError } from "../../errors.js";
import {
  USUAL_METRICS,
  type FontFace,
  type FontMetrics,
  type LaidOutGlyph,
  type LetterStyle,
  type TextFont,
} from "./text-font.js";

const LETTER_OF_COMMAND: Readonly<Record<string, string>> = {
  moveTo: "M",
  lineTo: "L",
  quadraticCurveTo: "Q",
  bezierCurveTo: "C",
  closePath: "Z",
};
const NOT_DEFINED = 0;
const USUAL_WEIGHT = 400;
const BOLD_WEIGHT = 600;

/**
 * Opens a font file (TrueType, OpenType, WOFF), for `ImportOptions.font`. The font library is loaded by the first call,
 * because loading takes as long as importing thousands of lines.
 *
 * @throws PlotwrightError "bad-file" if the bytes are not a font, "bad-setting" if the package fontkit is not installed
 */
export async function openOutlineFont(bytes: Uint8Array): Promise<TextFont> {
  const { create } = await fontLibrary();
  return readable(() => {
    const opened = create(bytes);
    const font = "fonts" in opened ? opened.fonts[0] : opened;
    // Broken tables cause errors only when used.
    font.layout("A");
    return {
      kind: "outline",
      metrics: metricsOf(font),
      face: faceOf(font),
      hasSmallCaps: font.availableFeatures.includes("smcp"),
      // A damaged letter is found only when a text uses it.
      layout: (text, style) => readable(() => layOut(font, text, style)),
    };
  });
}

/** Missing where only `plotwright-plan` is installed. */
async function fontLibrary(): Promise<typeof import("fontkit")> {
  try {
    return await import("fontkit");
  } catch (cause) {
    if ((cause as { readonly code?: unknown }).code !== "ERR_MODULE_NOT_FOUND") throw cause;
    throw new PlotwrightError("bad-setting", "A font file needs the package fontkit: npm install fontkit.", {
      cause,
    });
  }
}

/** What `read` returns; whatever the font library throws about damaged bytes becomes "bad-file". */
function readable<T>(read: () => T): T {
  try {
    return read();
  } catch (cause) {
    const why = cause instanceof Error ? cause.message : String(cause);
    throw new PlotwrightError(
      "bad-file",
      `This file cannot be read as a font (${why}). Choose a ttf, otf or woff file.`,
      { cause },
    );
  }
}

function faceOf(font: Font): FontFace | undefined {
  if (font.familyName === null) return undefined;
  const weight = font["OS/2"]?.usWeightClass ?? USUAL_WEIGHT;
  return { family: font.familyName, isBold: weight >= BOLD_WEIGHT, isItalic: font.italicAngle !== 0 };
}

/** A font may lack tables or have zeros in them: then the usual values apply. */
function metricsOf(font: Font): FontMetrics {
  const em = (units: number | undefined, usual: number): number =>
    units === undefined || !Number.isFinite(units) || units === 0 ? usual : units / font.unitsPerEm;
  const xHeight = em(font.xHeight, USUAL_METRICS.xHeight);
  return {
    ascent: em(font.ascent, USUAL_METRICS.ascent),
    descent: em(-font.descent, USUAL_METRICS.descent),
    xHeight,
    subscript: em(font["OS/2"]?.ySubscriptYOffset, USUAL_METRICS.subscript),
    superscript: em(font["OS/2"]?.ySuperscriptYOffset, USUAL_METRICS.superscript),
    underline: em(font.underlinePosition, USUAL_METRICS.underline),
    strikeout: em(font["OS/2"]?.yStrikeoutPosition, xHeight / 2),
    lineThickness: em(font.underlineThickness, USUAL_METRICS.lineThickness),
  };
}

/** Stacked combining marks in canonical order, as the font's tables expect them. */
function orderedMarks(text: string): string {
  return text.replace(/\p{M}{2,}/gu, (marks) => {
    const ordered = marks.normalize("NFD");
    // One mark may become two, which would move the characters after it.
    return ordered.length === marks.length ? ordered : marks;
  });
}

function layOut(font: Font, text: string, style: LetterStyle): ReturnType<TextFont["layout"]> {
  const ordered = orderedMarks(text);
  const chars = [...ordered];
  const run = font.layout(ordered, {
    ...(style.hasLigatures === false ? { liga: false, clig: false } : {}),
    ...(style.hasKerning === false ? { kern: false } : {}),
    ...(style.isSmallCaps === true ? { smcp: true } : {}),
  });
  let next = 0;
  const em = 1 / font.unitsPerEm;
  const missing: string[] = [];
  const glyphs = run.glyphs.map((glyph, i): LaidOutGlyph => {
    const at = next;
    next += glyph.codePoints.length;
    const { xAdvance, xOffset, yOffset } = run.positions[i];
    if (glyph.id === NOT_DEFINED) {
      // The glyph itself names the first character that was missing in this font.
      missing.push(chars[at] ?? "");
      return { path: "", x: 0, y: 0, advance: xAdvance * em, at };
    }
    const path = glyph.path.commands
      .map(
        ({ command, args }) =>
          LETTER_OF_COMMAND[command] + args.map((v, k) => (k % 2 === 0 ? v : -v) * em).join(" "),
      )
      .join("");
    return { path, x: xOffset * em, y: -yOffset * em, advance: xAdvance * em, at };
  });
  return { glyphs, missing };
}
