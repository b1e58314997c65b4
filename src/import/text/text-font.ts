/**
 * Sources of letters (a font file's outlines, or the built-in single strokes), and lines of text laid out with them. All
 * formats lay out text with this, and draw it with their own map. Lengths in em, y down, baseline at 0.
 */
import { compose, translation, type Affine } from "../../geometry/affine.js";
import { drawPathData } from "../path-data.js";
import { ShapeBuffer } from "../shape-buffer.js";

export const TEXT_MODES = ["single-stroke", "outline", "none"] as const;
/** How the text of a drawing is drawn. */
export type TextMode = (typeof TEXT_MODES)[number];

/** One letter of a text that a font has laid out. */
export interface LaidOutGlyph {
  /** Path data with absolute commands; "" for a blank. */
  readonly path: string;
  /** The glyph's offset from the pen's position. */
  readonly x: number;
  readonly y: number;
  /** Distance to the next glyph. */
  readonly advance: number;
  /** Index of its first character in the text, counted in code points. Default: the glyph's own index. */
  readonly at?: number;
}

/** Options for shaping letters. */
export interface LetterStyle {
  readonly family: string;
  /** False if letters are placed one by one. Default: true. */
  readonly hasLigatures?: boolean;
  /** Whether pairs of letters are moved together or apart. Default: true. */
  readonly hasKerning?: boolean;
  /** Only for fonts with `hasSmallCaps`. Default: false. */
  readonly isSmallCaps?: boolean;
}

/** Heights of a font, in em. Those above the baseline are positive, except `descent`, which is below it. */
export interface FontMetrics {
  readonly ascent: number;
  readonly descent: number;
  readonly xHeight: number;
  /** For `baseline-shift`: how far a subscript goes down and a superscript up. */
  readonly subscript: number;
  readonly superscript: number;
  /** The middles of the lines of text decoration, and their thickness. */
  readonly underline: number;
  readonly strikeout: number;
  readonly lineThickness: number;
}

/** Which font of a family it is. */
export interface FontFace {
  readonly family: string;
  readonly isBold: boolean;
  readonly isItalic: boolean;
}

/** A source of letters. Lengths in em, y down, baseline at 0. */
export interface TextFont {
  /** Outlines are filled; single strokes are drawn as lines. */
  readonly kind: "outline" | "single-stroke";
  /** If given, text that asks for another face is reported. */
  readonly face?: FontFace | undefined;
  /** Default: those of a usual font. */
  readonly metrics?: FontMetrics;
  /** Whether the font has small capitals; if not, they are made from its capitals. */
  readonly hasSmallCaps?: boolean;
  /** The glyphs of one line of text. `family` is the font family that the drawing asks for. */
  layout(
    text: string,
    style: LetterStyle,
  ): {
    readonly glyphs: readonly LaidOutGlyph[];
    /** Characters without a glyph in the font. */
    readonly missing: readonly string[];
  };
}

/** Height of capitals in the built-in letters, and about that of all fonts. */
export const CAPITAL_EM = 0.7;
/** Approximate depth of a "g" below the baseline, of all fonts. */
export const DESCENT_EM = 7 / 30;

/** Metrics of usual browser fonts, for fonts without their own. */
export const USUAL_METRICS: FontMetrics = {
  ascent: 0.9,
  descent: 0.21,
  xHeight: 0.46,
  // From CSS Inline Layout 3, §4.2, for fonts without values.
  subscript: 1 / 5,
  superscript: 1 / 3,
  underline: -0.12,
  strikeout: 0.23,
  lineThickness: 0.06,
};

interface LineLetter {
  /** Path data; "" for a blank. */
  readonly path: string;
  /** Pen position before the letter. */
  readonly pen: number;
  /** Distance to the next letter's pen position. */
  readonly advance: number;
  /** Position of the letter's path. */
  readonly x: number;
  readonly y: number;
  /** Index of its first character in the line, counted in code points. */
  readonly at: number;
}

/** One line of text laid out along its baseline; the first letter's pen position is at 0, 0. */
export interface TextLine {
  readonly letters: readonly LineLetter[];
  readonly width: number;
  /** Characters that are missing in the font. */
  readonly missing: readonly string[];
}

export function layOutLine(font: TextFont, text: string, style: LetterStyle): TextLine {
  const { glyphs, missing } = font.layout(text, style);
  let pen = 0;
  const letters = glyphs.map(({ path, x, y, advance, at }, i): LineLetter => {
    const letter = { path, pen, advance, x: pen + x, y, at: at ?? i };
    pen += advance;
    return letter;
  });
  return { letters, width: pen, missing };
}

const one = new ShapeBuffer();

/** Adds the line's letters to `shape`; `map` takes em to the shape's units. */
export function drawLine({ letters }: TextLine, map: Affine, shape: ShapeBuffer): void {
  for (const { path, x, y } of letters) {
    if (path === "") continue;
    one.clear();
    drawPathData(one, path, 1);
    one.finish();
    shape.append(one, compose(map, translation(x, y)));
  }
}
