import { describe, expect, it } from "vitest";
import { DEFAULT_PLOT_SETTINGS } from "../../../src/schema/index.js";
import { FIELDS, fieldsFor } from "../../../web/search/fields.js";
import { DEFAULT_VIEW } from "../../../web/state/persist.js";
import { createPageStore } from "../../../web/state/store.js";

const stateOf = (machine: string) =>
  createPageStore({ settings: { ...DEFAULT_PLOT_SETTINGS, machine }, view: DEFAULT_VIEW }).getState();

const idsFor = (machine: string): string[] => fieldsFor(stateOf(machine)).map(({ id }) => id);

describe("the settings that the search finds", () => {
  it("are all of them for a plotter with an EiBotBoard", () => {
    expect(idsFor("axidraw-v3")).toEqual(FIELDS.map(({ id }) => id));
  });

  it("are for a Grbl those that it uses: it plans the motion and moves the pen by itself", () => {
    const left = new Set(idsFor("idraw-h-a4"));
    const hidden = FIELDS.filter(({ id }) => !left.has(id)).map(({ label }) => label);
    expect([...new Set(hidden)].sort()).toEqual([
      "Acceleration",
      "Acceleration along x",
      "Acceleration along y",
      "Corner rounding",
      "Corners",
      "Draw dense curves in long sweeps",
      "Full lift for travels from",
      "Lower the pen gently",
      "Lowering speed",
      "Motion sent ahead",
      "Move while the pen lifts",
      "Quality",
      "Reduce ringing",
      "Softness",
      "Tip touches at",
      "Tolerance",
    ]);
  });
});
