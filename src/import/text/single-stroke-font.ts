/** The built-in letters: Hershey's sans and script, with accents assembled from strokes. */
import { HERSHEY_SANS, HERSHEY_SCRIPT } from "./hershey-data.js";
import type { LaidOutGlyph, TextFont, TextMode } from "./text-font.js";

/** Capitals of 21 units are then 0.7 em high, as in common fonts. */
const UNITS_PER_EM = 30;
const BASELINE = 22;
const FIRST_CODE = 33;
const CODE_OF_ZERO = 73;
const SPACE_UNITS = 16;

interface Letter {
  readonly lines: readonly (readonly [number, number])[][];
  readonly advance: number;
}

/**
 * Strokes above a letter, centred on x = 0, with y = 0 at the accent's foot; those in FROM_BASELINE are
 * relative to the baseline.
 */
// prettier-ignore
const ACCENTS: Readonly<Record<string, readonly (readonly [number, number])[][]>> = {
  "\u0300": [[[-3, -4], [1, 0]]],
  "\u0301": [[[3, -4], [-1, 0]]],
  "\u0302": [[[-4, 0], [0, -4], [4, 0]]],
  "\u030c": [[[-4, -4], [0, 0], [4, -4]]],
  "\u0303": [[[-5, -1], [-3, -3], [-1, -3], [1, -1], [3, -1], [5, -3]]],
  "\u0308": [[[-3, -2], [-3, -1]], [[3, -2], [3, -1]]],
  "\u0307": [[[0, -2], [0, -1]]],
  "\u0304": [[[-4, -2], [4, -2]]],
  "\u030a": [[[0, -5], [2, -3], [0, -1], [-2, -3], [0, -5]]],
  "\u0327": [[[0, 0], [1, 2], [-2, 4]]],
  "\u0331": [[[-9, 3], [9, 3]]],
  "\u0337": [[[-7, 2], [7, -16]]],
  "\u0338": [[[-8, 2], [8, -23]]],
};
const FROM_BASELINE = new Set(["\u0327", "\u0331", "\u0337", "\u0338"]);
/** Substitutes for characters outside ASCII. */
const SUBSTITUTES: Readonly<Record<string, string>> = {
  "‘": "'",
  "’": "'",
  "‚": ",",
  "“": '"',
  "”": '"',
  "„": '"',
  "–": "-",
  "—": "-",
  "−": "-",
  "…": "...",
  "×": "x",
  µ: "u",
  ß: "ss",
  æ: "ae",
  Æ: "AE",
  œ: "oe",
  Œ: "OE",
  ø: "o\u0337",
  Ø: "O\u0338",
  "±": "+\u0331",
  ł: "l",
  Ł: "L",
  "·": ".",
  "•": ".",
  "«": "<<",
  "»": ">>",
  "°": "\u030a",
  "\u00a0": " ",
};

const singleStrokeFont: TextFont = {
  kind: "single-stroke",
  layout(text, { family }) {
    const isScript = /cursive|script|hand|brush/i.test(family);
    const table = isScript ? HERSHEY_SCRIPT : HERSHEY_SANS;
    const glyphs: LaidOutGlyph[] = [];
    const missing: string[] = [];
    let at = 0;
    // A character and the combining marks after it are one letter.
    for (const [char] of text.matchAll(/.\p{M}*/gsu)) {
      const letters = lettersOf(char, table);
      if (letters === null) missing.push(char);
      else for (const letter of letters) glyphs.push({ ...glyphOf(letter), at });
      at += [...char].length;
    }
    return { glyphs, missing };
  },
};

/** The font that draws text; null for none. */
export const fontOf = ({
  text = "single-stroke",
  font,
}: {
  readonly text?: TextMode;
  readonly font?: TextFont;
}): TextFont | null =>
  text === "none" ? null : text === "outline" && font !== undefined ? font : singleStrokeFont;

/** The letters for one character of the text, with its combining marks; null if there are none. */
function lettersOf(char: string, table: readonly string[]): Letter[] | null {
  const plain = SUBSTITUTES[char] ?? char.normalize("NFD");
  const letters: Letter[] = [];
  for (const part of plain) {
    const accent = ACCENTS[part];
    if (accent !== undefined) {
      const under = letters.pop() ?? { lines: [], advance: 8 };
      letters.push(withAccent(under, accent, FROM_BASELINE.has(part)));
    } else {
      const letter = letterOf(part, table);
      if (letter === null) return null;
      letters.push(letter);
    }
  }
  return letters;
}

function letterOf(char: string, table: readonly string[]): Letter | null {
  if (/^\s$/.test(char)) return { lines: [], advance: SPACE_UNITS };
  const entry = table[char.charCodeAt(0) - FIRST_CODE];
  if (char.length !== 1 || entry === undefined) return null;
  const [advance = "", ...polylines] = entry.split(" ");
  let [x, y] = [0, 0];
  const lines = polylines.map((codes) =>
    Array.from({ length: codes.length / 2 }, (_, i): [number, number] => [
      (x += numberAt(codes, 2 * i)),
      (y += numberAt(codes, 2 * i + 1)),
    ]),
  );
  return { lines, advance: numberAt(advance, 0) };
}

/** The number that a letter in the tables encodes. */
const numberAt = (codes: string, index: number): number => codes.charCodeAt(index) - CODE_OF_ZERO;

function withAccent(
  letter: Letter,
  accent: readonly (readonly [number, number])[][],
  isFromBaseline: boolean,
): Letter {
  const top = Math.min(BASELINE - 14, ...letter.lines.flat().map(([, y]) => y));
  const footY = isFromBaseline ? BASELINE : top - 3;
  const middle = letter.advance / 2;
  const lines = accent.map((line) => line.map(([x, y]) => [x + middle, y + footY] as const));
  return { ...letter, lines: [...letter.lines, ...lines] };
}

function glyphOf({ lines, advance }: Letter): LaidOutGlyph {
  const em = (units: number): number => units / UNITS_PER_EM;
  const path = lines
    .map((line) => line.map(([x, y], i) => `${i === 0 ? "M" : "L"}${em(x)} ${em(y - BASELINE)}`).join(""))
    .join("");
  return { path, x: 0, y: 0, advance: em(advance) };
}
