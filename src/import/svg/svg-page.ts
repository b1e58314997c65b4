/** The page size, also of a file in px; and the map from the root's user units to page mm. */
import type { Drawing } from "../../drawing/drawing.js";
import { PlotwrightError } from "../../errors.js";
import { scaling, type Affine } from "../../geometry/affine.js";
import { MM_PER_INCH, PX_PER_INCH, MM_PER_PX, mmInWords } from "../../units.js";
import type { Declared } from "./css/properties.js";
import { absolutePx, splitLength } from "./css/length.js";
import { attribute, type SvgTree } from "./svg-tree.js";
import { parseViewBox, viewBoxMap } from "./svg-viewport.js";
import { papersInPx, otherPapers, PX_NOTE } from "../../drawing/px-size.js";
import type { Warnings } from "../warnings.js";

export interface SvgPage {
  readonly widthMm: number;
  readonly heightMm: number;
  readonly map: Affine;
  /** Size of the viewport in user units, for %. */
  readonly viewportWidth: number;
  readonly viewportHeight: number;
  /** How the page is known if the file does not define its size. "extent": the drawing's own extent will be the page. */
  readonly pageFrom?: NonNullable<Drawing["pageFrom"]>;
  /** The size of the page depends on the px per inch, and so does the size of everything on it. */
  readonly isInPx: boolean;
  /** The size of the drawing's units depends on the px per inch, perhaps on a page in other units. */
  readonly areUnitsPx: boolean;
}

/** A page, and the px per inch it was read with. */
export interface SizedPage {
  readonly page: SvgPage;
  readonly pxPerInch: number;
}

/** Ten times the largest roll of paper; anything larger is a mistake. */
const MAX_PAGE_MM = 100_000;
/** CSS's default size of an image. */
const DEFAULT_WIDTH_PX = 300;
const DEFAULT_HEIGHT_PX = 150;

/** @param pxPerInch for px and numbers without unit: 96 by CSS, 72 or 90 in some programs */
function pageOf(tree: SvgTree, root: Declared, pxPerInch: number): SvgPage {
  if (!(pxPerInch > 0 && Number.isFinite(pxPerInch))) {
    throw new RangeError(`importSvg: pxPerInch must be > 0, got ${pxPerInch}`);
  }
  const mmPerPx = MM_PER_INCH / pxPerInch;
  const box = parseViewBox(attribute(tree, 0, "viewBox"));
  // CSS applies before the attributes.
  const width = firstMm([root.get("width"), attribute(tree, 0, "width")], mmPerPx);
  const height = firstMm([root.get("height"), attribute(tree, 0, "height")], mmPerPx);
  const isInPx = (width?.isInPx ?? true) && (height?.isInPx ?? true);
  if (box === null) {
    const widthMm = checked(width?.mm ?? DEFAULT_WIDTH_PX * mmPerPx, "wide");
    const heightMm = checked(height?.mm ?? DEFAULT_HEIGHT_PX * mmPerPx, "high");
    return {
      widthMm,
      heightMm,
      map: scaling(mmPerPx),
      viewportWidth: widthMm / mmPerPx,
      viewportHeight: heightMm / mmPerPx,
      isInPx,
      areUnitsPx: true,
      ...(width === null || height === null ? { pageFrom: "extent" } : {}),
    };
  }
  const ratio = box.width / box.height;
  const widthMm = checked(width?.mm ?? (height === null ? box.width * mmPerPx : height.mm * ratio), "wide");
  const heightMm = checked(height?.mm ?? (width === null ? box.height * mmPerPx : width.mm / ratio), "high");
  return {
    widthMm,
    heightMm,
    map: viewBoxMap(box, widthMm, heightMm, attribute(tree, 0, "preserveAspectRatio")),
    viewportWidth: box.width,
    viewportHeight: box.height,
    isInPx,
    areUnitsPx: isInPx,
    // A browser gives such a drawing the size of its window.
    ...(width === null && height === null ? { pageFrom: "proportions" } : {}),
  };
}

/** The page with the px per inch of the program that wrote the file, if it is known, otherwise CSS's. */
export function guessedPage(text: string, tree: SvgTree, root: Declared, warnings: Warnings): SizedPage {
  const usual = pageOf(tree, root, PX_PER_INCH);
  const { isInPx, pageFrom, widthMm, heightMm } = usual;
  const isPagePx = isInPx && pageFrom !== "extent";
  const pagePx = isPagePx ? { width: widthMm / MM_PER_PX, height: heightMm / MM_PER_PX } : null;
  const guess = usual.areUnitsPx ? guessPxPerInch(text, pagePx) : null;
  const guessed = guess?.pxPerInch ?? null;
  const sized = guessed === null ? { page: usual, pxPerInch: PX_PER_INCH } : sizedPage(tree, root, guessed);
  notePx(sized, guess, warnings);
  return sized;
}

/** With the given px per inch, a viewBox tells the size of the page too. */
export function sizedPage(tree: SvgTree, root: Declared, pxPerInch: number): SizedPage {
  const { pageFrom, ...page } = pageOf(tree, root, pxPerInch);
  return { page: pageFrom === "extent" ? { ...page, pageFrom } : page, pxPerInch };
}

/** Says which px per inch were guessed, and which would make the page a paper. */
function notePx({ page, pxPerInch }: SizedPage, guess: PxGuess | null, warnings: Warnings): void {
  const others = page.isInPx ? otherPapers({ ...page, pxPerInch }) : [];
  if (guess === null && others.length === 0) return;
  const { pageFrom, widthMm, heightMm } = page;
  const size = pageFrom === undefined ? `${mmInWords(widthMm)} × ${mmInWords(heightMm)} mm at ` : "";
  const details = [
    pageFrom === "proportions" ? "only its proportions are known" : `${size}${pxPerInch} px per inch`,
    ...(guess === null ? [] : [`written by ${guess.program}`]),
    ...others.map(({ name, pxPerInch: other }) => `--px-per-inch ${other} gives ${name}`),
  ];
  warnings.add(PX_NOTE, undefined, details.join("; "));
}

interface Side {
  readonly mm: number;
  readonly isInPx: boolean;
}

const PIXEL_UNITS = new Set(["", "px"]);

/** mm of the first absolute length > 0; percentages and `auto` leave the size to the viewBox. */
function firstMm(candidates: readonly (string | undefined)[], mmPerPx: number): Side | null {
  for (const text of candidates) {
    if (text === undefined) continue;
    const parts = splitLength(text);
    const px = absolutePx(text);
    if (parts === null || px === null || !(px > 0)) continue;
    const isInPx = PIXEL_UNITS.has(parts.unit);
    return { mm: tidy(px * (isInPx ? mmPerPx : MM_PER_INCH / PX_PER_INCH)), isInPx };
  }
  return null;
}

/** Removes the rounding error of unit conversion in the sixteenth digit: 210mm is 210. */
const tidy = (mm: number): number => {
  const rounded = Math.round(mm * 1e6) / 1e6;
  return Math.abs(rounded - mm) < 1e-12 * mm ? rounded : mm;
};

function checked(mm: number, what: string): number {
  if (mm > 0 && mm <= MAX_PAGE_MM) return mm;
  throw new PlotwrightError(
    "bad-file",
    `The page of this SVG is ${mm.toPrecision(3)} mm ${what}. Set the page size in your drawing program (at most ${MAX_PAGE_MM} mm) and export it again.`,
  );
}

/** How many px per inch a program means that does not write 96, as in CSS. */
interface PxGuess {
  readonly program: string;
  /** Null: the program writes any number, and the page tells nothing. */
  readonly pxPerInch: number | null;
}

/** Programs name themselves in comments before or just behind the begin of the root element, or in its attributes. */
const HEAD_CHARS = 16_384;
const HEAD = /^[^]*?<(?:\w+:)?svg\b[^>]*>(?:\s|<!--[^]*?-->)*/;
const INKSCAPE = /\sinkscape:version\s*=\s*["'](\d+)\.(\d+)/;
const SODIPODI = /\ssodipodi:version\s*=/;
/** Without the comment and the namespace, its root element has a `data-name`. */
const ILLUSTRATOR =
  /Generator: Adobe Illustrator|\sxmlns:i\s*=\s*["'](?:&ns_ai;|https?:\/\/ns\.adobe\.com\/AdobeIllustrator)|\sdata-name=/;
/** Or its layers have their names as `data-name`, and the root element has the id of one. */
const LAYER_ID = /\sid="[^"]*_\d+"/;
const LAYER_NAME = /<g\s[^>]*\sdata-name="/;
const AFFINITY = /\sxmlns:serif\s*=\s*["']https?:\/\/www\.serif\.com/;

/** Null if the program is not known, or writes 96. `pagePx`: null if the file does not define its page in px. */
function guessPxPerInch(
  text: string,
  pagePx: { readonly width: number; readonly height: number } | null,
): PxGuess | null {
  const begin = text.slice(0, HEAD_CHARS);
  const head = HEAD.exec(begin)?.[0] ?? "";
  // Inkscape keeps the other programs' marks when it writes their files again.
  const inkscape = INKSCAPE.exec(head);
  if (inkscape !== null) {
    const [major, minor] = inkscape.slice(1).map(Number);
    return major === 0 && minor < 92 ? { program: "Inkscape before 0.92", pxPerInch: 90 } : null;
  }
  if (SODIPODI.test(head)) return { program: "Sodipodi", pxPerInch: 90 };
  if (ILLUSTRATOR.test(head) || (LAYER_ID.test(head) && LAYER_NAME.test(begin)))
    return { program: "Adobe Illustrator", pxPerInch: 72 };
  if (!AFFINITY.test(head)) return null;
  // Affinity's px are those of its document, which may have any number per inch.
  const [paper] = pagePx === null ? [] : papersInPx(pagePx.width, pagePx.height);
  return { program: "Affinity", pxPerInch: paper?.pxPerInch ?? null };
}
