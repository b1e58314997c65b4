/** Guesses how many px per inch a program means that does not write 96, as in CSS. */
import { papersInPx } from "../../drawing/px-size.js";

export interface PxGuess {
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
export function guessPxPerInch(
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
