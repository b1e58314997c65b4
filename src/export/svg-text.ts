/** Helpers to write SVG. Lengths in mm; one user unit is one mm. */
import { withCodes } from "../plain-text.js";

/** Characters that XML forbids. */
const FORBIDDEN = /[^\t\n\r\u0020-\ud7ff\ue000-\ufffd\u{10000}-\u{10ffff}]/gu;
const ESCAPES: Readonly<Record<string, string>> = {
  "&": "&amp;",
  "<": "&lt;",
  ">": "&gt;",
  '"': "&quot;",
};

/**
 * Text for an attribute or element: markup is escaped, characters that XML forbids are removed. All others that can't be
 * printed are written by number, since the SVG may be printed on a terminal, which they could control.
 */
export const xmlText = (text: string): string =>
  withCodes(
    text.replace(FORBIDDEN, "").replace(/[&<>"]/g, (char) => ESCAPES[char]),
    (hex) => `&#x${hex};`,
  );

/** Rounded to 1 µm, without trailing zeros. */
export const mmText = (value: number): string => String(Math.round(value * 1000) / 1000 + 0);

/** The XML declaration and the opening tag of a page of that size. */
export const svgOpening = (widthMm: number, heightMm: number): string =>
  `<?xml version="1.0" encoding="UTF-8"?>\n` +
  `<svg xmlns="http://www.w3.org/2000/svg" xmlns:inkscape="http://www.inkscape.org/namespaces/inkscape" ` +
  `width="${mmText(widthMm)}mm" height="${mmText(heightMm)}mm" viewBox="0 0 ${mmText(widthMm)} ${mmText(heightMm)}">\n`;

/** Path data of points [from, to) of interleaved coordinates; a single point becomes a dot. */
export function pathData(xy: Float64Array, from: number, to: number): string {
  let d = `M${mmText(xy[2 * from])} ${mmText(xy[2 * from + 1])}`;
  if (to === from + 1) return `${d}h0`;
  const closed = to > from + 3 && xy[2 * from] === xy[2 * to - 2] && xy[2 * from + 1] === xy[2 * to - 1];
  d += "L";
  for (let p = from + 1; p < (closed ? to - 1 : to); p++) {
    d += `${p > from + 1 ? " " : ""}${mmText(xy[2 * p])} ${mmText(xy[2 * p + 1])}`;
  }
  return closed ? `${d}Z` : d;
}
