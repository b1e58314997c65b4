import fc from "fast-check";
import { describe, expect, it } from "vitest";
import { DEFAULT_MOTION, DEFAULT_PEN, plan, stateAt, type Trajectory } from "../../../src/index.js";
import { timedPen } from "../../../src/plan/pen/pen-times.js";
import { comeToRest } from "../../../src/internal.js";
import { arbitraryGridStroke, strokeSetOf, type Point } from "../../support/drawings/arbitraries.js";
import { cases } from "../../support/runs/full-run.js";
import { NearStroke } from "../../support/trajectories/trajectory-checks.js";

/** The maximum speed on a curve: the drawing speed is never the limit. */
const MOTION = {
  ...DEFAULT_MOTION,
  mode: "blend" as const,
  draw: { ...DEFAULT_MOTION.draw, speedMmPerS: 400 },
};
const LIMITS = {
  drawAccel: MOTION.draw.accelMmPerS2,
  travelAccel: MOTION.travel.accelMmPerS2,
};

/** Max |a| of all blocks, and max jump of velocity from block to block, including the rest at the end. */
function worstOf(rest: Trajectory): { accel: number; jump: number } {
  let accel = 0;
  let jump = 0;
  const { blockCount, durationS, vx, vy, ax, ay } = rest;
  for (let k = 0; k < blockCount; k++) {
    accel = Math.max(accel, Math.hypot(ax[k], ay[k]));
    const next = k + 1 < blockCount ? [vx[k + 1], vy[k + 1]] : [0, 0];
    const dx = next[0] - vx[k] - ax[k] * durationS[k];
    const dy = next[1] - vy[k] - ay[k] * durationS[k];
    jump = Math.max(jump, Math.hypot(dx, dy));
  }
  return { accel, jump };
}

const circle = (r: number): Point[] =>
  Array.from({ length: 721 }, (_, i): Point => {
    const angle = (i / 360) * 2 * Math.PI;
    return [100 + r * Math.cos(angle), 100 + r * Math.sin(angle)];
  });

describe("a stop in the middle of a plan", () => {
  it.each([0.5, 2, 10, 30])("stays within the acceleration on a circle of %f mm taken at full speed", (r) => {
    const trajectory = plan(strokeSetOf([circle(r)]), MOTION, DEFAULT_PEN);
    const run = [...trajectory.runs.stroke].findIndex((stroke) => stroke === 0);
    const fromS = trajectory.runs.startS[run];
    const untilS = trajectory.runs.startS[run + 1];
    for (let i = 1; i < 40; i++) {
      const tS = fromS + ((untilS - fromS) * i) / 40;
      const { trajectory: rest } = comeToRest(trajectory, tS, LIMITS, timedPen(DEFAULT_PEN, null));
      const { accel, jump } = worstOf(rest);
      expect(accel).toBeLessThanOrEqual(1.001 * LIMITS.drawAccel);
      expect(jump).toBeLessThan(0.2);
    }
  });

  it("stays within the acceleration and on the path, and ends at rest at the reported place, on any path", () => {
    fc.assert(
      fc.property(
        fc.array(arbitraryGridStroke, { minLength: 1, maxLength: 3 }),
        fc.array(fc.double({ min: 0, max: 1, noNaN: true }), { minLength: 3, maxLength: 3 }),
        (strokes, shares) => {
          const set = strokeSetOf(strokes);
          const trajectory = plan(set, MOTION, DEFAULT_PEN);
          for (const share of shares) {
            const tS = share * trajectory.totalS;
            const before = stateAt(trajectory, tS);
            const { trajectory: rest, planS } = comeToRest(trajectory, tS, LIMITS, null);
            const allowed = before.penUp ? LIMITS.travelAccel : LIMITS.drawAccel;
            expect(worstOf(rest).accel).toBeLessThanOrEqual(1.001 * allowed);
            const end = stateAt(trajectory, planS);
            expect(Math.hypot(rest.endX - end.x, rest.endY - end.y)).toBeLessThan(1e-9);
            if (before.stroke < 0) continue;
            const near = new NearStroke(set, before.stroke);
            for (let k = 0; k < rest.blockCount; k++) {
              expect(near.distance(rest.x[k], rest.y[k])).toBeLessThan(MOTION.draw.cornerMm + 0.021);
            }
          }
        },
      ),
      { numRuns: cases(150) },
    );
  });
});
