/** mm, portrait: width ≤ height. */
export interface PaperSize {
  readonly widthMm: number;
  readonly heightMm: number;
}

/** The common papers in mm, portrait. ISO 216; the American sizes are from ANSI/ASME Y14.1. */
export const PAPER_SIZES = {
  A1: { widthMm: 594, heightMm: 841 },
  A2: { widthMm: 420, heightMm: 594 },
  A3: { widthMm: 297, heightMm: 420 },
  A4: { widthMm: 210, heightMm: 297 },
  A5: { widthMm: 148, heightMm: 210 },
  A6: { widthMm: 105, heightMm: 148 },
  Letter: { widthMm: 215.9, heightMm: 279.4 },
  Legal: { widthMm: 215.9, heightMm: 355.6 },
  Tabloid: { widthMm: 279.4, heightMm: 431.8 },
  "9x12in": { widthMm: 228.6, heightMm: 304.8 },
  "12x16in": { widthMm: 304.8, heightMm: 406.4 },
} as const satisfies Record<string, PaperSize>;

export type PaperName = keyof typeof PAPER_SIZES;
