/**
 * Lays out characters with their styles and shifts (SVG 2, §11.5): chunk by chunk, each along its line or
 * path and then anchored.
 */
import type { Style } from "../css/style.js";
import type { TextPath } from "./text-path.js";
import { baselineOffset, decorationHeight } from "../css/text-style.js";
import { USUAL_METRICS, type TextFont, layOutLine } from "../../text/text-font.js";

/** A character of the text and the attributes that apply to it. */
export interface Char {
  text: string;
  readonly style: Style;
  /** The path that it is placed on; null for a straight line. */
  readonly path: TextPath | null;
  x: number | null;
  y: number | null;
  dx: number;
  dy: number;
  angle: number | null;
  /** Whether a blank is kept next to other blanks. */
  readonly keepsBlanks: boolean;
  readonly stretch: Stretch | null;
}

/** A target length for characters: reached by changing the gaps, or by scaling the letters too. */
export interface Stretch {
  readonly length: number;
  readonly ofGlyphs: boolean;
}

/** One letter: its path in em, placed at x, y in user units and rotated. */
export interface PlacedLetter {
  readonly path: string;
  readonly x: number;
  readonly y: number;
  /** rad */
  readonly angle: number;
  readonly style: Style;
  /** Horizontal scale. */
  readonly stretch: number;
  /** Distance to the next letter, in user units. */
  readonly advance: number;
}

export interface LaidOutText {
  readonly letters: readonly PlacedLetter[];
  /** Characters that are missing in the font. */
  readonly missing: readonly string[];
  /** How many letters have no room on their path and are left out. */
  readonly offPathCount: number;
}

/** What a text loses, while it is laid out. */
interface Losses {
  readonly missing: string[];
  offPathCount: number;
}

/** A letter on a straight line: x along it, y across. */
interface LetterOnLine extends PlacedLetter {
  readonly pen: number;
  /** Position of its baseline across the line. */
  readonly lineY: number;
  /** A combining mark: it moves and turns with the letter before it. */
  readonly isMark: boolean;
}

interface Pen {
  x: number;
  y: number;
}

const MARK = /^\p{M}$/u;
const ANCHORS: Readonly<Record<Style["textAnchor"], number>> = { start: 0, middle: 0.5, end: 1 };

export function layOutText(chars: readonly Char[], font: TextFont): LaidOutText {
  const letters: PlacedLetter[] = [];
  const losses: Losses = { missing: [], offPathCount: 0 };
  const pen: Pen = { x: 0, y: 0 };
  for (let at = 0; at < chars.length;) {
    let end = at + 1;
    while (end < chars.length && !beginsChunk(chars[end], chars[end - 1])) end++;
    const chunk = chars.slice(at, end);
    letters.push(...(chunk[0].path === null ? straight : along)(chunk, font, pen, losses));
    at = end;
  }
  return { letters, ...losses };
}

/** On a path only x sets a position, along the path. */
const beginsChunk = (char: Char, before: Char): boolean =>
  char.path !== before.path || char.x !== null || (char.y !== null && char.path === null);

function straight(chunk: readonly Char[], font: TextFont, pen: Pen, { missing }: Losses): PlacedLetter[] {
  pen.x = chunk[0].x ?? pen.x;
  pen.y = chunk[0].y ?? pen.y;
  const { isVertical } = chunk[0].style.text;
  const along: Pen = isVertical ? { x: pen.y, y: -pen.x } : { ...pen };
  const startX = along.x;
  const laid = layOutRuns(chunk, font, along, missing);
  // As in browsers, a text that runs backwards begins at its anchor.
  const shift = -Math.max(0, along.x - startX) * anchorOf(chunk[0].style);
  const letters = laid.map((letter) => ({ ...letter, x: letter.x + shift }));
  along.x += shift;
  pen.x = isVertical ? -along.y : along.x;
  pen.y = isVertical ? along.x : along.y;
  if (!isVertical) return letters;
  // A vertical line is a horizontal one rotated by 90°.
  return letters.map((letter) => ({
    ...letter,
    x: -letter.y,
    y: letter.x,
    angle: letter.angle + Math.PI / 2,
  }));
}

/** The share of a text's length that lies before its anchor. */
function anchorOf({ textAnchor, text }: Style): number {
  return text.isRightToLeft ? 1 - ANCHORS[textAnchor] : ANCHORS[textAnchor];
}

/**
 * The middle of each letter lies on the path, and the letter is rotated to the path's direction there.
 * Letters whose middle is off the path are dropped, as the specification requires.
 */
function along(chunk: readonly Char[], font: TextFont, pen: Pen, losses: Losses): PlacedLetter[] {
  const path = chunk[0].path!;
  const anchor = chunk[0].style.textAnchor;
  const line: Pen = { x: chunk[0].x ?? 0, y: 0 };
  const startX = line.x;
  const laid = layOutRuns(chunk, font, line, losses.missing);
  const shift = path.startOffset - (line.x - startX) * anchorOf(chunk[0].style);
  const letters: PlacedLetter[] = [];
  // A letter's lines and marks have the same place as the letter.
  const placesOffPath = new Set<number>();
  for (const letter of laid) {
    const middle = letter.pen + letter.advance / 2;
    const place = path.placeOf(middle + shift, anchor);
    if (place === null) {
      placesOffPath.add(letter.pen);
      continue;
    }
    const cos = Math.cos(place.angle);
    const sin = Math.sin(place.angle);
    const x = place.x + (letter.x - middle) * cos - letter.y * sin;
    const y = place.y + (letter.x - middle) * sin + letter.y * cos;
    letters.push({ ...letter, x, y, angle: place.angle + letter.angle });
  }
  losses.offPathCount += placesOffPath.size;
  const end = path.end();
  if (end !== null) {
    pen.x = end.x;
    pen.y = end.y;
  }
  return letters;
}

/** Places the letters one after the other from `pen`, which ends after the last. */
function layOutRuns(chars: readonly Char[], font: TextFont, pen: Pen, missing: string[]): LetterOnLine[] {
  const letters: LetterOnLine[] = [];
  const runs = runsOf(chars);
  for (let at = 0; at < runs.length;) {
    const { stretch } = runs[at][0];
    const startX = pen.x;
    const part: LetterOnLine[] = [];
    for (; at < runs.length && runs[at][0].stretch === stretch; at++) {
      part.push(...layOutRun(runs[at], font, pen, missing));
    }
    if (stretch === null) letters.push(...part);
    else letters.push(...stretched(part, startX, pen, stretch, at < runs.length));
  }
  return letters
    .flatMap((letter) => [...decorationsOf(letter, font), letter])
    .filter(({ path }) => path !== "");
}

/**
 * Includes blanks, as letters without a path. The run is shaped as a whole, so that letters with separate
 * shifts are still kerned.
 */
function layOutRun(run: readonly Char[], font: TextFont, pen: Pen, missing: string[]): LetterOnLine[] {
  const { style } = run[0];
  const size = style.fontSize;
  const isSeparate = run.some((char) => char.dx !== 0 || char.dy !== 0 || (char.angle ?? 0) !== 0);
  const line = layOutLine(font, run.map((char) => char.text).join(""), {
    family: style.fontFamily,
    hasLigatures: !isSeparate && style.letterSpacing === 0,
    isSmallCaps: style.text.isSmallCaps,
    hasKerning: style.text.hasKerning,
  });
  for (const char of line.missing) missing.push(char);
  const offset = baselineOffset(style.text, size, font.metrics ?? USUAL_METRICS);
  const letters: LetterOnLine[] = [];
  let base: LetterOnLine | null = null;
  let shifted = 0;
  let spacing = 0;
  for (const letter of line.letters) {
    const char = run[Math.min(letter.at, run.length - 1)];
    const isMark = base !== null && MARK.test(char.text);
    for (; shifted < run.length && shifted <= letter.at; shifted++) {
      if (!isMark) shiftPen(pen, run[shifted]);
    }
    if (isMark) pen.x -= spacing;
    const y = pen.y + offset;
    const placed: LetterOnLine = {
      path: letter.path,
      x: pen.x + (letter.x - letter.pen) * size,
      y: y + letter.y * size,
      lineY: y,
      pen: pen.x,
      advance: letter.advance * size,
      angle: char.angle ?? 0,
      stretch: 1,
      style,
      isMark,
    };
    if (isMark && base !== null) letters.push(turnedWith(base, placed));
    else letters.push((base = placed));
    spacing = style.letterSpacing + (char.text === " " ? style.text.wordSpacing : 0);
    pen.x += letter.advance * size + spacing;
  }
  return letters;
}

/** Along the line, and across it. */
function shiftPen(pen: Pen, { dx, dy, style }: Char): void {
  pen.x += style.text.isVertical ? dy : dx;
  pen.y += style.text.isVertical ? -dx : dy;
}

/** The mark rotated together with its letter. On a path it goes where the letter goes. */
function turnedWith(base: LetterOnLine, mark: LetterOnLine): LetterOnLine {
  const { pen, lineY, angle, advance } = base;
  const [x, y] = [mark.x - pen, mark.y - lineY];
  const [cos, sin] = [Math.cos(angle), Math.sin(angle)];
  return { ...mark, x: pen + x * cos - y * sin, y: lineY + x * sin + y * cos, pen, angle, advance };
}

/** Stretches letters from `startX` to the pen to the length given by `textLength`. */
function stretched(
  letters: readonly LetterOnLine[],
  startX: number,
  pen: Pen,
  { length, ofGlyphs }: Stretch,
  isFollowed: boolean,
): LetterOnLine[] {
  const natural = pen.x - startX;
  if (!(natural > 0) || letters.length === 0) return [...letters];
  pen.x = startX + length;
  if (ofGlyphs) {
    const scale = length / natural;
    const place = (x: number): number => startX + (x - startX) * scale;
    return letters.map((letter) => ({
      ...letter,
      x: place(letter.x),
      pen: place(letter.pen),
      advance: letter.advance * scale,
      stretch: scale,
    }));
  }
  const gap = letters.length < 2 ? 0 : (length - natural) / (letters.length - 1);
  // As in browsers, the gap is also added before what follows.
  if (isFollowed) pen.x += gap;
  return letters.map((letter, i) => ({ ...letter, x: letter.x + i * gap, pen: letter.pen + i * gap }));
}

/** Decoration lines of a letter, as separate letters: bars for an outline font, single strokes for others. */
function decorationsOf(letter: LetterOnLine, font: TextFont): LetterOnLine[] {
  const { style, advance, pen, lineY, isMark } = letter;
  if (isMark) return [];
  const metrics = font.metrics ?? USUAL_METRICS;
  const width = advance / style.fontSize;
  const thickness = metrics.lineThickness;
  return style.text.decorations.map(({ kind, fill, stroke }) => {
    const middle = -decorationHeight(kind, metrics);
    const path =
      font.kind === "outline"
        ? `M0 ${middle - thickness / 2}H${width}v${thickness}H0z`
        : `M0 ${middle}H${width}`;
    return { ...letter, path, x: pen, y: lineY, stretch: 1, style: { ...style, fill, stroke } };
  });
}

/** Groups of characters of one style, so that the font can join and kern within them. */
function runsOf(chars: readonly Char[]): Char[][] {
  const runs: Char[][] = [];
  for (const char of chars) {
    const run = runs[runs.length - 1];
    if (run !== undefined && run[0].style === char.style && run[0].stretch === char.stretch) run.push(char);
    else runs.push([char]);
  }
  return runs;
}
