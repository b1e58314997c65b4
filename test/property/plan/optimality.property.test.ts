import fc from "fast-check";
import { describe, expect, it } from "vitest";
import { DEFAULT_PEN, plan } from "../../../src/index.js";
import type { MotionLimits, MotionMode } from "../../../src/internal.js";
import { arbitraryLimits, strokeSetOf, type Point } from "../../support/arbitraries.js";
import { optimalRunTime } from "../../support/path-optimum.js";
import { cornersOf, distance, type Limits } from "../../support/reference-planners/polyline.js";
import { junctionDeviation } from "../../support/reference-planners/systems.js";
import { cases } from "../../support/full-run.js";
import { Resampler } from "../../../src/plan/resample.js";
import { RunPath } from "../../../src/plan/run-path.js";

const RUNS = { numRuns: cases(500) };
const real = (min: number, max: number) => fc.double({ min, max, noNaN: true });

/** Small paths of 0.1 to 50 mm per segment, with turns up to nearly a reversal. */
const smallPath: fc.Arbitrary<Point[]> = fc
  .tuple(
    fc.constantFrom(1, 5, 25),
    fc.array(fc.tuple(real(0.1, 2), real(-3, 3)), { minLength: 2, maxLength: 10 }),
  )
  .map(([size, steps]) => {
    const points: Point[] = [[0, 0]];
    let heading = 0;
    for (const [length, turn] of steps) {
      heading += turn;
      const [x, y] = points[points.length - 1];
      points.push([x + size * length * Math.cos(heading), y + size * length * Math.sin(heading)]);
    }
    return points;
  });

const NO_PEN = { ...DEFAULT_PEN, liftMs: 0, dropMs: 0 };

describe("the time of a small path", () => {
  it("in junction mode is within 0.5 % of the fastest profile under the corner limits", () => {
    fc.assert(
      fc.property(smallPath, arbitraryLimits, (points, draw) => {
        const time = planned(points, "junction", draw).totalS;
        const { speedMmPerS: speed, accelMmPerS2: accel, cornerMm: deviation } = draw;
        const optimum = fastestProfile(resampled(points), { speed, accel, deviation });
        expect(time).toBeLessThanOrEqual(1.005 * optimum);
        expect(time).toBeGreaterThanOrEqual(0.9999 * optimum);
      }),
      RUNS,
    );
  });

  it("in blend mode is at most 0.5 % above that of the time-optimal motion on the same line, and never below it", () => {
    fc.assert(
      fc.property(smallPath, arbitraryLimits, (points, draw) => {
        const trajectory = planned(points, "blend", draw);
        const optimum = optimalRunTime(trajectory, 0, draw.speedMmPerS, draw.accelMmPerS2);
        expect(trajectory.totalS).toBeLessThanOrEqual(1.005 * optimum);
        expect(trajectory.totalS).toBeGreaterThanOrEqual(0.9999 * optimum);
      }),
      RUNS,
    );
  });
});

/** The points that the planner uses. */
function resampled(points: readonly Point[]): Point[] {
  const path = new RunPath();
  path.load(Float64Array.from(points.flat()), 0, points.length, 0);
  new Resampler().resample(path);
  return Array.from({ length: path.segmentCount + 1 }, (_, i): Point => [path.x[i], path.y[i]]);
}

function planned(points: readonly Point[], mode: MotionMode, draw: MotionLimits) {
  return plan(strokeSetOf([points]), { mode, draw, travel: draw }, NO_PEN, { returnHome: false });
}

/**
 * By the definition of the optimum and by brute force: speed² at a place is the minimum, over all limits, of
 * the limit plus 2 A times the distance to it; the time is integrated over a fine grid.
 */
function fastestProfile(points: readonly Point[], limits: Limits): number {
  const { speed, accel } = limits;
  const places = [0];
  points.slice(1).forEach((p, i) => places.push(places[i] + distance(points[i], p)));
  const corners = cornersOf(points).map((corner) => {
    const circle = (accel * Math.min(corner.before, corner.after)) / 2 / Math.tan(corner.turn / 2);
    return Math.min(junctionDeviation(corner, limits) ** 2, circle);
  });
  const limit2 = [0, ...corners, 0];
  const v = (s: number): number =>
    Math.sqrt(Math.min(speed ** 2, ...limit2.map((l, i) => l + 2 * accel * Math.abs(s - places[i]))));
  let time = 0;
  const cells = 400;
  for (let i = 0; i + 1 < places.length; i++) {
    const length = places[i + 1] - places[i];
    // Cells are denser at both ends, where speed changes most.
    const at = (k: number): number => places[i] + (length * (1 - Math.cos((Math.PI * k) / cells))) / 2;
    for (let k = 0; k < cells; k++) time += (2 * (at(k + 1) - at(k))) / (v(at(k)) + v(at(k + 1)));
  }
  return time;
}
