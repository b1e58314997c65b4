/** Guarantees of a shaped motion, besides those of its planned motion (docs/motion.md). */
import fc from "fast-check";
import { describe, expect, it } from "vitest";
import { DEFAULT_MOTION, DEFAULT_PEN, plan, stateAt, type Trajectory } from "../../../src/index.js";
import { maxShapingErrorMm } from "../../../src/plan/shaping/shapers.js";
import { SpringAxis } from "../../../src/plan/shaping/spring-axis.js";
import { blockState, newMotionState } from "../../../src/plan/trajectory.js";
import { SHAPERS, type Shaper } from "../../../src/settings/motion.js";
import { arbitraryGridStroke, strokeSetOf, type Point } from "../../support/drawings/arbitraries.js";
import { cases } from "../../support/runs/full-run.js";
import { swinging } from "../../support/machines/swinging.js";

const RUNS = { numRuns: cases(60) };
const real = (min: number, max: number) => fc.double({ min, max, noNaN: true });

/** Merged blocks may leave the shaped motion by this, mm (run-writer.ts). */
const MERGED_MM = 0.0055;
/** Short ones by this. */
const SHORT_MM = 0.02;

const arbitrarySprings = fc.record({ xHz: real(8, 50), yHz: real(8, 50), damping: real(0.03, 0.15) });
const arbitraryStrokes = fc.array(arbitraryGridStroke, { minLength: 1, maxLength: 3 });
const arbitraryAccel = real(200, 3_000);
const arbitraryShaper = fc.constantFrom(...SHAPERS.filter((shaper) => shaper !== "none"));

const motionOf = (shaper: Shaper, accelMmPerS2: number) => ({
  ...DEFAULT_MOTION,
  shaper,
  draw: { ...DEFAULT_MOTION.draw, speedMmPerS: 100, accelMmPerS2 },
});

/** Calls `see` at the runs' ends and at instants within, with the swinging pen's distance from the carriage. */
function walk(
  t: Trajectory,
  axes: readonly [SpringAxis, SpringAxis],
  see: (run: number, tS: number, x: number, y: number) => void,
): void {
  const state = newMotionState();
  const [axisX, axisY] = axes;
  for (let run = 0; run < t.runs.count; run++) {
    for (const axis of axes) axis.d = axis.rate = 0;
    for (let k = t.runs.firstBlock[run]; k < t.runs.firstBlock[run + 1]; k++) {
      const steps = Math.min(40, Math.max(1, Math.ceil(t.durationS[k] / 0.003)));
      const dt = t.durationS[k] / steps;
      for (let i = 1; i <= steps; i++) {
        axisX.advance(dt, t.ax[k]);
        axisY.advance(dt, t.ay[k]);
        blockState(t, k, i * dt, state);
        see(run, t.startS[k] + i * dt, state.x, state.y);
      }
    }
  }
}

describe("a shaped motion", () => {
  it("has the same planned motion as without a shaper up to the default's acceleration, at which no run is slowed", () => {
    fc.assert(
      fc.property(
        arbitraryStrokes,
        arbitrarySprings,
        real(200, DEFAULT_MOTION.draw.accelMmPerS2),
        (strokes: Point[][] | readonly (readonly Point[])[], springs, accel) => {
          const set = strokeSetOf(strokes);
          const machine = swinging(springs);
          const before = plan(set, motionOf("zv", accel), DEFAULT_PEN, { machine }).planned!.trajectory;
          const plain = plan(set, motionOf("none", accel), DEFAULT_PEN, { machine });
          expect(before.blockCount).toBe(plain.blockCount);
          for (const column of ["durationS", "x", "y", "vx", "vy", "ax", "ay", "alongMm"] as const) {
            // The clocks differ, and with them the rounding.
            for (let k = 0; k < plain.blockCount; k++) {
              expect(Math.abs(before[column][k] - plain[column][k])).toBeLessThan(
                1e-6 * (1 + Math.abs(plain[column][k])),
              );
            }
          }
        },
      ),
      RUNS,
    );
  });

  it("takes each run at most as fast as without a shaper, and none slower than with the default's acceleration", () => {
    fc.assert(
      fc.property(arbitraryStrokes, arbitrarySprings, real(500, 3_000), (strokes, springs, accel) => {
        const set = strokeSetOf(strokes);
        const machine = swinging(springs);
        const secondsOf = ({ durationS, blockCount, runs }: Trajectory): number[] =>
          Array.from({ length: runs.count }, (_, run) =>
            durationS
              .subarray(runs.firstBlock[run], Math.min(blockCount, runs.firstBlock[run + 1]))
              .reduce((sum, s) => sum + s, 0),
          );
        const planned = secondsOf(
          plan(set, motionOf("zv", accel), DEFAULT_PEN, { machine }).planned!.trajectory,
        );
        const [fast, calm] = [accel, 500].map((one) =>
          secondsOf(plan(set, motionOf("none", one), DEFAULT_PEN, { machine })),
        );
        for (const [run, seconds] of planned.entries()) {
          expect(seconds).toBeGreaterThanOrEqual(0.99 * fast[run]);
          expect(seconds).toBeLessThanOrEqual(1.01 * calm[run]);
        }
      }),
      RUNS,
    );
  });

  it("is the planned motion, delayed and weighed as the kernel says, at any moment", () => {
    fc.assert(
      fc.property(arbitraryStrokes, arbitrarySprings, arbitraryShaper, (strokes, springs, shaper) => {
        const machine = swinging(springs);
        const t = plan(strokeSetOf(strokes), motionOf(shaper, 2_000), DEFAULT_PEN, { machine });
        const { trajectory, kernel } = t.planned!;
        for (let i = 0; i <= 200; i++) {
          const atS = (t.totalS * i) / 200;
          const before = (delayS: number) => stateAt(trajectory, atS - delayS);
          const x = kernel.x.reduce((sum, { delayS, weight }) => sum + weight * before(delayS).x, 0);
          const y = kernel.y.reduce((sum, { delayS, weight }) => sum + weight * before(delayS).y, 0);
          const at = stateAt(t, atS);
          expect(Math.hypot(at.x - x, at.y - y)).toBeLessThan(SHORT_MM);
        }
      }),
      RUNS,
    );
  });

  it("keeps A in each axis, is continuous, and takes every run from rest to rest", () => {
    fc.assert(
      fc.property(
        arbitraryStrokes,
        arbitrarySprings,
        arbitraryAccel,
        arbitraryShaper,
        (strokes, springs, accel, shaper) => {
          const motion = motionOf(shaper, accel);
          const t = plan(strokeSetOf(strokes), motion, DEFAULT_PEN, { machine: swinging(springs) });
          const { runs, durationS } = t;
          for (let run = 0; run < runs.count; run++) {
            const limit = 1.001 * (runs.stroke[run] < 0 ? motion.travel.accelMmPerS2 : accel);
            const [first, end] = [runs.firstBlock[run], runs.firstBlock[run + 1]];
            for (let k = first; k < end; k++) {
              expect(Math.max(Math.abs(t.ax[k]), Math.abs(t.ay[k]))).toBeLessThanOrEqual(limit);
              const at = blockState(t, k, durationS[k], newMotionState());
              const next = k + 1 < end ? blockState(t, k + 1, 0, newMotionState()) : { ...at, vx: 0, vy: 0 };
              expect(Math.hypot(next.x - at.x, next.y - at.y)).toBeLessThan(1e-8);
              expect(Math.hypot(next.vx - at.vx, next.vy - at.vy)).toBeLessThan(1e-5);
            }
            if (first < end) expect(Math.hypot(t.vx[first], t.vy[first])).toBeLessThan(1e-5);
          }
        },
      ),
      RUNS,
    );
  });

  it("leaves the planned line by at most A σ²/2, and the place on the drawing never goes back", () => {
    fc.assert(
      fc.property(
        arbitraryStrokes,
        arbitrarySprings,
        arbitraryAccel,
        arbitraryShaper,
        (strokes, springs, accel, shaper) => {
          const motion = motionOf(shaper, accel);
          const t = plan(strokeSetOf(strokes), motion, DEFAULT_PEN, { machine: swinging(springs) });
          const { trajectory: planned, kernel } = t.planned!;
          // The limit applies to each axis, so both together may deviate by √2 as much.
          const allowed = Math.SQRT2 * maxShapingErrorMm(motion, springs) + SHORT_MM;
          let last = { run: -1, alongMm: 0 };
          walk(t, [new SpringAxis(20, 0), new SpringAxis(20, 0)], (run, tS, x, y) => {
            if (t.runs.stroke[run] < 0) return;
            const meant = stateAt(planned, Math.max(planned.runs.startS[run], tS - kernel.meanDelayS));
            expect(Math.hypot(meant.x - x, meant.y - y)).toBeLessThan(allowed);
            const { alongMm, stroke } = stateAt(t, tS - 1e-9);
            if (stroke < 0) return;
            if (last.run === run) expect(alongMm).toBeGreaterThanOrEqual(last.alongMm - 1e-6);
            last = { run, alongMm };
          });
        },
      ),
      RUNS,
    );
  });

  it("by zv keeps the pen on the machine's springs within A/(169 f²) of the planned line, and leaves no swing", () => {
    fc.assert(
      fc.property(arbitraryStrokes, arbitrarySprings, arbitraryAccel, (strokes, springs, accel) => {
        const t = plan(strokeSetOf(strokes), motionOf("zv", accel), DEFAULT_PEN, {
          machine: swinging(springs),
        });
        const { trajectory: planned, kernel } = t.planned!;
        const axes = [
          new SpringAxis(springs.xHz, springs.damping),
          new SpringAxis(springs.yHz, springs.damping),
        ] as const;
        // Both axes with √2, a fifth more for the damping; the jolts of merging swing a few times as far.
        const allowed =
          (1.2 * Math.SQRT2 * accel) / (169 * Math.min(springs.xHz, springs.yHz) ** 2) + 6 * MERGED_MM;
        walk(t, axes, (run, tS, x, y) => {
          const isEnd = tS > (t.runs.startS[run + 1] ?? t.totalS) - 1e-6;
          if (isEnd) expect(Math.hypot(axes[0].d, axes[1].d)).toBeLessThan(6 * MERGED_MM);
          if (t.runs.stroke[run] < 0) return;
          const meant = stateAt(planned, Math.max(planned.runs.startS[run], tS - kernel.meanDelayS));
          expect(Math.hypot(meant.x - x - axes[0].d, meant.y - y - axes[1].d)).toBeLessThan(allowed);
        });
      }),
      RUNS,
    );
  });
});
