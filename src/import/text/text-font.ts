/** What draws letters: a font file's outlines or the built-in single strokes. Lengths in em, y down, baseline at 0. */

export interface LaidOutGlyph {
  /** Path data with absolute commands; "" for a blank. */
  readonly path: string;
  /** From the pen's place; the glyph's own shift. */
  readonly x: number;
  readonly y: number;
  /** To the next glyph. */
  readonly advance: number;
}

export interface TextFont {
  /** Outlines are filled; single strokes are drawn as lines. */
  readonly kind: "outline" | "single-stroke";
  layout(
    text: string,
    style: { readonly family: string },
  ): {
    readonly glyphs: readonly LaidOutGlyph[];
    /** Characters that the font has no glyph for. */
    readonly missing: readonly string[];
  };
}

/** Height of capitals, and how far a "g" reaches below the line: of the built-in letters, and about of all fonts. */
export const CAPITAL_EM = 0.7;
/** Height of the tallest letters, about, of all fonts. */
export const ASCENT_EM = 0.9;
export const DESCENT_EM = 7 / 30;
