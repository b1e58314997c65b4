import { describe, expect, it } from "vitest";
import { DEFAULT_PLOT_SETTINGS } from "../../src/schema/index.js";
import type { TextStore } from "../../web/state/persist.js";
import { readPresets, withPreset } from "../../web/state/presets.js";

const storeWith = (value: string | null): TextStore & { value: string | null } => ({
  value,
  getItem() {
    return this.value;
  },
  setItem(_key, text) {
    this.value = text;
  },
});

describe("presets", () => {
  it("of an earlier version are restored as stored", () => {
    const presets = withPreset([], " Fineliner ", DEFAULT_PLOT_SETTINGS);
    expect(readPresets(storeWith(JSON.stringify(presets)))).toEqual(presets);
    expect(presets[0].name).toBe("Fineliner");
  });

  it("of the same name replace each other", () => {
    const once = withPreset([], "Brush", DEFAULT_PLOT_SETTINGS);
    const pen = { ...DEFAULT_PLOT_SETTINGS.pen, upPct: 77 };
    const twice = withPreset(once, "Brush", { ...DEFAULT_PLOT_SETTINGS, pen });
    expect(twice).toHaveLength(1);
    expect(twice[0].pen.upPct).toBe(77);
  });

  it("that do not parse are left out, the others stay", () => {
    const good = withPreset([], "Good", DEFAULT_PLOT_SETTINGS);
    expect(readPresets(storeWith(JSON.stringify([{ name: "Bad" }, ...good, 7])))).toEqual(good);
    expect(readPresets(storeWith("{"))).toEqual([]);
    expect(readPresets(null)).toEqual([]);
  });
});
