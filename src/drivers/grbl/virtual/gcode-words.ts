/** How the virtual Grbl reads a line of G-code, and the codes with which it refuses one. */

export const ERROR = {
  letter: 1,
  number: 2,
  dollar: 3,
  busy: 8,
  locked: 9,
  unknown: 20,
  sameGroup: 21,
  noFeed: 22,
  repeated: 25,
  noWait: 28,
  unused: 36,
} as const;

const WORDS = /([A-Z])([-+]?\d*\.?\d+)/g;
/** Supported modes, by group. G4 and G10 are in a group of their own. */
const GROUPS = [["G0", "G1"], ["G21"], ["G54"], ["G90"], ["G94"], ["G4", "G10"], ["M3", "M4", "M5"]];

export interface GcodeWords {
  /** "G1", "M3" … */
  readonly modes: readonly string[];
  /** All other letters and their values. */
  readonly words: Map<string, number>;
}

/** The words of a line without blanks and comments, in capitals; an error code for one that Grbl refuses. */
export function wordsOf(line: string): GcodeWords | number {
  const rest = line.replace(WORDS, "");
  if (rest !== "") return /^[A-Z]/.test(rest) ? ERROR.number : ERROR.letter;
  const words = new Map<string, number>();
  const modes: string[] = [];
  for (const [, letter, value] of line.matchAll(WORDS)) {
    if (letter === "G" || letter === "M") modes.push(`${letter}${Number(value)}`);
    else if (words.has(letter)) return ERROR.repeated;
    else words.set(letter, Number(value));
  }
  const groups = modes.map((mode) => GROUPS.findIndex((group) => group.includes(mode)));
  if (groups.includes(-1)) return ERROR.unknown;
  if (new Set(groups).size < groups.length) return ERROR.sameGroup;
  return { modes, words };
}
