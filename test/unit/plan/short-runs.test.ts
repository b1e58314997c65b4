/** Runs of a few straights: fitted by pairs of pieces from one state of the plan to another. */
import { describe, expect, it } from "vitest";
import { DEFAULT_FIT, DEFAULT_MOTION, DEFAULT_PEN, plan } from "../../../src/index.js";
import { strokesOf } from "../../support/local-planner.js";
import { worstOf } from "../../support/trajectory-checks.js";

const NO_HOME = { returnHome: false, startX: 50, startY: 50 };

/** Seconds of each piece. */
function pieces(line: readonly number[], fit: typeof DEFAULT_FIT | null): readonly number[] {
  const strokes = strokesOf(line);
  const trajectory = plan(strokes, { ...DEFAULT_MOTION, fit }, DEFAULT_PEN, NO_HOME);
  const { draw, travel } = DEFAULT_MOTION;
  const worst = worstOf(trajectory, strokes, draw, travel, draw.cornerMm + DEFAULT_FIT.toleranceMm);
  expect(worst.accel).toBeLessThanOrEqual(1.001);
  expect(worst.speed).toBeLessThanOrEqual(1.001);
  expect(worst.velocityJump).toBeLessThan(1e-6);
  expect(worst.distance).toBeLessThanOrEqual(draw.cornerMm + DEFAULT_FIT.toleranceMm + 2e-6);
  return [...trajectory.durationS];
}

const seconds = (durations: readonly number[]): number => durations.reduce((sum, s) => sum + s, 0);

const belowFloor = (durations: readonly number[]): number =>
  durations.filter((s) => s < DEFAULT_FIT.floorMs / 1000 - 1e-9).length;

/** A line on from (50, 50) and another, joined where they nearly meet. */
const joined = (turnDeg: number, gapDeg: number): number[] => {
  const at = (deg: number, mm: number) => [
    mm * Math.cos((deg * Math.PI) / 180),
    mm * Math.sin((deg * Math.PI) / 180),
  ];
  const [gapX, gapY] = at(gapDeg, 0.06);
  const [x, y] = at(turnDeg, 1.5);
  return [50, 50, 51.5, 50, 51.5 + gapX!, 50 + gapY!, 51.5 + gapX! + x!, 50 + gapY! + y!];
};

describe("lines joined by a tiny segment", () => {
  it("are drawn in fewer pieces than phases and corners, fewer of them below the floor, and in as little time", () => {
    const [plain, fitted]: [number[], number[]] = [[], []];
    for (let turnDeg = -165; turnDeg <= 165; turnDeg += 30) {
      for (let gapDeg = -160; gapDeg <= 160; gapDeg += 40) {
        plain.push(...pieces(joined(turnDeg, gapDeg), null));
        fitted.push(...pieces(joined(turnDeg, gapDeg), DEFAULT_FIT));
      }
    }
    expect(fitted.length / plain.length).toBeLessThan(0.94);
    expect(belowFloor(fitted) / belowFloor(plain)).toBeLessThanOrEqual(0.8);
    expect(seconds(fitted) / seconds(plain)).toBeLessThan(1.001);
  });
});

describe("a triangle", () => {
  it("keeps its sharp corners as planned, so that its line is as long as before", () => {
    const triangle = [50, 50, 80, 50, 65, 76, 50, 50];
    expect(pieces(triangle, DEFAULT_FIT)).toEqual(pieces(triangle, null));
  });
});
