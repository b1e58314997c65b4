import { describe, expect, it } from "vitest";
import { DEFAULT_PLOT_SETTINGS, presetNamed, withoutPreset, withPreset } from "../../../src/schema/index.js";

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

  it("are found by name in any case, and the exact name first", () => {
    const presets = ["Brush", "brush", "Fineliner"].reduce(
      (list, name) => withPreset(list, name, DEFAULT_PLOT_SETTINGS),
      withPreset([], "Gel", DEFAULT_PLOT_SETTINGS),
    );
    expect(presetNamed(presets, "brush").name).toBe("brush");
    expect(presetNamed(presets, " FINELINER ").name).toBe("Fineliner");
    expect(withoutPreset(presets, "brush").map(({ name }) => name)).toEqual(["Gel", "Brush", "Fineliner"]);
    expect(() => presetNamed(presets, "Ink")).toThrow(
      'The plotter has no preset "Ink". It has Gel, Brush, brush, Fineliner.',
    );
    expect(() => presetNamed([], "Ink")).toThrow('The plotter has no preset "Ink". It has none.');
  });
});
