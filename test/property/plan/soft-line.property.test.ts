import fc from "fast-check";
import { describe, expect, it } from "vitest";
import { DEFAULT_PEN, plan, type StrokeSet } from "../../../src/index.js";
import { LeastBending } from "../../../src/plan/least-bending.js";
import type { RunLimits } from "../../../src/plan/limits.js";
import { RunPath } from "../../../src/plan/run-path.js";
import { SoftLine } from "../../../src/plan/soft-line.js";
import { arbitraryLimits, arbitraryStroke, strokeSetOf, type Point } from "../../support/arbitraries.js";
import { NearStroke, worstOf } from "../../support/trajectory-checks.js";
import { penMovesOf } from "../../../src/plan/pen-moves.js";
import { cases } from "../../support/full-run.js";
import { MAX_MOVED_MM } from "../../../src/plan/resample.js";

const real = (min: number, max: number) => fc.double({ min, max, noNaN: true });
const DELTA = 0.05;
const ROUNDING_MM = 1e-15;
const limits = (speed: number): RunLimits => ({
  speed,
  accel: 500,
  jerk: Infinity,
  corner: DELTA,
  motorSpeed: Infinity,
  speedX: Infinity,
  speedY: Infinity,
  stretchX: 1,
  stretchY: 1,
  mixed: false,
  easeSpeed: Infinity,
});

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

describe("the soft line of a wavy line", () => {
  it("bends less in total, within δ, from the same start to the same end", () => {
    fc.assert(
      fc.property(wavy, (points) => {
        const path = pathOf(points);
        const soft = new SoftLine().of(path, limits(50));
        const n = path.segmentCount;
        expect(soft.segmentCount).toBe(n);
        expect([soft.x[0], soft.y[0], soft.x[n], soft.y[n]]).toEqual([
          path.x[0],
          path.y[0],
          path.x[n],
          path.y[n],
        ]);
        const near = new NearStroke(strokesOf(points), 0);
        for (let i = 0; i < n; i++) {
          for (const share of [0, 0.25, 0.5, 0.75]) {
            const x = soft.x[i] + share * soft.length[i] * soft.ux[i];
            const y = soft.y[i] + share * soft.length[i] * soft.uy[i];
            expect(near.distance(x, y)).toBeLessThanOrEqual(DELTA + 1e-9);
          }
        }
        expect(bending(soft)).toBeLessThanOrEqual(bending(path) * (1 + 1e-9));
      }),
      { numRuns: cases() },
    );
  });

  it("is that line itself if V is so low that no bend slows the pen down", () => {
    fc.assert(
      fc.property(wavy, (points) => {
        const path = pathOf(points);
        expect(new SoftLine().of(path, limits(1))).toBe(path);
      }),
      { numRuns: cases(200) },
    );
  });
});

describe("the minimum bending between bounds", () => {
  it("is close to that of an exhaustive search, and within the bounds", () => {
    const problem = fc.array(fc.tuple(real(0.2, 1), real(-0.3, 0.3), real(0, 0.05), real(0, 0.05)), {
      minLength: 3,
      maxLength: 14,
    });
    let [found, least] = [0, 0];
    for (const parts of fc.sample(problem, { numRuns: 60, seed: 7 })) {
      const n = parts.length;
      const length = Float64Array.from(parts, ([l]) => l);
      const turn = [0, ...parts.slice(1).map(([, t]) => t), 0];
      const low = [0, ...parts.slice(1).map(([, , b]) => -b), 0];
      const high = [0, ...parts.slice(1).map(([, , , b]) => b), 0];
      const solver = new LeastBending();
      solver.reserve(n + 1);
      solver.turn.set(turn);
      solver.low.set(low);
      solver.high.set(high);
      solver.solve(n, length);
      const y = Array.from(solver.y.subarray(0, n + 1));
      expect(y.every((v, i) => v >= low[i] - ROUNDING_MM && v <= high[i] + ROUNDING_MM)).toBe(true);
      found += energyOf(y, turn, length);
      least += energyOf(searched(turn, low, high, length), turn, length);
    }

    expect(found / least).toBeLessThan(1.01);
    expect(found / least).toBeGreaterThan(0.999);
  });
});

describe("a plan in blend mode", () => {
  it("has blocks in order along the drawing, and stays within δ", () => {
    fc.assert(
      fc.property(fc.oneof(wavy, arbitraryStroke), arbitraryLimits, (points, draw) => {
        const strokes = strokesOf(points);
        const t = plan(strokes, { mode: "blend", draw, travel: draw }, DEFAULT_PEN, { returnHome: false });
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
        const options = { from, startX, startY, penBesideMm: 1.01 * DELTA, returnHome: false };
        for (const mode of ["junction", "blend", "scurve"] as const) {
          const t = plan(strokes, { mode, draw, travel: draw }, DEFAULT_PEN, options);
          expect(Array.from(t.runs.stroke)).toEqual([0]);
          expect(penMovesOf(t).map(({ up }) => up)).toEqual([false, true]);
          expect(Math.hypot(t.x[0] - startX, t.y[0] - startY)).toBeLessThan(1e-9);
          const worst = worstOf(t, strokes, draw, draw, draw.cornerMm + DELTA);
          expect(worst.accel).toBeLessThanOrEqual(1.001);
          expect(worst.gap).toBeLessThanOrEqual(1e-9);
          expect(worst.distance).toBeLessThanOrEqual(draw.cornerMm * 1.0001 + DELTA + MAX_MOVED_MM);
          const away = plan(strokes, { mode, draw, travel: draw }, DEFAULT_PEN, {
            ...options,
            penBesideMm: 0.99 * DELTA,
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

function pathOf(points: readonly Point[]): RunPath {
  const path = new RunPath();
  path.load(Float64Array.from(points.flat()), 0, points.length, 0);
  return path;
}

const strokesOf = (points: readonly Point[]): StrokeSet => strokeSetOf([points]);

/** Σ φ²/min(ℓ), which the soft line minimises. */
function bending({ segmentCount: n, ux, uy, length }: RunPath): number {
  let sum = 0;
  for (let i = 1; i < n; i++) {
    const shorter = Math.min(length[i - 1], length[i]);
    const turn = Math.atan2(ux[i - 1] * uy[i] - uy[i - 1] * ux[i], ux[i - 1] * ux[i] + uy[i - 1] * uy[i]);
    sum += turn ** 2 / shorter;
  }
  return sum;
}

function energyOf(y: readonly number[], turn: readonly number[], length: Float64Array): number {
  let sum = 0;
  for (let i = 1; i + 1 < y.length; i++) {
    const [before, after] = [length[i - 1], length[i]];
    const t = turn[i] + (y[i + 1] - y[i]) / after - (y[i] - y[i - 1]) / before;
    sum += (t * t) / Math.min(before, after);
  }
  return sum;
}

/** Coordinate descent: each point to the minimum of its parabola, until nothing moves. */
function searched(
  turn: readonly number[],
  low: readonly number[],
  high: readonly number[],
  length: Float64Array,
): number[] {
  const y = turn.map(() => 0);
  for (let round = 0; round < 1500; round++) {
    let moved = 0;
    for (let i = 1; i + 1 < y.length; i++) {
      const at = (v: number): number => energyOf(Object.assign([...y], { [i]: v }), turn, length);
      const [e0, e1, e2] = [at(-1), at(0), at(1)];
      const bottom = (e0 - e2) / (2 * (e0 - 2 * e1 + e2));
      const v = Math.min(high[i], Math.max(low[i], bottom));
      moved = Math.max(moved, Math.abs(v - y[i]));
      y[i] = v;
    }
    if (moved < 1e-7) break;
  }
  return y;
}
