/** The size of a drawing whose page is given in px. How large a px is depends on the program that wrote the file. */
import { MM_PER_INCH } from "../units.js";
import type { DashPattern, Drawing } from "./drawing.js";
import { PAPER_SIZES, type PaperName } from "./paper.js";

/** The px per inch that drawing programs use, the most frequent first. */
const USUAL_PX_PER_INCH = [96, 72, 300, 90, 150, 600] as const;

/** Programs round pages to whole px. */
const ROUNDING_PX = 1.5;

export interface PaperInPx {
  readonly name: PaperName;
  readonly pxPerInch: number;
}

/** The papers that a page in px is, in either orientation, at a usual number of px per inch. */
export function papersInPx(widthPx: number, heightPx: number): PaperInPx[] {
  const long = Math.max(widthPx, heightPx);
  const short = Math.min(widthPx, heightPx);
  const names = Object.keys(PAPER_SIZES) as PaperName[];
  return USUAL_PX_PER_INCH.flatMap((pxPerInch) => {
    const isSide = (mm: number, px: number): boolean =>
      Math.abs((mm / MM_PER_INCH) * pxPerInch - px) < ROUNDING_PX;
    return names
      .filter((name) => isSide(PAPER_SIZES[name].widthMm, short) && isSide(PAPER_SIZES[name].heightMm, long))
      .map((name) => ({ name, pxPerInch }));
  });
}

/** The papers that the page would be with another number of px per inch. None if it is a paper as it was read. */
export function otherPapers({
  widthMm,
  heightMm,
  pxPerInch,
  pageFrom,
}: Pick<Drawing, "widthMm" | "heightMm" | "pxPerInch" | "pageFrom">): PaperInPx[] {
  if (pxPerInch === undefined || pageFrom === "extent") return [];
  const pxPerMm = pxPerInch / MM_PER_INCH;
  const papers = papersInPx(widthMm * pxPerMm, heightMm * pxPerMm);
  const isPaper = pageFrom === undefined && papers.some((paper) => paper.pxPerInch === pxPerInch);
  return isPaper ? [] : papers;
}

/** The note about `pxPerInch`, which the user's own choice makes obsolete. */
export const PX_NOTE = "px-per-inch";

/**
 * The drawing with its px of the size that the user has chosen; unchanged for "auto", and if its page is not given in px.
 */
export function withPxPerInch(drawing: Drawing, pxPerInch: number | "auto"): Drawing {
  if (pxPerInch === "auto" || drawing.pxPerInch === undefined) return drawing;
  const factor = drawing.pxPerInch / pxPerInch;
  const { pageFrom, paths, ...rest } = drawing;
  const scaled = <T extends Float32Array | Float64Array>(lengths: T): T =>
    factor === 1 ? lengths : (lengths.map((mm) => mm * factor) as T);
  return {
    ...rest,
    ...(pageFrom === "extent" ? { pageFrom } : {}),
    pxPerInch,
    widthMm: drawing.widthMm * factor,
    heightMm: drawing.heightMm * factor,
    dashes: drawing.dashes.map((dash) => scaledDash(dash, factor)),
    clips: drawing.clips.map((clip) => ({ ...clip, coords: scaled(clip.coords) })),
    paths: {
      ...paths,
      coords: scaled(paths.coords),
      strokeWidth: scaled(paths.strokeWidth),
    },
    warnings: drawing.warnings
      .filter(({ code }) => code !== PX_NOTE)
      .map((warning) => ({
        ...warning,
        boxes: warning.boxes.map(
          ([x0, y0, x1, y1]) => [x0 * factor, y0 * factor, x1 * factor, y1 * factor] as const,
        ),
      })),
  };
}

/** A stretched pattern keeps its lengths: they are compared with measured lengths. */
const scaledDash = ({ lengths, offset, measure }: DashPattern, factor: number): DashPattern =>
  measure === undefined
    ? { lengths: lengths.map((mm) => mm * factor), offset: offset * factor }
    : {
        lengths,
        offset,
        measure: {
          a: measure.a / factor,
          b: measure.b / factor,
          c: measure.c / factor,
          d: measure.d / factor,
        },
      };
