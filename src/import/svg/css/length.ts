/** CSS and SVG lengths to user units (CSS px). */
import type { Box } from "../../../geometry/box.js";
import { MM_PER_INCH, MM_PER_PX } from "../../../units.js";

/** What relative units are relative to. */
export interface LengthBasis {
  /** px */
  readonly fontSize: number;
  /** Size of the nearest viewport in user units, for %. */
  readonly viewportWidth: number;
  readonly viewportHeight: number;
  /** px, for `rem`. */
  readonly rootFontSize: number;
}

/** The basis for lengths whose percentages refer to a box. */
export const basisOfBox = (basis: LengthBasis, { x0, y0, x1, y1 }: Box): LengthBasis => ({
  ...basis,
  viewportWidth: x1 - x0,
  viewportHeight: y1 - y0,
});

/** The side of the viewport that a percentage refers to; "both" is the diagonal / √2, for radii and widths. */
export type Side = "width" | "height" | "both";

const NUMBER_AND_UNIT = /^\s*([+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?)\s*([a-zA-Z]*|%)\s*$/;

const PX_PER_MM = 1 / MM_PER_PX;
const ABSOLUTE: ReadonlyMap<string, number> = new Map([
  ["", 1],
  ["px", 1],
  ["mm", PX_PER_MM],
  ["cm", 10 * PX_PER_MM],
  ["q", PX_PER_MM / 4],
  ["in", MM_PER_INCH * PX_PER_MM],
  ["pt", (MM_PER_INCH * PX_PER_MM) / 72],
  ["pc", (MM_PER_INCH * PX_PER_MM) / 6],
]);

/** The parts of a list that is separated by blanks and commas. */
export const listIn = (text: string): string[] => text.split(/[\s,]+/).filter((part) => part !== "");

/** Number and lower-case unit ("" for none), or null if the text is not a length. */
export function splitLength(text: string): { value: number; unit: string } | null {
  const match = NUMBER_AND_UNIT.exec(text);
  if (match === null) return null;
  const value = Number(match[1]);
  return Number.isFinite(value) ? { value, unit: match[2].toLowerCase() } : null;
}

/** Whether a length depends on the letters of a font, of which only the size is used. */
export const isFontLength = (text: string): boolean => /^\s*[+-]?[\d.]+(ex|ch)\s*$/i.test(text);

/** px of an absolute length; null for relative, unknown and malformed lengths. */
export function absolutePx(text: string): number | null {
  const parts = splitLength(text);
  if (parts === null) return null;
  const factor = ABSOLUTE.get(parts.unit);
  return factor === undefined ? null : parts.value * factor;
}

/** User units of any length; null if it is malformed or its unit is unknown. */
export function lengthPx(text: string, basis: LengthBasis, side: Side): number | null {
  const parts = splitLength(text);
  if (parts === null) {
    return text.includes("calc(") ? evaluateCalc(text, (term) => lengthPx(term, basis, side)) : null;
  }
  const { value, unit } = parts;
  const absolute = ABSOLUTE.get(unit);
  if (absolute !== undefined) return value * absolute;
  switch (unit) {
    case "%":
      return (value / 100) * percentBasis(basis, side);
    case "em":
      return value * basis.fontSize;
    case "ex":
    case "ch":
      return (value * basis.fontSize) / 2;
    case "rem":
      return value * basis.rootFontSize;
    case "vw":
      return (value / 100) * basis.viewportWidth;
    case "vh":
      return (value / 100) * basis.viewportHeight;
    case "vmin":
      return (value / 100) * Math.min(basis.viewportWidth, basis.viewportHeight);
    case "vmax":
      return (value / 100) * Math.max(basis.viewportWidth, basis.viewportHeight);
    default:
      return null;
  }
}

function percentBasis(basis: LengthBasis, side: Side): number {
  if (side === "width") return basis.viewportWidth;
  if (side === "height") return basis.viewportHeight;
  return Math.hypot(basis.viewportWidth, basis.viewportHeight) / Math.SQRT2;
}

const TOKEN = /\s*([+-](?=\s)|[*/()]|[+-]?(?:\d+\.?\d*|\.\d+)(?:e[+-]?\d+)?(?:[a-z]+|%)?)/iy;
const MAX_CALC_CHARS = 1000;

/**
 * The value of `calc(…)` (CSS Values 4, §10: + − × ÷ and parentheses), or null if it is malformed. `lengthOf` reads the
 * terms, including plain numbers.
 */
function evaluateCalc(text: string, lengthOf: (term: string) => number | null): number | null {
  const body = text.trim().replace(/calc\(/gi, "(");
  if (body.length > MAX_CALC_CHARS) return null;
  const tokens: string[] = [];
  TOKEN.lastIndex = 0;
  while (TOKEN.lastIndex < body.length) {
    const match = TOKEN.exec(body);
    if (match === null) return null;
    tokens.push(match[1]);
  }
  let at = 0;
  const factor = (): number => {
    const token = tokens[at++] ?? "";
    if (token !== "(") return lengthOf(token) ?? NaN;
    const value = sum();
    return tokens[at++] === ")" ? value : NaN;
  };
  const product = (): number => {
    let value = factor();
    while (tokens[at] === "*" || tokens[at] === "/") {
      if (tokens[at++] === "*") value *= factor();
      else value /= factor();
    }
    return value;
  };
  const sum = (): number => {
    let value = product();
    while (tokens[at] === "+" || tokens[at] === "-") value += tokens[at++] === "+" ? product() : -product();
    return value;
  };
  const value = sum();
  return at === tokens.length && Number.isFinite(value) ? value : null;
}
