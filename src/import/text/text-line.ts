/**
 * One line of text in a font's letters, laid out along its baseline: lengths in em, y down, the first letter's pen
 * place at 0, 0. All formats lay their text out by this and draw it through a map of their own.
 */
import { compose, translation, type Affine } from "../../geometry/affine.js";
import { drawPathData } from "../path-data.js";
import { ShapeBuffer } from "../shape-buffer.js";
import type { TextFont } from "./text-font.js";

export interface LineLetter {
  /** Path data; "" for a blank. */
  readonly path: string;
  /** Where the pen is before the letter. */
  readonly pen: number;
  /** To the next letter's. */
  readonly advance: number;
  /** Where the letter's path stands. */
  readonly x: number;
  readonly y: number;
}

export interface TextLine {
  readonly letters: readonly LineLetter[];
  readonly width: number;
  /** Characters that the font has not. */
  readonly missing: readonly string[];
}

export function layOutLine(font: TextFont, text: string, family: string): TextLine {
  const { glyphs, missing } = font.layout(text, { family });
  let pen = 0;
  const letters = glyphs.map(({ path, x, y, advance }): LineLetter => {
    const letter = { path, pen, advance, x: pen + x, y };
    pen += advance;
    return letter;
  });
  return { letters, width: pen, missing };
}

const one = new ShapeBuffer();

/** Adds the line's letters to `shape`; `map` takes em to the shape's units. */
export function drawLine({ letters }: TextLine, map: Affine, shape: ShapeBuffer): void {
  for (const { path, x, y } of letters) {
    if (path === "") continue;
    one.clear();
    drawPathData(one, path, 1);
    one.finish();
    shape.append(one, compose(map, translation(x, y)));
  }
}
