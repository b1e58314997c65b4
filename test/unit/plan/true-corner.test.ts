import { describe, expect, it } from "vitest";
import { DEFAULT_PEN, plan, type MotionMode } from "../../../src/index.js";
import { strokeSetOf, type Point } from "../../support/arbitraries.js";
import { blendLoss, junctionLoss, leastLoss } from "../../support/corner-bound.js";

const [accel, deviation] = [500, 0.05];
const cases = [45, 90, 135].flatMap((deg) => [10, 50].map((speed) => ({ deg, speed })));

describe.each(cases)("an isolated corner of $deg° at $speed mm/s", ({ deg, speed }) => {
  const corner = { speed, accel, deviation, turn: (deg * Math.PI) / 180 };

  it("costs what the formulas say, in junction and blend mode", () => {
    expect(lossInPlan("junction")).toBeCloseTo(junctionLoss(corner), 9);
    expect(lossInPlan("blend")).toBeCloseTo(blendLoss(corner), 9);
  });

  it("costs blend at most 20 % more than any motion within A, V and δ could do with, or nothing", () => {
    expect(blendLoss(corner)).toBeGreaterThanOrEqual(leastLoss(corner) - 1e-4);
    expect(blendLoss(corner)).toBeLessThanOrEqual(Math.max(1.2 * leastLoss(corner), 0.01));
  });

  /** Against one straight line of the same length. */
  function lossInPlan(mode: MotionMode): number {
    const side = 50;
    const [x, y] = [side * Math.cos(corner.turn), side * Math.sin(corner.turn)];
    return drawS(mode, [[0, 0], [side, 0], [side + x, y]]) - drawS(mode, [[0, 0], [2 * side, 0]]); // prettier-ignore
  }

  function drawS(mode: MotionMode, points: readonly Point[]): number {
    const draw = { speedMmPerS: speed, accelMmPerS2: accel, cornerMm: deviation, jerkMmPerS3: 1e4 };
    const noPen = { ...DEFAULT_PEN, liftMs: 0, dropMs: 0 };
    return plan(strokeSetOf([points]), { mode, draw, travel: draw }, noPen, { returnHome: false }).totalS;
  }
});

describe("a corner met at high speed", () => {
  it("is planned by junction in less time than any motion needs", () => {
    for (const deg of [30, 60, 90, 120, 150]) {
      const corner = { speed: 50, accel, deviation, turn: (deg * Math.PI) / 180 };
      expect(junctionLoss(corner)).toBeLessThan(leastLoss(corner) - 0.002);
    }
  });
});
