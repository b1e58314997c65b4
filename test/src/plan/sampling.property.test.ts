/** A plan does not depend on how its line is sampled: points within 1 µm of a line change neither time nor speed. */
import fc from "fast-check";
import { describe, expect, it } from "vitest";
import {
  DEFAULT_MOTION,
  DEFAULT_PEN,
  plan,
  type MotionSettings,
  type Trajectory,
} from "../../../src/index.js";
import { MOTION_MODES } from "../../../src/internal.js";
import { MAX_MOVED_MM, Resampler } from "../../../src/plan/resample.js";
import { RunPath } from "../../../src/plan/run-path.js";
import { blockState, newMotionState } from "../../../src/plan/trajectory.js";
import { arbitraryStroke, strokeSetOf, type Point } from "../../support/drawings/arbitraries.js";
import { cases, IS_FULL } from "../../support/runs/full-run.js";
import { sampleStrokes } from "../../support/drawings/sample-strokes.js";
import { inQuality, SPRINGS, swinging } from "../../support/machines/swinging.js";
import { NearStroke } from "../../support/trajectories/trajectory-checks.js";

const NOISE_MM = 0.001;
const real = (min: number, max: number) => fc.double({ min, max, noNaN: true });

interface Case {
  readonly name: string;
  readonly motion: MotionSettings;
  readonly springs?: (typeof SPRINGS)[number];
}
const FITS = [
  ["merged", DEFAULT_MOTION.fit],
  ["not merged", null],
] as const;
const CASES: readonly Case[] = [
  ...MOTION_MODES.flatMap((mode) =>
    FITS.map(([name, fit]) => ({ name: `${mode}, ${name}`, motion: { ...DEFAULT_MOTION, mode, fit } })),
  ),
  { name: "shaped", motion: inQuality("fast", SPRINGS[0]), springs: SPRINGS[0] },
];

/** Adds `perSegment` points to each segment on average, some of them behind the one before, and doubles some points. */
function withNoise(line: readonly Point[], perSegment: number, seed: number): Point[] {
  const random = randomFrom(seed);
  const noise = (): number => NOISE_MM * (2 * random() - 1);
  const noisy: Point[] = [line[0]];
  for (let i = 1; i < line.length; i++) {
    const [ax, ay] = line[i - 1];
    const [bx, by] = line[i];
    const length = Math.hypot(bx - ax, by - ay);
    const count = length === 0 ? 0 : Math.floor(perSegment + random());
    const shares = Array.from({ length: count }, random).sort((a, b) => a - b);
    const [ux, uy] = [(bx - ax) / length, (by - ay) / length];
    for (const share of shares) {
      const aside = noise();
      const x = ax + (bx - ax) * share - uy * aside;
      const y = ay + (by - ay) * share + ux * aside;
      noisy.push([x, y]);
      if (random() < 0.3) noisy.push([x - ux * NOISE_MM * random(), y - uy * NOISE_MM * random()]);
    }
    noisy.push([bx, by]);
    if (random() < 0.2 && i < line.length - 1) noisy.push([bx + 0.7 * noise(), by + 0.7 * noise()], [bx, by]);
  }
  return noisy;
}

/** A linear congruential generator, 0 to 1. */
function randomFrom(seed: number): () => number {
  let state = seed;
  return () => (state = (state * 1_103_515_245 + 12_345) % 2_147_483_648) / 2_147_483_648;
}

/** Seconds of drawing. */
function drawS({ runs, durationS }: Trajectory): number {
  let sum = 0;
  for (let run = 0; run < runs.count; run++) {
    if (runs.stroke[run] < 0) continue;
    for (let k = runs.firstBlock[run]; k < runs.firstBlock[run + 1]; k++) sum += durationS[k];
  }
  return sum;
}

/** The lowest speed in the middle three fifths of the time of a plan of one stroke. */
function slowest(trajectory: Trajectory): number {
  const { runs, durationS } = trajectory;
  const run = runs.stroke.findIndex((stroke) => stroke >= 0);
  const state = newMotionState();
  const wholeS = drawS(trajectory);
  let beforeS = 0;
  let min = Infinity;
  for (let k = runs.firstBlock[run]; k < runs.firstBlock[run + 1]; k++) {
    for (const share of [0, 0.25, 0.5, 0.75, 1]) {
      const at = (beforeS + share * durationS[k]) / wholeS;
      if (at < 0.2 || at > 0.8) continue;
      blockState(trajectory, k, share * durationS[k], state);
      min = Math.min(min, Math.hypot(state.vx, state.vy));
    }
    beforeS += durationS[k];
  }
  return min;
}

const planned = (lines: readonly (readonly Point[])[], { motion, springs }: Case): Trajectory =>
  plan(strokeSetOf(lines), motion, DEFAULT_PEN, { machine: springs && swinging(springs) });

/**
 * Seconds to draw each part shorter than a motor step by itself, from rest to rest. 1 µm of noise decides whether a spike
 * of 4 µm is drawn: it is there and back, at most twice its time.
 */
const tinyS = (line: readonly Point[], mode: Case): number => {
  let sum = 0;
  for (let i = 1; i < line.length; i++) {
    const mm = Math.hypot(line[i][0] - line[i - 1][0], line[i][1] - line[i - 1][1]);
    if (mm > 0 && mm < 0.01) sum += drawS(planned([[line[i - 1], line[i]]], mode));
  }
  return sum;
};

/** Smooth lines: circles, spirals and waves, sampled every 0.02 to 1 mm. */
const turning = (radius: (turn: number) => number, turns: number, stepMm: number): Point[] => {
  const points: Point[] = [];
  for (let turn = 0; turn < turns; turn += stepMm / (2 * Math.PI * radius(turn))) {
    const r = radius(turn);
    points.push([100 + r * Math.cos(2 * Math.PI * turn), 100 + r * Math.sin(2 * Math.PI * turn)]);
  }
  return points;
};
const smooth: fc.Arbitrary<Point[]> = fc.oneof(
  fc.tuple(real(1, 40), real(0.02, 1)).map(([r, step]) => turning(() => r, 2, Math.min(step, r / 4))),
  fc.tuple(real(0.5, 3), real(0.02, 0.3)).map(([r, step]) => turning((turn) => r * (1 + turn), 5, step)),
  fc
    .tuple(real(0.5, 5), real(8, 40), real(0.05, 0.5))
    .map(([height, wide, step]) =>
      Array.from({ length: Math.round(100 / step) }, (_, i): Point => [
        10 + i * step,
        100 + height * Math.sin((2 * Math.PI * i * step) / wide),
      ]),
    ),
);
const cornered = fc.array(fc.tuple(real(0, 200), real(0, 200)), { minLength: 2, maxLength: 8 });

describe.each(CASES)("points within 1 µm of a line, $name", (mode) => {
  it("change its time by at most 1 %, and its lowest speed by at most 5 %", () => {
    fc.assert(
      fc.property(smooth, real(0.3, 3), fc.nat(), (line, perSegment, seed) => {
        const clean = planned([line], mode);
        const noisy = planned([withNoise(line, perSegment, seed)], mode);
        expect(Math.abs(drawS(noisy) / drawS(clean) - 1)).toBeLessThanOrEqual(0.01);
        // Shaping changes the speed of the carriage where the pen's is even.
        const unshaped = (trajectory: Trajectory): Trajectory => trajectory.planned?.trajectory ?? trajectory;
        expect(slowest(unshaped(noisy))).toBeGreaterThanOrEqual(0.95 * slowest(unshaped(clean)));
      }),
      { numRuns: cases(1_000, 12) },
    );
  });

  it("change the time of lines with corners by at most 1 %, and that of each part below 10 µm", () => {
    fc.assert(
      fc.property(cornered, real(0.3, 20), fc.nat(), (line, perSegment, seed) => {
        const clean = drawS(planned([line], mode));
        const noisy = drawS(planned([withNoise(line, perSegment, seed)], mode));
        expect(Math.abs(noisy - clean)).toBeLessThanOrEqual(0.01 * clean + 1e-3 + tinyS(line, mode));
      }),
      { numRuns: cases(1_000, 25) },
    );
  });
});

describe("points within 1 µm of a sample's lines", () => {
  const names = IS_FULL
    ? ["flower-meadow", "three-colour-hills", "harmonograph", "whirling-triangles", "hello-paper", "moonrise"]
    : ["three-colour-hills", "flower-meadow"];
  it.each(names)("change the time of %s by at most 0.2 % in all modes", async (name) => {
    const lines = await linesOf(name);
    const noisy = lines.map((line, i) => withNoise(line, 1, i));
    for (const mode of IS_FULL ? CASES : [CASES[2]]) {
      expect(Math.abs(drawS(planned(noisy, mode)) / drawS(planned(lines, mode)) - 1)).toBeLessThan(0.002);
    }
  });
});

describe("a resampled line", () => {
  it("stays near the drawing, with the same ends, and covers its whole length", () => {
    fc.assert(
      fc.property(arbitraryStroke, fc.boolean(), fc.nat(), (line, isNoisy, seed) => {
        const strokes = strokeSetOf([isNoisy ? withNoise(line, 1, seed) : line]);
        const path = new RunPath();
        path.load(strokes.xy, 0, strokes.xy.length / 2, 0);
        const last = path.segmentCount;
        const end = [path.x[last], path.y[last]];
        const lengthMm = path.end().alongMm;
        new Resampler().resample(path);
        const count = path.segmentCount;
        const near = new NearStroke(strokes, 0);
        if (count > 0) expect([path.x[count], path.y[count]]).toEqual(end);
        if (count > 0) expect(path.end().alongMm).toBeCloseTo(lengthMm, 6);
        for (let i = 0; i < count; i++) {
          for (const share of [0, 0.5]) {
            const x = path.x[i] + share * (path.x[i + 1] - path.x[i]);
            const y = path.y[i] + share * (path.y[i + 1] - path.y[i]);
            expect(near.distance(x, y)).toBeLessThan(MAX_MOVED_MM);
          }
        }
      }),
      { numRuns: cases(1_000, 60) },
    );
  });

  it("is the drawing itself if its segments are at least 1 mm long and turn by at least 0.1 rad", () => {
    const turn = fc.tuple(real(0.1, 3), fc.constantFrom(-1, 1)).map(([angle, side]) => angle * side);
    const steps = fc.array(fc.tuple(real(1, 100), turn), { minLength: 2, maxLength: 20 });
    fc.assert(
      fc.property(steps, (drawn) => {
        const line: number[] = [0, 0];
        let heading = 0;
        for (const [mm, angle] of drawn) {
          heading += angle;
          line.push(
            line[line.length - 2] + mm * Math.cos(heading),
            line[line.length - 1] + mm * Math.sin(heading),
          );
        }
        const path = new RunPath();
        path.load(Float64Array.from(line), 0, line.length / 2, 0);
        new Resampler().resample(path);
        const points = [...path.x.subarray(0, path.segmentCount + 1)].flatMap((x, i) => [x, path.y[i]]);
        expect(points).toEqual(line);
      }),
      { numRuns: cases() },
    );
  });
});

async function linesOf(name: string): Promise<Point[][]> {
  const { xy, offsets } = await sampleStrokes(name);
  return Array.from({ length: offsets.length - 1 }, (_, stroke) =>
    Array.from({ length: offsets[stroke + 1] - offsets[stroke] }, (_, i): Point => {
      const point = offsets[stroke] + i;
      return [xy[2 * point], xy[2 * point + 1]];
    }),
  );
}
