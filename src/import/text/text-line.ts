/**
 * One line of text laid out along its baseline: lengths in em, y down, the first letter's pen position at 0,
 * 0. All formats lay out text with this, and draw it with their own map.
 */
import { compose, translation, type Affine } from "../../geometry/affine.js";
import { drawPathData } from "../path-data.js";
import { ShapeBuffer } from "../shape-buffer.js";
import type { LetterStyle, TextFont } from "./text-font.js";

interface LineLetter {
  /** Path data; "" for a blank. */
  readonly path: string;
  /** Pen position before the letter. */
  readonly pen: number;
  /** Distance to the next letter's pen position. */
  readonly advance: number;
  /** Position of the letter's path. */
  readonly x: number;
  readonly y: number;
  /** Index of its first character in the line, counted in code points. */
  readonly at: number;
}

export interface TextLine {
  readonly letters: readonly LineLetter[];
  readonly width: number;
  /** Characters that are missing in the font. */
  readonly missing: readonly string[];
}

export function layOutLine(font: TextFont, text: string, style: LetterStyle): TextLine {
  const { glyphs, missing } = font.layout(text, style);
  let pen = 0;
  const letters = glyphs.map(({ path, x, y, advance, at }, i): LineLetter => {
    const letter = { path, pen, advance, x: pen + x, y, at: at ?? i };
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
