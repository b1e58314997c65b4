/**
 * MTEXT of a DXF as letters: its runs in lines, the lines one below the other (AutoCAD DXF reference, MTEXT).
 * Lengths in the file's units, y up; 0, 0 is the attachment point of the text.
 *
 *   ┌ top of the first line: its tallest letters
 *   │ a stack  ½  is aligned with its line: on the baseline, centred, or hanging from the top
 *   └ line distance is 5/3 of the letters' height, times the spacing; more where stacks would touch
 */
import type { DxfPoint } from "./dxf-groups.js";
import { compose, rotation, scaling, translation, type Affine } from "../../geometry/affine.js";
import { getOrAdd } from "../../get-or-add.js";
import { readMtext, type MtextFormat, type MtextParagraph, type MtextRun } from "./mtext-codes.js";
import { ShapeBuffer } from "../shape-buffer.js";
import { CAPITAL_EM, type TextFont, drawLine, layOutLine, type TextLine } from "../text/text-font.js";
import { RAD_PER_DEG } from "../../units.js";
import { clamp } from "../../geometry/polyline.js";

/** MTEXT. */
export interface DxfParagraphs {
  readonly text: string;
  readonly style: string;
  readonly height: number;
  /** Max line width; 0 for no line breaks. */
  readonly width: number;
  readonly angleDeg: number;
  readonly at: DxfPoint;
  /** 1 … 9: top left, top centre … bottom right. */
  readonly attachment: number;
  /** Factor on the usual line distance. */
  readonly lineSpacing: number;
}

/** Letters by their colour (null: the text's own), and the characters that are missing in the font. */
interface DrawnParagraphs {
  readonly shapes: ReadonlyMap<number | null, ShapeBuffer>;
  readonly missing: readonly string[];
}

/** Distance of baselines, as a multiple of the capitals' height. */
const LINE_DISTANCE = 5 / 3;
/** Gap between the parts of a stack, and margin beside its bar; times the height. */
const STACK_GAP = 0.4;
const BAR_MARGIN = 0.1;
const LONGEST = 10_000;

/** A part of a line that is never broken: letters, or a stack. */
interface Piece {
  readonly format: MtextFormat;
  readonly width: number;
  /** Above its own foot. */
  readonly height: number;
  /** Lines of letters, from the foot of the piece. */
  readonly letters: readonly { readonly line: TextLine; readonly x: number; readonly y: number }[];
  /** Bar of a stack, from the foot: x0, y0, x1, y1. */
  readonly bar: readonly [number, number, number, number] | null;
  readonly isBlank: boolean;
}

interface Line {
  readonly paragraph: MtextParagraph;
  readonly isFirst: boolean;
  readonly pieces: readonly Piece[];
  readonly width: number;
  /** Height of its letters, or of the text if it has none. */
  readonly height: number;
}

export function drawDxfParagraphs(text: DxfParagraphs, font: TextFont): DrawnParagraphs {
  const missing: string[] = [];
  const lines = readMtext(text.text.slice(0, LONGEST), text.height).flatMap((paragraph) =>
    linesOf(paragraph, text, font, missing),
  );
  const tops = lines.map((line) =>
    Math.max(line.height, ...line.pieces.map((p) => footOf(p, line) + p.height)),
  );
  const depths = lines.map((line) => Math.max(0, ...line.pieces.map((piece) => -footOf(piece, line))));
  let base = tops[0];
  const bases = lines.map(({ height }, i) => {
    if (i === 0) return base;
    const usual = LINE_DISTANCE * height * text.lineSpacing;
    const isStacked = depths[i - 1] > 0 || tops[i] > height;
    base += isStacked ? Math.max(usual, depths[i - 1] + tops[i] + STACK_GAP * height) : usual;
    return base;
  });
  const widest = Math.max(...lines.map((line) => line.width + text.height * indentOf(line)));
  const boxWidth = text.width > 0 ? text.width : widest;
  const place = clamp(Math.round(text.attachment), 1, 9) - 1;
  const top = (Math.floor(place / 3) / 2) * base;
  const placed = compose(translation(text.at.x, text.at.y), rotation(text.angleDeg * RAD_PER_DEG));
  const shapes = new Map<number | null, ShapeBuffer>();
  lines.forEach((line, i) => {
    let x = startOf(line, text.height, boxWidth, (place % 3) / 2);
    for (const piece of line.pieces) {
      const shape = getOrAdd(shapes, piece.format.color, () => new ShapeBuffer());
      drawPiece(piece, compose(placed, translation(x, top - bases[i] + footOf(piece, line))), shape);
      x += piece.width;
    }
  });
  return { shapes, missing };
}

/** Indents on both sides of a line, times the text's height. */
const indentOf = ({
  paragraph: { left, right, first },
  isFirst,
}: Pick<Line, "paragraph" | "isFirst">): number => left + right + (isFirst ? first : 0);

/** Left end of a line, relative to the attachment point, inside the indents. */
function startOf(line: Line, textHeight: number, boxWidth: number, attached: number): number {
  const { align, right } = line.paragraph;
  const share = align === null ? attached : align === "left" ? 0 : align === "center" ? 0.5 : 1;
  const before = textHeight * (indentOf(line) - right);
  const free = boxWidth - textHeight * indentOf(line) - line.width;
  return before + share * free - attached * boxWidth;
}

/** Height of a piece's foot above the baseline. */
const footOf = ({ format, height }: Piece, line: Line): number =>
  (format.valign / 2) * (line.height - height);

function drawPiece({ format, letters, bar }: Piece, at: Affine, shape: ShapeBuffer): void {
  const em = format.height / CAPITAL_EM;
  const slant = { ...scaling(1), c: Math.tan(format.slantDeg * RAD_PER_DEG) };
  const size = compose(slant, scaling(em * format.widthFactor, -em));
  for (const { line, x, y } of letters) drawLine(line, compose(at, compose(translation(x, y), size)), shape);
  if (bar === null) return;
  const [x0, y0, x1, y1] = bar;
  const one = new ShapeBuffer();
  one.moveTo(x0, y0);
  one.lineTo(x1, y1);
  shape.append(one, at);
}

/** Breaks the paragraph into lines of at most the text's width. A longer word gets a separate line. */
function linesOf(paragraph: MtextParagraph, text: DxfParagraphs, font: TextFont, missing: string[]): Line[] {
  const lines: Piece[][] = [[]];
  const room = (): number =>
    text.width > 0
      ? text.width - text.height * indentOf({ paragraph, isFirst: lines.length === 1 })
      : Infinity;
  const words = wordsOf(paragraph.runs.flatMap((run) => piecesOf(run, text.style, font, missing)));
  for (const word of words) {
    const line = lines[lines.length - 1];
    const isTooLong = widthOf(line) + widthOf(word) > room() * (1 + 1e-9);
    if (line.length > 0 && isTooLong && !word[0].isBlank) lines.push([...word]);
    else line.push(...word);
  }
  return lines.map((pieces, i) => {
    const seen = withoutBlankEnd(pieces, i < lines.length - 1);
    const heights = seen.filter(({ bar, letters }) => bar === null && letters.length === 1);
    return {
      paragraph,
      isFirst: i === 0,
      pieces: seen,
      width: widthOf(seen),
      height: heights.length > 0 ? Math.max(...heights.map(({ height }) => height)) : text.height,
    };
  });
}

const widthOf = (pieces: readonly Piece[]): number => pieces.reduce((sum, { width }) => sum + width, 0);

/** Blanks before a line break do not count towards the line's width. */
function withoutBlankEnd(pieces: readonly Piece[], isBroken: boolean): readonly Piece[] {
  let end = pieces.length;
  while (isBroken && end > 0 && pieces[end - 1].isBlank) end--;
  return pieces.slice(0, end);
}

/** Groups pieces into words: blanks, and the pieces between them. */
function wordsOf(pieces: readonly Piece[]): Piece[][] {
  const words: Piece[][] = [];
  for (const piece of pieces) {
    const last = words.at(-1);
    if (last !== undefined && last[0].isBlank === piece.isBlank) last.push(piece);
    else words.push([piece]);
  }
  return words;
}

function piecesOf(
  { format, text, stacked }: MtextRun,
  style: string,
  font: TextFont,
  missing: string[],
): Piece[] {
  const laidOut = (part: string): TextLine => {
    const line = layOutLine(font, part.replaceAll("\u00a0", " "), { family: format.font || style });
    missing.push(...line.missing);
    return tracked(line, format.tracking);
  };
  const em = (format.height / CAPITAL_EM) * format.widthFactor;
  if (stacked !== null)
    return [stackOf(laidOut(stacked.over), laidOut(stacked.under), stacked.between, format, em)];
  return (text.match(/ +|[^ ]+/g) ?? []).map((part) => {
    const line = laidOut(part);
    return {
      format,
      width: line.width * em,
      height: format.height,
      letters: [{ line, x: 0, y: 0 }],
      bar: null,
      isBlank: part.startsWith(" "),
    };
  });
}

/** Applies letter tracking. */
function tracked(line: TextLine, tracking: number): TextLine {
  if (tracking === 1) return line;
  let pen = 0;
  const letters = line.letters.map((letter) => {
    const moved = { ...letter, pen, x: pen + letter.x - letter.pen, advance: letter.advance * tracking };
    pen += moved.advance;
    return moved;
  });
  return { ...line, letters, width: pen };
}

/** One part above the other with a bar; side by side with a slash; or flush left, as tolerances are. */
function stackOf(
  over: TextLine,
  under: TextLine,
  between: "/" | "#" | "^",
  format: MtextFormat,
  em: number,
): Piece {
  const { height } = format;
  const [overWidth, underWidth] = [over.width * em, under.width * em];
  const [gap, margin] = [STACK_GAP * height, BAR_MARGIN * height];
  const tall = 2 * height + gap;
  const slash = 0.5 * height;
  const wide =
    between === "#"
      ? overWidth + slash + underWidth
      : Math.max(overWidth, underWidth) + (between === "/" ? 2 * margin : 0);
  const x = (width: number): number => (between === "/" ? (wide - width) / 2 : 0);
  const middle = height + gap / 2;
  return {
    format,
    width: wide,
    height: tall,
    letters: [
      { line: over, x: x(overWidth), y: height + gap },
      { line: under, x: between === "#" ? overWidth + slash : x(underWidth), y: 0 },
    ],
    bar:
      between === "/"
        ? [0, middle, wide, middle]
        : between === "#"
          ? [overWidth, middle - height / 2, overWidth + slash, middle + height / 2]
          : null,
    isBlank: false,
  };
}
