/**
 * TEXT and ATTRIB of a DXF as letters: content and position (AutoCAD DXF reference, TEXT). Lengths in the
 * file's units, y up.
 *
 *   ┌ top ───────── capitals' height ┐
 *   │ middle                         │ height        text height is the height of capitals
 *   └ baseline ──────────────────────┘
 *     bottom: the lowest point of a "g"
 */
import { type DxfPoint, distance } from "./dxf-groups.js";
import { compose, rotation, scaling, translation, type Affine } from "../../geometry/affine.js";
import { plainText } from "./mtext-codes.js";
import type { ShapeBuffer } from "../shape-buffer.js";
import {
  CAPITAL_EM,
  DESCENT_EM,
  type TextFont,
  drawLine,
  layOutLine,
  type TextLine,
} from "../text/text-font.js";
import { RAD_PER_DEG } from "../../units.js";

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
  /** The alignment point, or the end of a text between two points. */
  readonly end: DxfPoint | null;
  /** 0 left, 1 centre, 2 right, 3 aligned between two points, 4 middle, 5 fitted between two points. */
  readonly halign: number;
  /** 0 baseline, 1 bottom, 2 middle, 3 top. */
  readonly valign: number;
}

const LONGEST = 10_000;

/** Draws the text; returns the characters that are missing in the font. */
export function drawDxfWriting(text: DxfWriting, font: TextFont, shape: ShapeBuffer): readonly string[] {
  const line = layOutLine(font, plainText(text.text).slice(0, LONGEST), { family: text.style });
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
    const factor = distance(start, end) / (line.width * width);
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
