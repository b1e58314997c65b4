/** Drawings in a short notation, for tests of the stages after the importer. */
import {
  PAIRS_OF_VERB,
  RULE_NONZERO,
  VERB_CLOSE,
  VERB_CUBIC,
  VERB_LINE,
  VERB_MOVE,
  type ClipRegion,
  type DashPattern,
  type Drawing,
} from "../../../src/drawing/drawing.js";

export interface TestShape {
  /** Path letters M L C Z with absolute coordinates in mm. */
  readonly d: string;
  readonly stroke?: string | null;
  readonly fill?: string | null;
  readonly group?: number;
  readonly dash?: number;
  readonly clip?: number;
  readonly strokeWidth?: number;
  readonly fillRule?: number;
}

interface TestDrawing {
  readonly widthMm?: number;
  readonly heightMm?: number;
  readonly groups?: readonly string[];
  readonly dashes?: readonly DashPattern[];
  readonly clips?: readonly ClipRegion[];
}

const VERB_OF_LETTER: Readonly<Record<string, number>> = {
  M: VERB_MOVE,
  L: VERB_LINE,
  C: VERB_CUBIC,
  Z: VERB_CLOSE,
};

function verbsOf(d: string): { verbs: number[]; coords: number[] } {
  const verbs: number[] = [];
  const coords: number[] = [];
  for (const [, letter, numbers] of d.matchAll(/([MLCZ])([^MLCZ]*)/g)) {
    const verb = VERB_OF_LETTER[letter];
    const values = numbers
      .split(/[\s,]+/)
      .filter(Boolean)
      .map(Number);
    if (values.length !== 2 * PAIRS_OF_VERB[verb]) throw new Error(`bad test path: ${letter}${numbers}`);
    verbs.push(verb);
    coords.push(...values);
  }
  return { verbs, coords };
}

export function clipOf(d: string, rule = RULE_NONZERO, parent = -1): ClipRegion {
  const { verbs, coords } = verbsOf(d);
  const subpaths = verbs.filter((verb) => verb === VERB_MOVE).length;
  return {
    verbs: Uint8Array.from(verbs),
    coords: Float64Array.from(coords),
    rule: new Uint8Array(subpaths).fill(rule),
    shape: new Uint32Array(subpaths),
    parent,
  };
}

export function drawingOf(shapes: readonly (TestShape | string)[], more: TestDrawing = {}): Drawing {
  const colors: string[] = [];
  const colorIndex = (color: string | null): number => {
    if (color === null) return -1;
    if (!colors.includes(color)) colors.push(color);
    return colors.indexOf(color);
  };
  const given = shapes.map((shape): TestShape => (typeof shape === "string" ? { d: shape } : shape));
  const parsed = given.map((shape) => verbsOf(shape.d));
  const offsets = (lengths: readonly number[]): Uint32Array => {
    const out = new Uint32Array(lengths.length + 1);
    lengths.forEach((length, i) => (out[i + 1] = out[i] + length));
    return out;
  };
  const groups = (more.groups ?? ["Layer 1"]).map((name, i) => ({ id: `g${i}`, name, hidden: false }));
  return {
    widthMm: more.widthMm ?? 100,
    heightMm: more.heightMm ?? 100,
    groups,
    colors,
    dashes: more.dashes ?? [],
    clips: more.clips ?? [],
    paths: {
      count: given.length,
      verbs: Uint8Array.from(parsed.flatMap((p) => p.verbs)),
      coords: Float64Array.from(parsed.flatMap((p) => p.coords)),
      verbOffsets: offsets(parsed.map((p) => p.verbs.length)),
      coordOffsets: offsets(parsed.map((p) => p.coords.length)),
      group: Uint32Array.from(given, (shape) => shape.group ?? 0),
      stroke: Int32Array.from(given, (shape) =>
        colorIndex(shape.stroke === undefined ? "#000000" : shape.stroke),
      ),
      fill: Int32Array.from(given, (shape) => colorIndex(shape.fill ?? null)),
      fillRule: Uint8Array.from(given, (shape) => shape.fillRule ?? RULE_NONZERO),
      strokeWidth: Float32Array.from(given, (shape) => shape.strokeWidth ?? 0.3),
      dash: Int32Array.from(given, (shape) => shape.dash ?? -1),
      clip: Int32Array.from(given, (shape) => shape.clip ?? -1),
    },
    warnings: [],
  };
}

/** A sheet of ruled lines: little to draw on a screen, but minutes to plot. */
export const ruledSheet = (lineCount = 120): string => {
  const lines = Array.from(
    { length: lineCount },
    (_, i) => `<path d="M5 ${5 + (i * 130) / lineCount}h190"/>`,
  );
  return `<svg xmlns="http://www.w3.org/2000/svg" width="200mm" height="140mm" viewBox="0 0 200 140">
  <g fill="none" stroke="#000">${lines.join("")}</g></svg>`;
};
