import { describe, expect, it } from "vitest";
import { DEFAULT_PEN, plan } from "../../../src/index.js";
import type { MotionMode } from "../../../src/internal.js";
import { strokeSetOf, type Point } from "../../support/drawings/arbitraries.js";
import { blendLoss, junctionLoss, leastLoss } from "../../support/trajectories/corner-bound.js";

const [accel, deviation] = [500, 0.05];
/** mm on either side of the corner. */
const SIDE = 50;
const cases = [45, 90, 135].flatMap((deg) => [10, 50].map((speed) => ({ deg, speed })));

describe.each(cases)("an isolated corner of $deg° at $speed mm/s", ({ deg, speed }) => {
  const corner = { speed, accel, deviation, turn: (deg * Math.PI) / 180 };

  it("costs what the formulas predict, in junction and blend mode", () => {
    expect(lossInPlan("junction")).toBeCloseTo(junctionLoss(corner), 9);
    expect(lossInPlan("blend")).toBeCloseTo(blendLoss(corner), 9);
  });

  it("costs blend at most 17 ms more than the minimum of any motion within A, V and δ, or nothing", () => {
    const leastS = leastLoss(corner);
    expect(blendLoss(corner)).toBeGreaterThanOrEqual(leastS - 1e-4);
    expect(blendLoss(corner)).toBeLessThanOrEqual(Math.max(leastS + 0.017, 0.01));
  });

  /** Compared with one straight line of the same length. */
  function lossInPlan(mode: MotionMode): number {
    const [x, y] = [SIDE * Math.cos(corner.turn), SIDE * Math.sin(corner.turn)];
    return drawS(mode, [[0, 0], [SIDE, 0], [SIDE + x, y]]) - drawS(mode, [[0, 0], [2 * SIDE, 0]]); // prettier-ignore
  }

  function drawS(mode: MotionMode, points: readonly Point[]): number {
    const draw = { speedMmPerS: speed, accelMmPerS2: accel, cornerMm: deviation, jerkMmPerS3: 1e4 };
    const noPen = { ...DEFAULT_PEN, extraLiftMs: -500, extraDropMs: -500 };
    return plan(strokeSetOf([points]), { mode, draw, travel: draw, fit: null }, noPen, { returnHome: false })
      .totalS;
  }
});

describe("a corner met at high speed", () => {
  const cornerOf = (deg: number) => ({ speed: 50, accel, deviation, turn: (deg * Math.PI) / 180 });

  it("is planned by junction in less time than any motion needs, if it is sharp", () => {
    for (const deg of [60, 90, 120, 150]) {
      expect(junctionLoss(cornerOf(deg))).toBeLessThan(leastLoss(cornerOf(deg)) - 0.001);
    }
  });
});

describe("a corner met at √(2 A δ)/s", () => {
  it("costs nothing by blend, and time by junction, if it is sharp", () => {
    for (const deg of [90, 120, 150]) {
      const turn = (deg * Math.PI) / 180;
      const corner = { speed: Math.sqrt(2 * accel * deviation) / Math.sin(turn / 2), accel, deviation, turn };
      expect(blendLoss(corner)).toBeCloseTo(0, 9);
      expect(junctionLoss(corner)).toBeGreaterThan(0.0003);
    }
  });
});
