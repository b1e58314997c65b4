import fc from "fast-check";
import { describe, expect, it } from "vitest";
import { DEFAULT_PEN, machineById, plan } from "../../../../../src/index.js";
import { MOTION_MODES } from "../../../../../src/internal.js";
import { strokeSetOf, type Point } from "../../../../support/drawings/arbitraries.js";
import { FastBoard } from "../../../../support/plots/virtual-plots.js";
import { cases } from "../../../../support/runs/full-run.js";

const real = (min: number, max: number) => fc.double({ min, max, noNaN: true });

/** Strokes within a page: far and near points, repeated ones, reversals. */
const stroke: fc.Arbitrary<Point[]> = fc
  .array(fc.oneof(fc.tuple(real(0, 200), real(0, 200)), fc.tuple(real(100, 100.5), real(100, 100.5))), {
    minLength: 1,
    maxLength: 8,
  })
  .chain((points) => fc.boolean().map((back) => (back ? [...points, ...[...points].reverse()] : points)));

/** Not too slow: a plot of hours has hundreds of thousands of commands. */
const limits = fc.record({
  speedMmPerS: real(30, 400),
  accelMmPerS2: real(300, 5_000),
  cornerMm: real(0.001, 1),
  jerkMmPerS3: real(5_000, 500_000),
});

describe("a compiled plan on the virtual board", () => {
  for (const firmware of ["2.4.4", "2.5.3", "2.8.1", "3.0.3"]) {
    it(`leaves the step counters at the predicted values after every command of any drawing (firmware ${firmware})`, () => {
      fc.assert(
        fc.property(
          fc.array(stroke, { minLength: 1, maxLength: 3 }),
          fc.constantFrom(...MOTION_MODES),
          limits,
          limits,
          (strokes, mode, draw, travel) => {
            const trajectory = plan(strokeSetOf(strokes), { mode, draw, travel, fit: null }, DEFAULT_PEN);
            const fast = new FastBoard(firmware, machineById("axidraw-v3"), DEFAULT_PEN);
            const stream = fast.compile(trajectory);
            const { boardS, firstWrong } = fast.play(stream);
            expect(firstWrong).toBeNull();
            expect(fast.errors).toEqual([]);
            expect(boardS).toBeCloseTo(stream.boardS[stream.count], 6);
            expect(fast.board.state()).toMatchObject({ steps1: 0, steps2: 0 });
          },
        ),
        { numRuns: cases(40) },
      );
    });
  }
});
