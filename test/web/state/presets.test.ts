import { describe, expect, it } from "vitest";
import { DEFAULT_PLOT_SETTINGS } from "../../../src/schema/index.js";
import { withPreset } from "../../../web/state/presets.js";

describe("presets", () => {
  it("have names without blanks around them", () => {
    expect(withPreset([], " Fineliner ", DEFAULT_PLOT_SETTINGS)[0].name).toBe("Fineliner");
  });

  it("presets of the same name replace each other", () => {
    const once = withPreset([], "Brush", DEFAULT_PLOT_SETTINGS);
    const pen = { ...DEFAULT_PLOT_SETTINGS.pen, upPct: 77 };
    const twice = withPreset(once, "Brush", { ...DEFAULT_PLOT_SETTINGS, pen });
    expect(twice).toHaveLength(1);
    expect(twice[0].pen.upPct).toBe(77);
  });
});
