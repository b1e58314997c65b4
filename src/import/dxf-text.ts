/**
 * TEXT, ATTRIB and MTEXT of a DXF as letters: what is written, and where each line stands (AutoCAD DXF reference,
 * TEXT and MTEXT). Lengths in the file's units, y up.
 *
 *   ┌ top ───────── capitals' height ┐
 *   │ middle                         │ height        the size of letters is told by their capitals
 *   └ baseline ──────────────────────┘
 *     bottom: as far below as a "g" reaches
 */
import type { DxfPoint } from "dxf-parser/dist/dxf-parser.js";
import { compose, rotation, scaling, translation, type Affine } from "../geometry/affine.js";
import type { ShapeBuffer } from "./shape-buffer.js";
import { CAPITAL_EM, DESCENT_EM, type TextFont } from "./text-font.js";
import { drawLine, layOutLine, type TextLine } from "./text-line.js";

/** TEXT or ATTRIB. */
export interface DxfWriting {
  readonly text: string;
  readonly style: string;
  readonly height: number;
  readonly widthFactor: number;
  readonly angleDeg: number;
  readonly obliqueDeg: number;
  readonly isBackward: boolean;
  readonly isUpsideDown: boolean;
  readonly start: DxfPoint;
  /** What an aligned text stands at, or where one between two points ends. */
  readonly end: DxfPoint | null;
  /** 0 left, 1 centre, 2 right, 3 aligned between two points, 4 middle of all, 5 fitted between two points. */
  readonly halign: number;
  /** 0 baseline, 1 bottom, 2 middle, 3 top. */
  readonly valign: number;
}

/** MTEXT. */
export interface DxfParagraphs {
  readonly text: string;
  readonly style: string;
  readonly height: number;
  /** Lines are broken at this; 0 for never. */
  readonly width: number;
  readonly angleDeg: number;
  readonly at: DxfPoint;
  /** 1 … 9: top left, top centre … bottom right. */
  readonly attachment: number;
  /** Times the usual distance of lines. */
  readonly lineSpacing: number;
}

/** Distance of baselines over the height of capitals. */
const LINE_DISTANCE = 5 / 3;
const RAD_PER_DEG = Math.PI / 180;
const LONGEST = 10_000;

/** Draws the text; answers the characters that the font has not. */
export function drawDxfWriting(text: DxfWriting, font: TextFont, shape: ShapeBuffer): readonly string[] {
  const line = layOutLine(font, plainText(text.text).slice(0, LONGEST), text.style);
  drawLine(line, mapOfWriting(text, line), shape);
  return line.missing;
}

function mapOfWriting(text: DxfWriting, line: TextLine): Affine {
  const { start, end, halign, valign, widthFactor } = text;
  let em = text.height / CAPITAL_EM;
  let width = em * widthFactor;
  let angle = text.angleDeg * RAD_PER_DEG;
  let at = halign === 0 && valign === 0 ? start : (end ?? start);
  let anchor = halign === 1 || halign === 4 ? 0.5 : halign === 2 ? 1 : 0;
  if ((halign === 3 || halign === 5) && end !== null && line.width > 0) {
    const factor = Math.hypot(end.x - start.x, end.y - start.y) / (line.width * width);
    angle = Math.atan2(end.y - start.y, end.x - start.x);
    width *= factor;
    if (halign === 3) em *= factor;
    at = start;
    anchor = 0;
  }
  const up =
    halign === 4 ? (CAPITAL_EM - DESCENT_EM) / 2 : [0, -DESCENT_EM, CAPITAL_EM / 2, CAPITAL_EM][valign];
  const mirrored = scaling(text.isBackward ? -1 : 1, text.isUpsideDown ? -1 : 1);
  const slant = { ...scaling(1), c: Math.tan(text.obliqueDeg * RAD_PER_DEG) };
  const placed = compose(translation(at.x, at.y), compose(rotation(angle), mirrored));
  const anchored = compose(placed, translation(-anchor * line.width * width, -(up ?? 0) * em));
  return compose(anchored, compose(slant, scaling(width, -em)));
}

/** Draws the paragraphs; answers the characters that the font has not. */
export function drawDxfParagraphs(text: DxfParagraphs, font: TextFont, shape: ShapeBuffer): string[] {
  const em = text.height / CAPITAL_EM;
  const lines = plainParagraphs(text.text.slice(0, LONGEST))
    .flatMap((paragraph) => brokenAt(text.width / em, paragraph, text.style, font))
    .map((line) => layOutLine(font, line, text.style));
  const distance = LINE_DISTANCE * text.height * text.lineSpacing;
  const place = Math.min(9, Math.max(1, Math.round(text.attachment))) - 1;
  const anchor = (place % 3) / 2;
  const top = (Math.floor(place / 3) / 2) * (text.height + (lines.length - 1) * distance);
  const placed = compose(translation(text.at.x, text.at.y), rotation(text.angleDeg * RAD_PER_DEG));
  lines.forEach((line, i) => {
    const at = translation(-anchor * line.width * em, top - text.height - i * distance);
    drawLine(line, compose(placed, compose(at, scaling(em, -em))), shape);
  });
  return lines.flatMap(({ missing }) => missing);
}

/** The paragraph in lines of at most `width` em; 0 for no limit. A word longer than that has a line of its own. */
function brokenAt(width: number, paragraph: string, style: string, font: TextFont): string[] {
  if (!(width > 0)) return [paragraph];
  const space = layOutLine(font, " ", style).width;
  const lines: string[] = [];
  let room = 0;
  for (const word of paragraph.split(" ")) {
    const length = layOutLine(font, word, style).width;
    if (lines.length > 0 && length + space <= room + 1e-9) {
      lines[lines.length - 1] += ` ${word}`;
      room -= length + space;
    } else {
      lines.push(word);
      room = width - length;
    }
  }
  return lines;
}

const SIGNS: Readonly<Record<string, string>> = { d: "°", c: "Ø", p: "±", "%": "%", u: "", o: "", k: "" };

/** Without %%-codes, and with the character that a \U+ and four hexadecimal digits stand for. */
export const plainText = (text: string): string =>
  text
    .replace(/%%(?:(\d{3})|([dcpuok%]))/gi, (_, code: string | undefined, sign: string) =>
      code === undefined ? SIGNS[sign.toLowerCase()] : String.fromCharCode(Number(code)),
    )
    .replace(/\\U\+([0-9A-F]{4})/gi, (_, hex: string) => String.fromCharCode(parseInt(hex, 16)));

/**
 * Formatting codes of MTEXT: \P and \N end a line; \S is a fraction; letters with a value up to a semicolon set
 * height, font, colour and the like, which are not followed; braces hold such settings together.
 */
const FORMAT =
  /\\(?:([PNX])|S([^;]*);?|[ACcHWQTfFp][^;]*;?|M\+[0-9A-Fa-f]{5}|[LlOoKk]|(~)|(?!U\+)(.))|[{}]|\^([IJM])/g;

function plainParagraphs(text: string): string[] {
  const plain = text.replace(
    FORMAT,
    (_, end?: string, fraction?: string, blank?: string, itself?: string, control?: string) => {
      if (end !== undefined || control === "J") return "\n";
      if (fraction !== undefined) return fraction.replace(/[#^]/, "/").replace(/ /g, "");
      return blank !== undefined || control === "I" ? " " : (itself ?? "");
    },
  );
  return plainText(plain).split("\n");
}
