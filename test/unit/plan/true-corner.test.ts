import { describe, expect, it } from "vitest";
import { DEFAULT_PEN, plan } from "../../../src/index.js";
import type { MotionMode } from "../../../src/internal.js";
import { strokeSetOf, type Point } from "../../support/arbitraries.js";
import { blendLoss, junctionLoss, leastLoss } from "../../support/corner-bound.js";

const [accel, deviation] = [500, 0.05];
/** mm on either side of the corner. */
const SIDE = 50;
const cases = [45, 90, 135].flatMap((deg) => [10, 50].map((speed) => ({ deg, speed })));

describe.each(cases)("an isolated corner of $deg° at $speed mm/s", ({ deg, speed }) => {
  const corner = { speed, accel, deviation, turn: (deg * Math.PI) / 180 };

  it("costs what the formulas predict, in junction and blend mode", () => {
    expect(lossInPlan("junction")).toBeCloseTo(junctionLoss(corner), 9);
    expect(lossInPlan("blend")).toBeCloseTo(blendLoss(corner, SIDE), 9);
  });

  it("costs blend at most 7 % more than the minimum of any motion within A, V and δ, or nothing", () => {
    const leastS = leastLoss(corner);
    expect(blendLoss(corner, SIDE)).toBeGreaterThanOrEqual(leastS - 1e-4);
    expect(blendLoss(corner, SIDE)).toBeLessThanOrEqual(Math.max(1.07 * leastS, 0.01));
  });

  /** Compared with one straight line of the same length. */
  function lossInPlan(mode: MotionMode): number {
    const [x, y] = [SIDE * Math.cos(corner.turn), SIDE * Math.sin(corner.turn)];
    return drawS(mode, [[0, 0], [SIDE, 0], [SIDE + x, y]]) - drawS(mode, [[0, 0], [2 * SIDE, 0]]); // prettier-ignore
  }

  function drawS(mode: MotionMode, points: readonly Point[]): number {
    const draw = { speedMmPerS: speed, accelMmPerS2: accel, cornerMm: deviation, jerkMmPerS3: 1e4 };
    const noPen = { ...DEFAULT_PEN, liftMs: 0, dropMs: 0 };
    return plan(strokeSetOf([points]), { mode, draw, travel: draw }, noPen, { returnHome: false }).totalS;
  }
});

describe("a corner met at high speed", () => {
  const cornerOf = (deg: number) => ({ speed: 50, accel, deviation, turn: (deg * Math.PI) / 180 });

  it("is planned by junction in less time than any motion needs, if it is sharp", () => {
    for (const deg of [60, 90, 120, 150]) {
      expect(junctionLoss(cornerOf(deg))).toBeLessThan(leastLoss(cornerOf(deg)) - 0.001);
    }
  });

  it("takes less time by blend than by junction, if it is shallow", () => {
    for (const deg of [20, 30, 40]) {
      expect(blendLoss(cornerOf(deg), SIDE)).toBeLessThan(junctionLoss(cornerOf(deg)) - 0.001);
    }
  });
});
