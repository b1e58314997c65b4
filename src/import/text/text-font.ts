/**
 * A source of letters: a font file's outlines or the built-in single strokes. Lengths in em, y down, baseline
 * at 0.
 */

/** One letter of a text that a font has laid out. */
export interface LaidOutGlyph {
  /** Path data with absolute commands; "" for a blank. */
  readonly path: string;
  /** The glyph's offset from the pen's position. */
  readonly x: number;
  readonly y: number;
  /** Distance to the next glyph. */
  readonly advance: number;
}

/** A source of letters. Lengths in em, y down, baseline at 0. */
export interface TextFont {
  /** Outlines are filled; single strokes are drawn as lines. */
  readonly kind: "outline" | "single-stroke";
  /** The glyphs of one line of text. `family` is the font family that the drawing asks for. */
  layout(
    text: string,
    style: { readonly family: string },
  ): {
    readonly glyphs: readonly LaidOutGlyph[];
    /** Characters without a glyph in the font. */
    readonly missing: readonly string[];
  };
}

/** Height of capitals in the built-in letters, and about that of all fonts. */
export const CAPITAL_EM = 0.7;
/** Approximate ascent of all fonts, and depth of a "g" below the baseline. */
export const ASCENT_EM = 0.9;
export const DESCENT_EM = 7 / 30;
