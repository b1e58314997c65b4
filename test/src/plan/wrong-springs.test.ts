/**
 * The pen of a machine whose frequency was measured wrong by 10 %, on drawings whose corners come in a rhythm. The shares are
 * of the largest distance that the default (A = 500, not shaped) would have on a machine between −10 % and +10 %.
 */
import { expect, it } from "vitest";
import {
  DEFAULT_MOTION,
  DEFAULT_PEN,
  plan,
  type MotionSettings,
  type StrokeSet,
} from "../../../src/index.js";
import { penError, QUALITIES, type Springs } from "../../../src/internal.js";
import { strokeSetOf, type Point } from "../../support/drawings/arbitraries.js";
import { sampleStrokes } from "../../support/drawings/sample-strokes.js";
import { inQuality, SPRINGS, swinging } from "../../support/machines/swinging.js";
import { IS_FULL } from "../../support/runs/full-run.js";

/** Thinner than any pen's line. */
const UNSEEN_MM = 0.06;

/** A curve of an L-system: letters draw a step, + and − turn by the angle. */
function curve(
  rules: Readonly<Record<string, string>>,
  depth: number,
  turnDeg: number,
  stepMm: number,
): StrokeSet {
  let text = Object.keys(rules)[0];
  for (let i = 0; i < depth; i++) text = [...text].map((letter) => rules[letter] ?? letter).join("");
  const points: Point[] = [[0, 0]];
  let turns = 0;
  for (const letter of text) {
    if (letter === "+" || letter === "-") turns += letter === "+" ? 1 : -1;
    else if ("ABF".includes(letter)) {
      const [x, y] = points[points.length - 1];
      const angle = (turns * turnDeg * Math.PI) / 180;
      points.push([x + stepMm * Math.cos(angle), y + stepMm * Math.sin(angle)]);
    }
  }
  const [left, top] = [0, 1].map((axis) => Math.min(...points.map((point) => point[axis])));
  return strokeSetOf([points.map(([x, y]): Point => [x - left + 20, y - top + 20])]);
}

const gosper = (stepMm: number) => curve({ A: "A-B--B+A++AA+B-", B: "+A-BB--B-A++A+B" }, 3, 60, stepMm);
const hilbert = (stepMm: number) => curve({ X: "+YF-XFX-FY+", Y: "-XF+YFY+FX-" }, 4, 90, stepMm);
const peano = (stepMm: number) =>
  curve({ X: "XFYFX+F+YFXFY-F-XFYFX", Y: "YFXFY-F-XFYFX+F+YFXFY" }, 2, 90, stepMm);
const hatching = (gapMm: number) =>
  strokeSetOf([
    Array.from({ length: 60 }, (_, i): Point => [20 + 30 * (((i + 1) >> 1) % 2), 20 + gapMm * (i >> 1)]),
  ]);
const spiral = (pitchMm: number) =>
  strokeSetOf([
    Array.from({ length: 1_500 }, (_, i): Point => {
      const radius = (pitchMm * i) / 126;
      return [150 + radius * Math.cos(i / 20), 110 + radius * Math.sin(i / 20)];
    }),
  ]);

const STEPS_MM = IS_FULL ? [1, 1.5, 2, 3, 4, 6] : [3];
const CURVES = { gosper, hilbert, peano, hatching, spiral };
/** Simulating them takes minutes: only the full run does. quality.test.ts has medians of some in both. */
const SAMPLES = IS_FULL
  ? ["flower-meadow", "harmonograph", "hello-paper", "moonrise", "three-colour-hills", "whirling-triangles"]
  : [];

const DRAWINGS: ReadonlyMap<string, StrokeSet> = new Map([
  ...Object.entries(CURVES).flatMap(([name, of]) =>
    STEPS_MM.map((mm) => [`${name}, ${mm} mm`, of(mm)] as const),
  ),
  ...(await Promise.all(SAMPLES.map(async (name) => [name, await sampleStrokes(name)] as const))),
]);

/** The largest distance of the pen from the drawing on a machine with wrong springs. */
function worstMm(strokes: StrokeSet, motion: MotionSettings, springs: Springs, factors: readonly number[]) {
  const planned = plan(strokes, motion, DEFAULT_PEN, { machine: swinging(springs) });
  const at = (factor: number) => ({ ...springs, xHz: factor * springs.xHz, yHz: factor * springs.yHz });
  return Math.max(...factors.map((factor) => penError(strokes, planned, at(factor)).maxMm));
}

it.each([...DRAWINGS.keys()])(
  "wrong springs bring the pen at most 1.3 times as far from the drawing as the default is, in each quality: %s",
  { timeout: 900_000 },
  (name) => {
    const strokes = DRAWINGS.get(name)!;
    for (const springs of SPRINGS) {
      const before = worstMm(strokes, DEFAULT_MOTION, springs, [0.9, 1, 1.1]);
      for (const quality of QUALITIES) {
        const after = worstMm(strokes, inQuality(quality, springs), springs, [0.9, 1.1]);
        expect(after, `${quality}, ${springs.xHz} Hz`).toBeLessThanOrEqual(Math.max(UNSEEN_MM, 1.3 * before));
      }
    }
  },
);

it("the pen on Gosper's curve stays as near as the default's on right springs, also on wrong ones", () => {
  const strokes = gosper(3);
  const [springs] = SPRINGS;
  const before = worstMm(strokes, DEFAULT_MOTION, springs, [1]);
  expect(worstMm(strokes, inQuality("fast", springs), springs, [0.9, 1.1])).toBeLessThanOrEqual(1.3 * before);
});

it("an axis that may accelerate less is slowed only for what the pen does on the paper", () => {
  const [springs] = SPRINGS;
  for (const accelXMmPerS2 of [600, 1_000]) {
    const strokes = gosper(2);
    const motion = { ...inQuality("fast", springs), accelXMmPerS2 };
    const planned = plan(strokes, motion, DEFAULT_PEN, { machine: swinging(springs) });
    // Both axes may accelerate as little: nothing is gained by that.
    const draw = { ...motion.draw, accelMmPerS2: accelXMmPerS2 };
    const slow = plan(strokes, { ...motion, draw }, DEFAULT_PEN, { machine: swinging(springs) });
    expect(planned.totalS).toBeLessThan(slow.totalS);
    const before = worstMm(strokes, DEFAULT_MOTION, springs, [1]);
    expect(worstMm(strokes, motion, springs, [0.9, 1.1])).toBeLessThanOrEqual(1.3 * before);
  }
});
