import { describe, expect, it } from "vitest";
import {
  DEFAULT_MOTION,
  DEFAULT_PEN,
  machineById,
  planJob,
  stateAt,
  type MotionSettings,
  type PenSettings,
} from "../../../../../src/index.js";
import { isPlannedAlike, motionForFirmware } from "../../../../../src/internal.js";
import { penMovesOf } from "../../../../../src/plan/pen/pen-moves.js";
import { strokeSetOf } from "../../../../support/drawings/arbitraries.js";

const QUICK: MotionSettings = {
  ...DEFAULT_MOTION,
  draw: { ...DEFAULT_MOTION.draw, accelMmPerS2: 300 },
  layers: {
    ink: { accelMmPerS2: 2_000, speedMmPerS: 20 },
    wash: { accelMmPerS2: 90 },
    chalk: { cornerMm: 0.1 },
  },
};

describe("settings for a firmware", () => {
  it.each(["2.5.3", "2.8.1", "3.0.3"])("are unchanged for %s", (firmware) => {
    expect(motionForFirmware(QUICK, firmware)).toBe(QUICK);
  });

  it("have no acceleration over 500 mm/s² if commands have constant speed, and are otherwise the same", () => {
    const gentle = motionForFirmware(QUICK, "2.4.4");
    expect(gentle).toEqual({
      ...QUICK,
      travel: { ...QUICK.travel, accelMmPerS2: 500 },
      layers: {
        ...QUICK.layers,
        ink: { accelMmPerS2: 500, speedMmPerS: 20 },
      },
    });
    expect(motionForFirmware(gentle, "2.4.4")).toEqual(gentle);
  });

  it("are refused for an invalid version", () => {
    expect(() => motionForFirmware(QUICK, "new")).toThrow('"new" is not a firmware version');
  });
});

const FAST: PenSettings = { ...DEFAULT_PEN, overlap: "fast" };
const machine = machineById("axidraw-v3");
const fastJob = (firmware: string | null) =>
  planJob(
    { strokes: strokeSetOf([[[0, 0], [5, 0]], [[5, 6], [0, 6]]]) }, // prettier-ignore
    { motion: DEFAULT_MOTION, pen: FAST },
    machine,
    { firmware },
  );

describe("a pen that moves in flight with fast", () => {
  const OLD = ["2.4.4", "2.5.3", "2.8.1", "3.0.0", null];

  it.each([...OLD.map((firmware) => [firmware, 0.1] as const), ["3.0.1", 0.29], ["3.0.3", 0.29]] as const)(
    "comes down, on firmware %s, %d mm before the stroke",
    (firmware, mm) => {
      const job = fastJob(firmware);
      const { trajectory } = job;
      const [, drop] = penMovesOf(trajectory).filter(({ up }) => !up);
      const { x, y } = stateAt(trajectory, drop.startS);
      expect(Math.hypot(x - 5, y - 6)).toBeCloseTo(mm, 2);
      const { planS, count } = job.commands();
      expect(planS[count]).toBe(trajectory.totalS);
    },
  );

  it("is planned alike for versions that lower it alike; safe is the same on all with ramps", () => {
    expect(isPlannedAlike(machine, FAST, "2.8.1", "3.0.3")).toBe(false);
    expect(isPlannedAlike(machine, FAST, null, "3.0.3")).toBe(false);
    expect(isPlannedAlike(machine, FAST, null, "2.8.1")).toBe(true);
    expect(isPlannedAlike(machine, FAST, "3.0.1", "3.0.3")).toBe(true);
    expect(isPlannedAlike(machine, FAST, "2.4.4", "2.8.1")).toBe(false);
    expect(isPlannedAlike(machine, DEFAULT_PEN, "2.8.1", "3.0.3")).toBe(true);
  });
});
