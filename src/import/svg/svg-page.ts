/** The page size, and the map from the root's user units to page mm. */
import type { Drawing } from "../../drawing/drawing.js";
import { PlotwrightError } from "../../errors.js";
import { scaling, type Affine } from "../../geometry/affine.js";
import { MM_PER_INCH, PX_PER_INCH } from "../../units.js";
import type { Declared } from "./properties.js";
import { absolutePx, splitLength } from "./length.js";
import { attribute, type SvgTree } from "./svg-tree.js";
import { parseViewBox, viewBoxMap } from "./svg-viewport.js";

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

/** Ten times the largest roll of paper; anything larger is a mistake. */
const MAX_PAGE_MM = 100_000;
/** CSS's default size of an image. */
const DEFAULT_WIDTH_PX = 300;
const DEFAULT_HEIGHT_PX = 150;

/** @param pxPerInch for px and numbers without unit: 96 by CSS, 72 or 90 in some programs */
export function pageOf(tree: SvgTree, root: Declared, pxPerInch: number): SvgPage {
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
