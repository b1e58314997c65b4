import { describe, expect, it } from "vitest";
import { DEFAULT_MOTION, type MotionSettings } from "../../../src/index.js";
import { motionForFirmware } from "../../../src/internal.js";

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
