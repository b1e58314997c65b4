import { describe, expect, it } from "vitest";
import type { PenOverlap } from "../../../src/internal.js";
import { DEFAULT_PLOT_SETTINGS } from "../../../src/schema/index.js";
import { replanForBoard } from "../../../web/plotter/board-watch.js";
import { DEFAULT_VIEW } from "../../../web/state/persist.js";
import { createPageStore, type PageState } from "../../../web/state/store.js";
import { makePlotter } from "../../support/jobs/jobs-on-page.js";

describe("the plan on the page", () => {
  it("is computed again for a board that moves differently, and for no other change", () => {
    const store = createPageStore({ settings: DEFAULT_PLOT_SETTINGS, view: DEFAULT_VIEW });
    let count = 0;
    const stop = replanForBoard(store, () => count++);
    const counted = (change: Partial<PageState>): number => {
      count = 0;
      store.setState(change);
      return count;
    };
    const old = makePlotter("old", { firmware: "2.4.4" });
    const found = makePlotter("new", { firmware: "2.8.1" });
    expect(counted({ plotters: [makePlotter("new", { firmware: null }), old], plotterId: "new" })).toBe(0);
    expect(counted({ plotters: [found, old] })).toBe(0);
    expect(counted({ plotterId: "old" })).toBe(1);
    expect(counted({ plotters: [found, { ...old, penUp: false }] })).toBe(0);
    expect(counted({ plotters: [found, { ...old, firmware: null }] })).toBe(1);
    expect(counted({ plotters: [found, old] })).toBe(1);
    expect(counted({ plotterId: "new" })).toBe(1);
    stop();
    expect(counted({ plotterId: "old" })).toBe(0);
  });

  it("is computed again for a board that lowers the pen differently, if that is set to fast", () => {
    const replans = (overlap: PenOverlap): number => {
      const pen = { ...DEFAULT_PLOT_SETTINGS.pen, overlap };
      const store = createPageStore({ settings: { ...DEFAULT_PLOT_SETTINGS, pen }, view: DEFAULT_VIEW });
      store.setState({ plotters: [makePlotter("one", { firmware: "2.8.1" })], plotterId: "one" });
      let count = 0;
      const stop = replanForBoard(store, () => count++);
      store.setState({ plotters: [makePlotter("one", { firmware: "3.0.3" })] });
      stop();
      return count;
    };
    expect([replans("safe"), replans("fast")]).toEqual([0, 1]);
  });
});
