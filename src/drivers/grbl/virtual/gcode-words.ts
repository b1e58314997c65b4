/** How the virtual Grbl reads a line of G-code, the codes with which it refuses one, and the modes that last. */

export const ERROR = {
  letter: 1,
  number: 2,
  dollar: 3,
  noHoming: 5,
  busy: 8,
  locked: 9,
  door: 13,
  jog: 16,
  unknown: 20,
  sameGroup: 21,
  noFeed: 22,
  repeated: 25,
  noAxis: 26,
  noWait: 28,
  noPlaneAxis: 32,
  badTarget: 33,
  badRadius: 34,
  noCentre: 35,
  unused: 36,
  highTool: 38,
  stop: 50,
} as const;
/** The highest number of a tool. */
const MAX_TOOL = 255;

const WORDS = /([A-Z])([-+]?\d*\.?\d+)/g;
/** Supported modes, by group. G4 and G10 are in a group of their own. */
const GROUPS = [
  ["G0", "G1", "G2", "G3"],
  ["G17"],
  ["G21"],
  ["G54"],
  ["G90"],
  ["G94"],
  ["G4", "G10"],
  ["M3", "M4", "M5"],
  ["M0"],
];

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

/** What one line sets for those after it. A reset sets it back. */
export class Modes {
  motion = "G0";
  /** mm/min. */
  feed = 0;
  /** "M5": its output is off. */
  private spindle = "M5";
  private speed = 0;
  private tool = 0;

  /** The signal of the spindle's output; null if it is off. */
  get signal(): number | null {
    return this.spindle === "M5" ? null : this.speed;
  }

  /** As `$G` reports them. */
  get words(): string {
    return `${this.motion} G54 G17 G21 G90 G94 ${this.spindle} M9 T${this.tool} F${this.feed} S${this.speed}`;
  }

  /** Takes M3, M5 and S out of a line. Whether the signal changes; null if it does and may not yet. */
  takeSpindle({ modes, words }: GcodeWords, mayChange: boolean): boolean | null {
    const spindle = modes.find((mode) => mode.startsWith("M")) ?? this.spindle;
    const speed = words.get("S") ?? this.speed;
    const isChange = spindle !== this.spindle || (speed !== this.speed && spindle !== "M5");
    if (isChange && !mayChange) return null;
    words.delete("S");
    this.spindle = spindle;
    this.speed = speed;
    return isChange;
  }

  /** False if there is no such tool. */
  takeTool(words: Map<string, number>): boolean {
    const tool = words.get("T") ?? this.tool;
    if (tool > MAX_TOOL) return false;
    this.tool = tool;
    words.delete("T");
    return true;
  }

  /** The motion of a line: its own, or the lasting one. */
  motionOf(modes: readonly string[]): string {
    return modes.find((mode) => /^G[0-3]$/.test(mode)) ?? this.motion;
  }

  reset(): void {
    this.motion = "G0";
    this.feed = this.speed = this.tool = 0;
    this.spindle = "M5";
  }
}
