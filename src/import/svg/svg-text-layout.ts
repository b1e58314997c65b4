/**
 * Characters with their styles and shifts to places of letters (SVG 2, §11.5): chunk by chunk, each laid out
 * along its line or path and then anchored.
 */
import type { Style } from "./style.js";
import type { TextPath } from "./svg-text-path.js";
import type { TextFont } from "../text/text-font.js";
import { layOutLine } from "../text/text-line.js";

/** A character of the text and what falls on it. */
export interface Char {
  text: string;
  readonly style: Style;
  /** What it stands on; null for a straight line. */
  readonly path: TextPath | null;
  x: number | null;
  y: number | null;
  dx: number;
  dy: number;
  angle: number | null;
}

/** One letter: its path in em, put at x, y in user units and turned. */
export interface PlacedLetter {
  readonly path: string;
  readonly x: number;
  readonly y: number;
  /** rad */
  readonly angle: number;
  readonly style: Style;
  /** In user units, to the next letter. */
  readonly advance: number;
}

export interface LaidOutText {
  readonly letters: readonly PlacedLetter[];
  /** Characters that the font has not. */
  readonly missing: readonly string[];
}

/** A letter on a line that is straight so far: x along it, y across. */
interface LetterOnLine extends PlacedLetter {
  readonly pen: number;
}

interface Pen {
  x: number;
  y: number;
}

const ANCHORS: Readonly<Record<Style["textAnchor"], number>> = { start: 0, middle: 0.5, end: 1 };

export function layOutText(chars: readonly Char[], font: TextFont): LaidOutText {
  const letters: PlacedLetter[] = [];
  const missing: string[] = [];
  const pen: Pen = { x: 0, y: 0 };
  for (let at = 0; at < chars.length;) {
    let end = at + 1;
    while (end < chars.length && !beginsChunk(chars[end], chars[end - 1])) end++;
    const chunk = chars.slice(at, end);
    letters.push(...(chunk[0].path === null ? straight : along)(chunk, font, pen, missing));
    at = end;
  }
  return { letters, missing };
}

/** On a path only x is a place, the one along it. */
const beginsChunk = (char: Char, before: Char): boolean =>
  char.path !== before.path || char.x !== null || (char.y !== null && char.path === null);

function straight(chunk: readonly Char[], font: TextFont, pen: Pen, missing: string[]): PlacedLetter[] {
  pen.x = chunk[0].x ?? pen.x;
  pen.y = chunk[0].y ?? pen.y;
  const startX = pen.x;
  const letters = layOutRuns(chunk, font, pen, missing);
  const shift = -(pen.x - startX) * ANCHORS[chunk[0].style.textAnchor];
  pen.x += shift;
  return shift === 0 ? letters : letters.map((letter) => ({ ...letter, x: letter.x + shift }));
}

/**
 * The middle of each letter stands on the path, and the letter is turned as the path is there. Letters whose
 * middle is off the path are left out, as the specification says.
 */
function along(chunk: readonly Char[], font: TextFont, pen: Pen, missing: string[]): PlacedLetter[] {
  const path = chunk[0].path!;
  const anchor = chunk[0].style.textAnchor;
  const line: Pen = { x: chunk[0].x ?? 0, y: 0 };
  const startX = line.x;
  const laid = layOutRuns(chunk, font, line, missing);
  const shift = path.startOffset - (line.x - startX) * ANCHORS[anchor];
  const letters: PlacedLetter[] = [];
  for (const letter of laid) {
    const middle = letter.pen + letter.advance / 2;
    const place = path.placeOf(middle + shift, anchor);
    if (place === null) continue;
    const cos = Math.cos(place.angle);
    const sin = Math.sin(place.angle);
    const x = place.x + (letter.x - middle) * cos - letter.y * sin;
    const y = place.y + (letter.x - middle) * sin + letter.y * cos;
    letters.push({ ...letter, x, y, angle: place.angle + letter.angle });
  }
  const end = path.end();
  if (end !== null) {
    pen.x = end.x;
    pen.y = end.y;
  }
  return letters;
}

/** The letters one after the other from `pen` on, which ends behind the last. */
function layOutRuns(chars: readonly Char[], font: TextFont, pen: Pen, missing: string[]): LetterOnLine[] {
  const letters: LetterOnLine[] = [];
  for (const run of runsOf(chars)) {
    const { style, angle, dx, dy } = run[0];
    const size = style.fontSize;
    pen.x += dx;
    pen.y += dy;
    const line = layOutLine(font, run.map((char) => char.text).join(""), style.fontFamily);
    for (const char of line.missing) missing.push(char);
    const startX = pen.x;
    line.letters.forEach((letter, i) => {
      const spaced = startX + i * style.letterSpacing;
      pen.x = spaced + (letter.pen + letter.advance) * size + style.letterSpacing;
      if (letter.path === "") return;
      letters.push({
        path: letter.path,
        x: spaced + letter.x * size,
        y: pen.y + letter.y * size,
        pen: spaced + letter.pen * size,
        advance: letter.advance * size,
        angle: angle ?? 0,
        style,
      });
    });
  }
  return letters;
}

/** Stretches of one style without shifts inside, so that a font may join and kern within them. */
function runsOf(chars: readonly Char[]): Char[][] {
  const runs: Char[][] = [];
  for (const char of chars) {
    const run = runs[runs.length - 1];
    const goesOn =
      run !== undefined &&
      run[0].style === char.style &&
      run[0].angle === char.angle &&
      char.dx === 0 &&
      char.dy === 0 &&
      (char.angle === null || char.angle === 0);
    if (goesOn) run.push(char);
    else runs.push([char]);
  }
  return runs;
}
