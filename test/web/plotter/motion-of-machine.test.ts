/** Motion settings that depend on the machine: the quality stays the same when the machine's springs change. */
import { describe, expect, it } from "vitest";
import { DEFAULT_MOTION, machineById } from "../../../src/index.js";
import {
  motionForSprings,
  motionOfQuality,
  withoutShaperIfUnmeasured,
  qualityOf,
  withQuality,
} from "../../../src/internal.js";
import { DEFAULT_PLOT_SETTINGS, fromPreset, withPreset } from "../../../src/schema/index.js";
import { withMachine } from "../../../web/state/plotter-sync.js";

const SOFT = { xHz: 8, yHz: 12, damping: 0.05 };
const STIFF = { xHz: 15, yHz: 25, damping: 0.05 };

describe("a quality", () => {
  it("stays the same on a measured machine, and becomes Normal on one that was not measured", () => {
    const measured = motionForSprings(DEFAULT_MOTION, null, STIFF);
    expect(qualityOf(measured, STIFF)).toBe("normal");
    const fast = withQuality(measured, "fast", STIFF);
    expect(qualityOf(motionForSprings(fast, STIFF, SOFT), SOFT)).toBe("fast");
    expect(motionForSprings(fast, STIFF, null)).toEqual({ ...fast, ...motionOfQuality("normal", null) });
  });

  it("does not change custom numbers, except for shaping on a machine that was not measured", () => {
    const fast = withQuality(DEFAULT_MOTION, "fast", STIFF);
    const custom = { ...fast, draw: { ...fast.draw, speedMmPerS: 33 } };
    expect(motionForSprings(custom, STIFF, SOFT)).toBe(custom);
    expect(motionForSprings(custom, STIFF, null)).toEqual({ ...custom, shaper: "none" });
    expect(withoutShaperIfUnmeasured(custom, STIFF)).toBe(custom);
  });

  it("replaces the scurve mode, which is a filter too", () => {
    const soft = { ...DEFAULT_MOTION, mode: "scurve" as const };
    expect(withQuality(soft, "fine", STIFF).mode).toBe("blend");
    expect(withQuality(soft, "normal", null).mode).toBe("scurve");
    expect(withQuality({ ...DEFAULT_MOTION, mode: "junction" }, "fine", STIFF).mode).toBe("junction");
  });
});

describe("the page's settings", () => {
  const measured = { ...machineById("axidraw-v3"), id: "mine", springs: STIFF };

  it("change with the machine that is chosen", () => {
    const settings = withMachine(DEFAULT_PLOT_SETTINGS, measured);
    expect(settings.customMachine?.springs).toEqual(STIFF);
    expect(qualityOf(settings.motion, STIFF)).toBe("normal");
    const back = withMachine(settings, machineById("axidraw-v3"));
    expect(back.motion).toEqual({ ...DEFAULT_PLOT_SETTINGS.motion, shaper: "none" });
  });

  it("accept a measured machine's preset on one that was not measured, without shaping", () => {
    const fast = { ...withMachine(DEFAULT_PLOT_SETTINGS, measured) };
    const preset = withPreset([], "quick", { ...fast, motion: withQuality(fast.motion, "fast", STIFF) })[0];
    expect(fromPreset(DEFAULT_PLOT_SETTINGS, preset).motion.shaper).toBe("none");
    expect(fromPreset(fast, preset).motion.shaper).toBe("zv");
  });
});
