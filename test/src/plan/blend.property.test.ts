import fc from "fast-check";
import { describe, expect, it } from "vitest";
import { DEFAULT_PEN, plan, type StrokeSet } from "../../../src/index.js";
import {
  arbitraryLimits,
  arbitraryStroke,
  strokeSetOf,
  type Point,
} from "../../support/drawings/arbitraries.js";
import { worstOf } from "../../support/trajectories/trajectory-checks.js";
import { penMovesOf } from "../../../src/plan/pen/pen-moves.js";
import { cases } from "../../support/runs/full-run.js";
import { MAX_MOVED_MM } from "../../../src/plan/resample.js";

const real = (min: number, max: number) => fc.double({ min, max, noNaN: true });
const DELTA = 0.05;

/** Wavy lines of 0.1 to 1 mm per segment, like flattened curves. */
const wavy: fc.Arbitrary<Point[]> = fc
  .array(fc.tuple(real(0.1, 1), real(-0.4, 0.4)), { minLength: 3, maxLength: 60 })
  .map((steps) => {
    const points: Point[] = [[0, 0]];
    let heading = 0;
    for (const [length, turn] of steps) {
      heading += turn;
      const [x, y] = points[points.length - 1];
      points.push([x + length * Math.cos(heading), y + length * Math.sin(heading)]);
    }
    return points;
  });

describe("a plan in blend mode", () => {
  it("has blocks in order along the drawing, and stays within δ", () => {
    fc.assert(
      fc.property(fc.oneof(wavy, arbitraryStroke), arbitraryLimits, (points, draw) => {
        const strokes = strokesOf(points);
        const t = plan(strokes, { mode: "blend", draw, travel: draw, fit: null }, DEFAULT_PEN, {
          returnHome: false,
        });
        const run = Array.from(t.runs.stroke).indexOf(0);
        const size = Math.max(...points.flat().map(Math.abs), 1);
        const worst = worstOf(t, strokes, draw, draw, draw.cornerMm);
        expect(worst.distance).toBeLessThanOrEqual(draw.cornerMm * 1.0001 + MAX_MOVED_MM + 1e-6 * size);
        let before = 0;
        for (let k = t.runs.firstBlock[run]; k < t.runs.firstBlock[run + 1]; k++) {
          expect(t.alongMm[k]).toBeGreaterThanOrEqual(before - 1e-12 * size);
          before = t.alongMm[k];
        }
        let whole = 0;
        points.slice(1).forEach(([x, y], i) => (whole += Math.hypot(x - points[i][0], y - points[i][1])));
        expect(before).toBeLessThanOrEqual(whole * (1 + 1e-9) + 1e-6);
      }),
      { numRuns: cases(500) },
    );
  });
});

describe("a plan that resumes with the pen beside its line", () => {
  it("begins at the pen's position, without a travel or a lift, and stays within all limits", () => {
    fc.assert(
      fc.property(wavy, arbitraryLimits, real(0.05, 0.95), real(0, 6.3), (points, draw, share, way) => {
        const strokes = strokesOf(points);
        const steps = points.slice(1).map(([x, y], i) => Math.hypot(x - points[i][0], y - points[i][1]));
        const whole = steps.reduce((sum, step) => sum + step, 0);
        const from = { stroke: 0, alongMm: share * whole };
        const [x, y] = placeOn(points, steps, from.alongMm);
        const [startX, startY] = [x + DELTA * Math.cos(way), y + DELTA * Math.sin(way)];
        const options = { from, startX, startY, penOffsetMm: 1.01 * DELTA, returnHome: false };
        for (const mode of ["junction", "blend", "scurve"] as const) {
          const t = plan(strokes, { mode, draw, travel: draw, fit: null }, DEFAULT_PEN, options);
          expect(Array.from(t.runs.stroke)).toEqual([0]);
          expect(penMovesOf(t).map(({ up }) => up)).toEqual([false, true]);
          expect(Math.hypot(t.x[0] - startX, t.y[0] - startY)).toBeLessThan(1e-9);
          const worst = worstOf(t, strokes, draw, draw, draw.cornerMm + DELTA);
          expect(worst.accel).toBeLessThanOrEqual(1.001);
          expect(worst.gap).toBeLessThanOrEqual(1e-9);
          expect(worst.distance).toBeLessThanOrEqual(draw.cornerMm * 1.0001 + DELTA + MAX_MOVED_MM);
          const away = plan(strokes, { mode, draw, travel: draw, fit: null }, DEFAULT_PEN, {
            ...options,
            penOffsetMm: 0.99 * DELTA,
          });
          expect(Array.from(away.runs.stroke)).toEqual([-1, 0]);
        }
      }),
      { numRuns: cases(300) },
    );
  });
});

function placeOn(points: readonly Point[], steps: readonly number[], along: number): Point {
  let left = along;
  let i = 0;
  while (i + 1 < steps.length && left > steps[i]) left -= steps[i++];
  const share = left / steps[i];
  const [[x0, y0], [x1, y1]] = [points[i], points[i + 1]];
  return [x0 + share * (x1 - x0), y0 + share * (y1 - y0)];
}

const strokesOf = (points: readonly Point[]): StrokeSet => strokeSetOf([points]);
