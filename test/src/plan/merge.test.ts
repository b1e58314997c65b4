/** Merging: pairs of blocks replace longer sequences, exact at their ends and within ε between. */
import { describe, expect, it } from "vitest";
import { compile, DEFAULT_MOTION, DEFAULT_PEN, machineById, plan, stateAt } from "../../../src/index.js";
import { DEFAULT_FIT, type FitSettings, type MotionMode } from "../../../src/internal.js";
import { BlockColumns } from "../../../src/plan/block-columns.js";
import type { RunLimits } from "../../../src/plan/limits.js";
import { mergeBlocks, type MergeRules } from "../../../src/plan/merge.js";
import { strokeSetOf, type Point } from "../../support/drawings/arbitraries.js";
import { worstOf } from "../../support/trajectories/trajectory-checks.js";

const LIMITS: RunLimits = {
  speed: 50,
  accel: 500,
  jerk: Infinity,
  corner: 0.025,
  motorSpeed: Infinity,
  speedX: Infinity,
  speedY: Infinity,
  stretchX: 1,
  stretchY: 1,
  mixed: false,
  easeSpeed: Infinity,
};
const RULES: MergeRules = {
  toleranceMm: 0.02,
  shortToleranceMm: 0.02,
  floorS: 0.015,
  isSmooth: true,
  isShaped: false,
};

/** A run along x from rest, given as [seconds, acceleration] of each block. */
function straightRun(phases: readonly (readonly [number, number])[]): {
  readonly blocks: BlockColumns;
  readonly at: { x: number; y: number; alongMm: number };
} {
  const blocks = new BlockColumns(0, false);
  let [x, v] = [0, 0];
  for (const [s, a] of phases) {
    blocks.push(s, x, 0, v, 0, a, 0, x);
    x += s * (v + (s * a) / 2);
    v += s * a;
  }
  return { blocks, at: { x, y: 0, alongMm: x } };
}

/** A line of 100 000 points in continuous loops, as in dense handwriting. */
const LOOPS: Point[] = Array.from({ length: 100_000 }, (_, i) => {
  const u = i / 15;
  const along = 0.3 * u;
  return [20 + (along % 200) + 1.5 * Math.cos(u), 20 + 6 * Math.floor(along / 200) + 2 * Math.sin(u)];
});

describe("merging one run", () => {
  it("replaces a ramp cut into many blocks by two, from the same start to the same end in the same time", () => {
    const up = Array.from({ length: 20 }, (): [number, number] => [0.005, 400]);
    const down = Array.from({ length: 20 }, (): [number, number] => [0.005, -400]);
    const { blocks, at } = straightRun([...up, ...down]);
    mergeBlocks(blocks, 0, at, LIMITS, RULES);
    expect(blocks.count).toBeLessThanOrEqual(6);
    expect(blocks.clockS).toBeCloseTo(0.2, 9);
    const k = blocks.count - 1;
    const s = blocks.durationS[k];
    expect(blocks.x[k] + s * (blocks.vx[k] + (s * blocks.ax[k]) / 2)).toBeCloseTo(at.x, 9);
    expect(blocks.vx[k] + s * blocks.ax[k]).toBeCloseTo(0, 9);
  });

  it("joins a block below the min duration with its neighbour, if the pair is above it", () => {
    const { blocks, at } = straightRun([
      [0.1, 400],
      [0.004, 380],
      [0.1, -415.2],
    ]);
    mergeBlocks(blocks, 0, at, LIMITS, RULES);
    expect(Math.min(...blocks.durationS.subarray(0, blocks.count))).toBeGreaterThan(0.015);
  });

  it("leaves blocks unchanged that are already at the limit", () => {
    const { blocks, at } = straightRun([
      [0.1, 500],
      [0.5, 0],
      [0.1, -500],
    ]);
    mergeBlocks(blocks, 0, at, LIMITS, RULES);
    expect([...blocks.durationS.subarray(0, blocks.count)]).toEqual([0.1, 0.5, 0.1]);
  });

  it("leaves the runs before it unchanged", () => {
    const { blocks, at } = straightRun(Array.from({ length: 20 }, (_, i) => [0.01, i < 10 ? 300 : -300]));
    const before = new BlockColumns(0, false);
    before.push(1, 7, 8, 0, 0, 0, 0, 0);
    for (let k = 0; k < blocks.count; k++) {
      before.push(0.01, blocks.x[k], 0, blocks.vx[k], 0, blocks.ax[k], 0, blocks.alongMm[k]);
    }
    mergeBlocks(before, 1, at, LIMITS, RULES);
    expect([before.durationS[0], before.x[0], before.y[0]]).toEqual([1, 7, 8]);
    expect(before.startS[1]).toBe(1);
    expect(before.clockS).toBeCloseTo(1.2, 9);
  });
});

describe("a merged plan", () => {
  const planned = (points: readonly Point[], mode: MotionMode, fit: FitSettings | null) =>
    plan(strokeSetOf([points]), { ...DEFAULT_MOTION, mode, fit }, DEFAULT_PEN);

  it.each(["blend", "junction"] as const)(
    "is never faster than planned, and at most 1.2 %% slower: %s",
    (mode) => {
      const points = LOOPS.slice(0, 5_000);
      const ratio = planned(points, mode, DEFAULT_FIT).totalS / planned(points, mode, null).totalS;
      expect(ratio).toBeGreaterThan(1 - 1e-9);
      expect(ratio).toBeLessThan(1.012);
    },
  );

  it("has more blocks for smaller ε, all within it", () => {
    const points = LOOPS.slice(0, 3_000);
    const counts = [0.005, 0.02, 0.1].map((toleranceMm) => {
      const trajectory = planned(points, "blend", { toleranceMm, floorMs: 15 });
      const { draw, travel } = DEFAULT_MOTION;
      const allowed = draw.cornerMm + toleranceMm;
      const worst = worstOf(trajectory, strokeSetOf([points]), draw, travel, allowed);
      expect(worst.distance).toBeLessThanOrEqual(allowed + 2e-6);
      expect(worst.accel).toBeLessThanOrEqual(1.001);
      expect(worst.velocityJump).toBeLessThan(1e-6);
      return trajectory.blockCount;
    });
    expect(counts[0]).toBeGreaterThan(counts[1]);
    expect(counts[1]).toBeGreaterThan(counts[2]);
  });

  it("is at most 4 % slower than the plan before merging in the tight bends of a wave", () => {
    const wave = Array.from({ length: 1_000 }, (_, i): Point => [
      i / 20,
      5 * Math.sin((2 * Math.PI * i) / 160),
    ]);
    const slowest = (fit: FitSettings | null): number => {
      const trajectory = plan(strokeSetOf([wave]), { ...DEFAULT_MOTION, fit }, DEFAULT_PEN, {
        returnHome: false,
      });
      const middle = Array.from({ length: 4_000 }, (_, i) => trajectory.totalS * (0.3 + i / 10_000));
      return Math.min(...middle.map((t) => stateAt(trajectory, t)).map(({ vx, vy }) => Math.hypot(vx, vy)));
    };
    expect(slowest(DEFAULT_FIT)).toBeGreaterThanOrEqual(0.959 * slowest(null));
  });

  it("draws a dense line of 100 000 points with at most 15 000 commands", () => {
    const trajectory = planned(LOOPS, "blend", DEFAULT_FIT);
    for (const firmware of ["2.8.1", "3.0.3"]) {
      const machine = machineById("axidraw-v3");
      expect(compile(trajectory, { machine, firmware, pen: DEFAULT_PEN }).count).toBeLessThanOrEqual(15_000);
    }
  });
});
