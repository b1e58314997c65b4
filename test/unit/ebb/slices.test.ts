import { describe, expect, it } from "vitest";
import {
  comeToRest,
  commandLine,
  compile,
  DEFAULT_MOTION,
  DEFAULT_PEN,
  machineById,
  motionForFirmware,
  plan,
  stateAt,
  type MotionMode,
  type Trajectory,
} from "../../../src/index.js";
import { strokeSetOf, type Point } from "../../support/arbitraries.js";
import { largestJump, slicesOf, standstillS } from "../../support/slices.js";

const machine = machineById("axidraw-v3");
const firmware = "2.4.4";
const pen = DEFAULT_PEN;

const circle = (x: number, y: number, r: number, n: number): Point[] =>
  Array.from({ length: n + 1 }, (_, i) => {
    const angle = (2 * Math.PI * i) / n;
    return [x + r * Math.cos(angle), y + r * Math.sin(angle)];
  });

/** Loops as of handwriting, curves of all sizes, corners, and ways between them in every direction. */
const DRAWING = strokeSetOf([
  Array.from({ length: 400 }, (_, i): Point => [
    20 + i / 5 + 1.5 * Math.cos(i / 3),
    30 + 2 * Math.sin(i / 3),
  ]),
  ...[0.5, 2, 5, 20, 60].map((r, i) => circle(90 + 17 * i, 80 - 9 * i, r, 200)),
  [
    [200, 150],
    [120, 20],
    [10, 140],
    [200, 150],
  ],
]);

const LIMITS = {
  drawAccel: DEFAULT_MOTION.draw.accelMmPerS2,
  travelAccel: DEFAULT_MOTION.travel.accelMmPerS2,
};

const planned = (mode: MotionMode): Trajectory =>
  plan(DRAWING, motionForFirmware({ ...DEFAULT_MOTION, mode }, firmware), pen);

describe("slices of constant speed", () => {
  // The acceleration alone makes 2.5 mm/s between slices of 5 ms.
  it.each(["blend", "scurve"] as const)("jump by little more than they must in %s", (mode) => {
    const trajectory = planned(mode);
    const stream = compile(trajectory, { machine, firmware, pen });
    expect(largestJump(machine, slicesOf(stream, trajectory))).toBeLessThan(4.5);
  });

  it("go from a stroke to one that begins where it ends by no larger a jump than within a stroke", () => {
    const star = Array.from({ length: 720 }, (_, i): Point => {
      const r = i % 2 === 0 ? 0 : 3 + (i % 7);
      return [60 + r * Math.cos((i * Math.PI) / 360), 60 + r * Math.sin((i * Math.PI) / 360)];
    });
    const strokes = strokeSetOf(star.slice(1).map((point, i) => [star[i]!, point]));
    const trajectory = plan(strokes, motionForFirmware({ ...DEFAULT_MOTION, mode: "blend" }, firmware), pen);
    const slices = slicesOf(compile(trajectory, { machine, firmware, pen }), trajectory);
    const joints = slices.filter((slice, i) => slice.isLast && slices[i + 1]?.command === slice.command + 1);
    expect(joints).toHaveLength(star.length - 2);
    expect(largestJump(machine, slices)).toBeLessThan(4.5);
  });

  it.each(["junction", "blend", "scurve"] as const)(
    "are long enough to be read in time in %s, but for a run's last",
    (mode) => {
      const trajectory = planned(mode);
      const stream = compile(trajectory, { machine, firmware, pen });
      const slices = slicesOf(stream, trajectory);
      for (const { ms, isLast } of slices) expect(ms).toBeGreaterThanOrEqual(isLast ? 2 : 5);
      for (const { ms } of slices) expect(ms).toBeLessThanOrEqual(150);
      expect(standstillS(stream, slices)).toBe(0);
    },
  );

  it("are few and even on a long straight way", () => {
    const trajectory = plan(
      strokeSetOf([
        [
          [10, 10],
          [210, 91],
        ],
      ]),
      DEFAULT_MOTION,
      pen,
    );
    const stream = compile(trajectory, { machine, firmware, pen });
    // Four seconds at 50 mm/s; ramps of 0.1 s at its ends.
    const steady = slicesOf(stream, trajectory)
      .filter(({ isDrawn }) => isDrawn)
      .filter(({ command }) => {
        const s = stream.planS[command]! - stream.planS[stream.run.indexOf(1)]!;
        return s > 0.15 && s < 4;
      });
    expect(steady.length).toBeLessThan(50);
    for (const { ms, steps1, steps2 } of steady) {
      // Within 0.05 steps a ms: a slice of 20 ms cannot say it better.
      expect(Math.abs(steps1 / ms - steady[0]!.steps1 / steady[0]!.ms)).toBeLessThan(0.05);
      expect(Math.abs(steps2 / ms - steady[0]!.steps2 / steady[0]!.ms)).toBeLessThan(0.05);
    }
  });

  it("take up a motion where it is, and bring it to rest", () => {
    const trajectory = planned("blend");
    const whole = compile(trajectory, { machine, firmware, pen });
    for (let i = 150; i < whole.count - 1; i += 97) {
      if (whole.run[i]! < 0 || whole.run[i - 1] !== whole.run[i]) continue;
      const fromS = whole.planS[i]!;
      const { trajectory: rest } = comeToRest(trajectory, fromS, LIMITS, null);
      if (rest.blockCount === 0) continue;
      const [steps1, steps2] = [whole.steps1[i - 1]!, whole.steps2[i - 1]!];
      const start = { steps1, steps2, acc1: whole.acc1[i - 1]!, acc2: whole.acc2[i - 1]! };
      const stream = compile(rest, { machine, firmware, pen, start });
      const [, ms, n1, n2] = commandLine(stream, 0).split(",").map(Number);
      const { vx, vy } = stateAt(trajectory, fromS);
      const [v1, v2] = [80 * (vx + vy), 80 * (vx - vy)];
      const off1 = (1_000 * n1!) / ms! - v1;
      const off2 = (1_000 * n2!) / ms! - v2;
      expect(Math.hypot(off1, off2) / Math.SQRT2 / 80).toBeLessThan(6);
      const last = stream.count - 1;
      expect([stream.steps1[last], stream.steps2[last]]).toEqual([
        Math.round(80 * (rest.endX + rest.endY)),
        Math.round(80 * (rest.endX - rest.endY)),
      ]);
    }
  });

  it("keep the plan's time, rests and ways of less than a step included", () => {
    const trajectory = plan(
      strokeSetOf([
        [[50, 50]],
        [
          [50, 50],
          [50.004, 50],
        ],
        ...Array.from({ length: 40 }, (_, i) => circle(60 + i, 60, 0.1, 9)),
      ]),
      DEFAULT_MOTION,
      pen,
    );
    const stream = compile(trajectory, { machine, firmware, pen });
    expect(Math.abs(stream.boardS[stream.count]! - trajectory.totalS)).toBeLessThan(0.002);
  });
});
