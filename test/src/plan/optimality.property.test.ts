import fc from "fast-check";
import { describe, expect, it } from "vitest";
import { DEFAULT_PEN, plan } from "../../../src/index.js";
import type { MotionLimits, MotionMode } from "../../../src/internal.js";
import { arbitraryLimits, strokeSetOf, type Point } from "../../support/drawings/arbitraries.js";
import { cornersOf, distance, type Limits } from "../../support/reference-planners/polyline.js";
import { junctionDeviation } from "../../support/reference-planners/systems.js";
import { cases } from "../../support/runs/full-run.js";
import { limitBlends } from "../../../src/plan/corners/blend-rule.js";
import { capSegments, NO_LIMITS } from "../../../src/plan/limits.js";
import { lookAhead } from "../../../src/plan/corners/look-ahead.js";
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

describe("the time of a small path", () => {
  it("in junction mode is within 0.5 % of the fastest profile under the corner limits", () => {
    fc.assert(
      fc.property(smallPath, arbitraryLimits, (points, draw) => {
        const { durationS, blockCount } = planned(points, "junction", draw);
        const time = durationS.subarray(0, blockCount).reduce((sum, s) => sum + s, 0);
        const { speedMmPerS: speed, accelMmPerS2: accel, cornerMm: deviation } = draw;
        const optimum = fastestProfile(resampled(points), { speed, accel, deviation });
        expect(time).toBeLessThanOrEqual(1.005 * optimum);
        expect(time).toBeGreaterThanOrEqual(0.9999 * optimum);
      }),
      RUNS,
    );
  });
});

describe("the speeds at the corners of a small path in blend mode", () => {
  it("obey every limit, and each is as high as its own limit or a neighbour allows", () => {
    fc.assert(
      fc.property(smallPath, arbitraryLimits, (points, draw) => {
        const path = pathOf(points);
        const [n, accel] = [path.segmentCount, draw.accelMmPerS2];
        const limits = { ...NO_LIMITS, speed: draw.speedMmPerS, accel, corner: draw.cornerMm };
        capSegments(path, limits);
        limitBlends(path, limits);
        const { sine, length } = path;
        const highest = path.v2.slice(0, n + 1);
        lookAhead(path, accel);
        const v2 = path.v2.slice(0, n + 1);
        // The highest speed² of corner i that a neighbour, over segment k, allows.
        const allowed = (i: number, neighbour: number, k: number): number =>
          (v2[neighbour] * (1 - 2 * sine[neighbour]) + 2 * accel * length[k]) / (1 + 2 * sine[i]);
        for (let i = 1; i < n; i++) {
          const limit = Math.min(highest[i], allowed(i, i - 1, i - 1), allowed(i, i + 1, i));
          expect(v2[i]).toBeGreaterThan(0);
          expect(v2[i] / limit).toBeCloseTo(1, 9);
        }
      }),
      RUNS,
    );
  });
});

/** The points that the planner uses. */
function resampled(points: readonly Point[]): Point[] {
  const path = pathOf(points);
  return Array.from({ length: path.segmentCount + 1 }, (_, i): Point => [path.x[i], path.y[i]]);
}

function pathOf(points: readonly Point[]): RunPath {
  const path = new RunPath();
  path.load(Float64Array.from(points.flat()), 0, points.length, 0);
  new Resampler().resample(path);
  return path;
}

function planned(points: readonly Point[], mode: MotionMode, draw: MotionLimits) {
  return plan(strokeSetOf([points]), { mode, draw, travel: draw, fit: null }, DEFAULT_PEN, {
    returnHome: false,
  });
}

/**
 * By the definition of the optimum and by brute force: speed² at a place is the minimum, over all limits, of
 * the limit plus 2 A times the distance to it; the time is integrated over a fine grid.
 */
function fastestProfile(points: readonly Point[], limits: Limits): number {
  const { speed, accel, deviation } = limits;
  const places = [0];
  points.slice(1).forEach((p, i) => places.push(places[i] + distance(points[i], p)));
  const turns = cornersOf(points);
  // At one speed the tangents of two corners are as long as their sines: so they share the segment between them. One also
  // takes what the other can't use within the deviation.
  const share = (mm: number, turn: number, other = 0): number => {
    const [s, t] = [Math.sin(turn / 2), Math.sin(other / 2)];
    return t === 0 ? mm : Math.max((mm * s) / (s + t), mm - (2 * deviation) / t);
  };
  const corners = turns.map((corner, i) => {
    const { before, after, turn } = corner;
    const tangent = Math.min(share(before, turn, turns[i - 1]?.turn), share(after, turn, turns[i + 1]?.turn));
    const circle = (accel * tangent) / Math.tan(turn / 2);
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
