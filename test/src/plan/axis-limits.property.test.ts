/** Limits of single axes hold at every instant, in every mode, merged and not, with the other promises of a plan. */
import fc from "fast-check";
import { describe, expect, it } from "vitest";
import { DEFAULT_PEN, plan, type MotionSettings, type Trajectory } from "../../../src/index.js";
import { DEFAULT_FIT, MOTION_MODES } from "../../../src/internal.js";
import { blockState, newMotionState } from "../../../src/plan/trajectory.js";
import {
  arbitraryGridStroke,
  arbitraryLimits,
  strokeSetOf,
  type Point,
} from "../../support/drawings/arbitraries.js";
import { cases } from "../../support/runs/full-run.js";
import { swinging } from "../../support/machines/swinging.js";
import { worstOf } from "../../support/trajectories/trajectory-checks.js";
import { MAX_MOVED_MM } from "../../../src/plan/resample.js";

const RUNS = { numRuns: cases(60) };
const real = (min: number, max: number) => fc.double({ min, max, noNaN: true });
const arbitraryStrokes = fc.array(arbitraryGridStroke, { minLength: 1, maxLength: 3 });
const arbitraryAxes = fc.record({
  speedXMmPerS: fc.option(real(5, 300)),
  speedYMmPerS: fc.option(real(5, 300)),
  accelXMmPerS2: fc.option(real(20, 3_000)),
  accelYMmPerS2: fc.option(real(20, 3_000)),
});

/** Largest speed and acceleration of each axis. */
function topsOf(t: Trajectory) {
  const tops = { vx: 0, vy: 0, ax: 0, ay: 0 };
  const state = newMotionState();
  for (let k = 0; k < t.blockCount; k++) {
    for (let i = 0; i <= 4; i++) {
      blockState(t, k, (t.durationS[k] * i) / 4, state);
      for (const of of ["vx", "vy", "ax", "ay"] as const) tops[of] = Math.max(tops[of], Math.abs(state[of]));
    }
  }
  return tops;
}

function expectWithin(t: Trajectory, motion: MotionSettings): void {
  const tops = topsOf(t);
  expect(tops.vx).toBeLessThanOrEqual(1.001 * (motion.speedXMmPerS ?? Infinity));
  expect(tops.vy).toBeLessThanOrEqual(1.001 * (motion.speedYMmPerS ?? Infinity));
  expect(tops.ax).toBeLessThanOrEqual(1.001 * (motion.accelXMmPerS2 ?? Infinity));
  expect(tops.ay).toBeLessThanOrEqual(1.001 * (motion.accelYMmPerS2 ?? Infinity));
}

describe.each(MOTION_MODES)("limits of single axes, in mode %s", (mode) => {
  it.each([
    ["not merged", null],
    ["merged", DEFAULT_FIT],
  ])("hold at every instant, %s", (_, fit) => {
    fc.assert(
      fc.property(arbitraryStrokes, arbitraryLimits, arbitraryAxes, (lines, limits, axes) => {
        const motion: MotionSettings = { mode, draw: limits, travel: limits, fit, ...axes };
        const strokes = strokeSetOf(lines);
        const t = plan(strokes, motion, DEFAULT_PEN);
        expectWithin(t, motion);
        const deviation = (mode === "junction" ? 0 : limits.cornerMm) + (fit?.toleranceMm ?? 0);
        const worst = worstOf(t, strokes, limits, limits, deviation);
        expect(worst.finite).toBe(true);
        expect(worst.speed).toBeLessThanOrEqual(1.001);
        expect(worst.accel).toBeLessThanOrEqual(1.001);
        expect(worst.gap).toBeLessThanOrEqual(1e-8);
        expect(worst.distance).toBeLessThanOrEqual(deviation * 1.001 + MAX_MOVED_MM);
        if (mode !== "junction") expect(worst.velocityJump).toBeLessThan(1e-6);
        if (mode === "scurve") expect(worst.jerk).toBeLessThanOrEqual(1.001);
      }),
      RUNS,
    );
  });
});

describe("limits of single axes", () => {
  it("hold for a shaped motion too", () => {
    const motion: MotionSettings = {
      mode: "blend",
      shaper: "zv",
      fit: DEFAULT_FIT,
      draw: { speedMmPerS: 100, accelMmPerS2: 1_500, cornerMm: 0.025, jerkMmPerS3: 1 },
      travel: { speedMmPerS: 200, accelMmPerS2: 2_000, cornerMm: 0.5, jerkMmPerS3: 1 },
    };
    const machine = swinging({ xHz: 15, yHz: 25, damping: 0.05 });
    fc.assert(
      fc.property(arbitraryStrokes, arbitraryAxes, (lines, axes) => {
        const t = plan(strokeSetOf(lines), { ...motion, ...axes }, DEFAULT_PEN, { machine });
        expectWithin(t, { ...motion, ...axes });
        expectWithin(t.planned!.trajectory, { ...motion, ...axes });
      }),
      RUNS,
    );
  });

  const motion: MotionSettings = {
    mode: "blend",
    fit: null,
    draw: { speedMmPerS: 100, accelMmPerS2: 1_000, cornerMm: 0.025, jerkMmPerS3: 1 },
    travel: { speedMmPerS: 100, accelMmPerS2: 1_000, cornerMm: 0.5, jerkMmPerS3: 1 },
  };
  const timeOf = (dx: number, dy: number, axes: Partial<MotionSettings>): number =>
    plan(
      strokeSetOf([
        [
          [0, 0],
          [dx, dy],
        ],
      ]),
      { ...motion, ...axes },
      DEFAULT_PEN,
      { returnHome: false },
    )
      .durationS // prettier-ignore
      .reduce((sum, s) => sum + s, 0);

  it("hold on a line of 2 km that bends a little, where rounding could stretch a short phase", () => {
    const line: Point[] = [
      [0, 0],
      [955336.489, 295520.207],
      [1910672.978, 591040.413],
      [1910672.988, 591040.416],
    ];
    const draw = { speedMmPerS: 100, accelMmPerS2: 1_500, cornerMm: 0.025, jerkMmPerS3: 1 };
    const axes = { speedXMmPerS: 5, accelXMmPerS2: 20, accelYMmPerS2: 25.416961697007732 };
    const motion: MotionSettings = { mode: "blend", fit: null, draw, travel: draw, ...axes };
    expectWithin(plan(strokeSetOf([line]), motion, DEFAULT_PEN), motion);
  });

  it("slow only motion along that axis", () => {
    expect(timeOf(100, 0, { accelYMmPerS2: 250 })).toBeCloseTo(timeOf(100, 0, {}), 9);
    // 100 mm at 1000 mm/s² and 100 mm/s take 1 + 0.1 s, at 250 mm/s² 1 + 0.4 s.
    expect(timeOf(0, 100, { accelYMmPerS2: 250 })).toBeCloseTo(1.4, 9);
    expect(timeOf(0, 100, { speedYMmPerS: 50 })).toBeCloseTo(2.05, 9);
    expect(timeOf(100, 0, { speedYMmPerS: 50 })).toBeCloseTo(1.1, 9);
  });

  it("must be more than 0", () => {
    expect(() => timeOf(10, 10, { accelXMmPerS2: 0 })).toThrow(/acceleration along x is 0/);
  });
});
