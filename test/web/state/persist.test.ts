import fc from "fast-check";
import { describe, expect, it } from "vitest";
import { PREPARE_TABLE } from "../../../src/internal.js";
import { DEFAULT_PLOT_SETTINGS } from "../../../src/schema/index.js";
import {
  DEFAULT_VIEW,
  parseRemembered,
  readRemembered,
  writeRemembered,
  type TextStore,
} from "../../../web/state/persist.js";

const memoryStore = (): TextStore & { value: string | null } => ({
  value: null,
  getItem() {
    return this.value;
  },
  setItem(_key, value) {
    this.value = value;
  },
});
const defaults = { settings: DEFAULT_PLOT_SETTINGS, view: DEFAULT_VIEW };

describe("the page's stored settings", () => {
  it("are restored as stored", () => {
    const store = memoryStore();
    const kept = {
      settings: { ...DEFAULT_PLOT_SETTINGS, prepare: { ...DEFAULT_PLOT_SETTINGS.prepare, marginMm: 22 } },
      view: { ...DEFAULT_VIEW, showTravel: true, theme: "dark" as const },
    };
    writeRemembered(store, kept);
    expect(readRemembered(store)).toEqual(kept);
  });

  it("include layer switches, for the drawing that is restored with them", () => {
    const store = memoryStore();
    const settings = {
      ...DEFAULT_PLOT_SETTINGS,
      prepare: { ...DEFAULT_PLOT_SETTINGS.prepare, hiddenLayers: ["sky"] },
    };
    writeRemembered(store, { settings, view: DEFAULT_VIEW });
    expect(readRemembered(store).settings.prepare.hiddenLayers).toEqual(["sky"]);
  });

  it("are the defaults on a first visit", () => {
    expect(readRemembered(memoryStore())).toEqual(defaults);
    expect(readRemembered(null)).toEqual(defaults);
  });

  it("keep the valid parts and replace the others", () => {
    const stored = JSON.stringify({
      settings: {
        pen: { upPct: 70, downPct: 20, extraLiftMs: 100, extraDropMs: 90 },
        motion: { mode: "warp" },
      },
      view: { theme: "dark" },
    });
    const { settings, view } = parseRemembered(stored);
    expect(settings.pen).toMatchObject({ upPct: 70, extraLiftMs: 100, extraDropMs: 90 });
    expect(settings.motion).toEqual(DEFAULT_PLOT_SETTINGS.motion);
    expect(view).toEqual({ ...DEFAULT_VIEW, theme: "dark" });
  });

  it("replace a single invalid value, and nothing else", () => {
    const { prepare, motion } = DEFAULT_PLOT_SETTINGS;
    const pen = { id: "p1", name: "Blue", color: "#0000ff", widthMm: 0.3, offsetXMm: 0, offsetYMm: 0 };
    const kept = {
      ...DEFAULT_PLOT_SETTINGS,
      prepare: { ...prepare, marginMm: 22, joinMm: 0.3, layerRepeats: { sky: 2 } },
      motion: { ...motion, mode: "scurve", draw: { ...motion.draw, speedMmPerS: 17 } },
      pens: [pen],
    };
    const stored = {
      ...kept,
      prepare: {
        ...kept.prepare,
        smoothRounds: 6,
        layout: { xMm: "far", yMm: 3 },
        layerRepeats: { sky: 2, sea: 99 },
      },
      motion: {
        ...kept.motion,
        draw: { ...kept.motion.draw, cornerMm: -1 },
        ease: { lengthMm: 0 },
        fit: { toleranceMm: 7 },
      },
      pens: [{ ...pen, id: "", widthMm: 0 }, { ...pen, widthMm: -1 }, pen],
    };
    const { settings, view } = parseRemembered(
      JSON.stringify({ settings: stored, view: { showTravel: true, openGroups: ["paper", 7] } }),
    );
    expect(settings).toEqual(kept);
    expect(view).toEqual({ ...DEFAULT_VIEW, showTravel: true, openGroups: ["paper"] });
  });

  it("keep the maximum that the page's fields allow", () => {
    const prepare = { ...DEFAULT_PLOT_SETTINGS.prepare, smoothRounds: PREPARE_TABLE.smoothRounds.max };
    const { settings } = parseRemembered(JSON.stringify({ settings: { prepare } }));
    expect(settings.prepare).toEqual(prepare);
  });

  it("never throw and never accept an invalid setting", () => {
    fc.assert(
      fc.property(fc.oneof(fc.string(), fc.json(), fc.constant(null)), (stored) => {
        const { settings } = parseRemembered(stored);
        expect(settings.prepare.paper.widthMm).toBeGreaterThan(0);
        expect(Number.isFinite(settings.motion.draw.speedMmPerS)).toBe(true);
      }),
    );
  });

  it("survive a browser that refuses to store", () => {
    const refusing: TextStore = {
      getItem() {
        throw new Error("denied");
      },
      setItem() {
        throw new Error("full");
      },
    };
    expect(() => writeRemembered(refusing, defaults)).not.toThrow();
    expect(readRemembered(refusing)).toEqual(defaults);
  });
});
