import { describe, expect, it } from "vitest";
import { DEFAULT_PEN } from "../../../src/index.js";
import { penSettingsSchema } from "../../../src/schema/settings.js";

/** Pen settings as they were stored before the carriage could move while the pen moves. */
const STORED = { upPct: 60, downPct: 30, liftMs: 250, dropMs: 300, liftPctPerS: null, dropPctPerS: null };

describe("pen settings stored by an older version", () => {
  it("get the default overlap if they had nothing like it", () => {
    const { overlap, contactPct, fullHeightMm } = DEFAULT_PEN;
    const today = { ...STORED, overlap, contactPct, fullHeightMm };
    expect(penSettingsSchema.parse(STORED)).toEqual(today);
    expect(penSettingsSchema.parse({ ...STORED, hop: null, clearPct: 100 })).toEqual(today);
  });

  it("keep their lower lifts for short travels: the pen still clears the paper", () => {
    const hop = { longestMm: 3, upPct: 40 };
    const carried = { ...STORED, overlap: "fast", contactPct: 33, fullHeightMm: 3 };
    expect(penSettingsSchema.parse({ ...STORED, hop })).toEqual(carried);
  });

  it("keep the share of the lift after which the carriage started", () => {
    const parsed = penSettingsSchema.parse({ ...STORED, clearPct: 60, hop: { longestMm: 3, upPct: 40 } });
    expect(parsed).toMatchObject({ overlap: "fast", contactPct: 60, fullHeightMm: 3 });
    expect(penSettingsSchema.parse({ ...STORED, clearPct: 70 })).toMatchObject({
      overlap: "fast",
      contactPct: 70,
      fullHeightMm: DEFAULT_PEN.fullHeightMm,
    });
  });

  it("stay as they are once they have the new settings", () => {
    const parsed = penSettingsSchema.parse({ ...STORED, overlap: "off", clearPct: 60 });
    expect(parsed).toEqual({ ...STORED, overlap: "off", contactPct: 50, fullHeightMm: 20 });
  });
});
