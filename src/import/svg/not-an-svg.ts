/** Detects other file formats by their first characters. */
import { PlotwrightError } from "../../errors.js";

export const notAnSvg = (what: string): PlotwrightError =>
  new PlotwrightError(
    "bad-file",
    `This is not an SVG file: ${what}. Export the drawing as SVG and try again.`,
  );

const OTHER_FORMATS: readonly (readonly [string, string])[] = [
  ["%PDF", "it is a PDF"],
  ["%!PS", "it is PostScript"],
  ["\u0089PNG", "it is a PNG picture"],
  ["\ufffdPNG", "it is a PNG picture"],
  ["GIF8", "it is a GIF picture"],
  ["\u00ff\u00d8", "it is a JPEG picture"],
  ["\ufffd\ufffd\ufffd", "it is binary"],
  ["\u001f\u008b", "it is compressed (svgz); unpack it first"],
  ["\u001f\ufffd", "it is compressed (svgz); unpack it first"],
  ["PK\u0003\u0004", "it is a zip archive"],
];

/** @param start where the text begins after blanks */
export function rejectOtherFormats(text: string, start: number): void {
  if (start === text.length) throw notAnSvg("it is empty");
  for (const [magic, what] of OTHER_FORMATS) {
    if (text.startsWith(magic, start) || text.startsWith(magic)) throw notAnSvg(what);
  }
  if (text.charCodeAt(start) !== 60) throw notAnSvg("it does not begin with <");
}
