import { createElement, type ReactElement } from "react";
import { renderToStaticMarkup } from "react-dom/server";
import { describe, expect, it } from "vitest";
import { MACHINES, machineById, type MachineProfile } from "../../../src/index.js";
import { DEFAULT_PLOT_SETTINGS, type Plotter } from "../../../src/schema/index.js";
import type { Backend } from "../../../web/backend/backend.js";
import { MachinePanel, MachineSetUp } from "../../../web/plotter/machine.js";
import type { Actions } from "../../../web/state/actions.js";
import { DEFAULT_VIEW } from "../../../web/state/persist.js";
import { createPageStore, type PageState } from "../../../web/state/store.js";
import { PageContext } from "../../../web/state/use-store.js";
import { makePlotter } from "../../support/jobs/jobs-on-page.js";
import { adviceWords, homeWords } from "../../../web/plotter/machine-words.js";

describe("the words about home", () => {
  it("say that home is set by hand only for a plotter without limit switches", () => {
    const [machine] = MACHINES;
    const homing = { x: { port: "C", pin: 0 }, y: { port: "C", pin: 1 } };
    const withSwitches: MachineProfile = { ...machine, controller: { ...machine.controller, homing } };
    expect(homeWords(machine)).toContain("no limit switches");
    for (const findsHome of [withSwitches, machineById("nextdraw-8511")]) {
      expect(homeWords(findsHome)).toMatch(/finds that by itself/);
    }
  });
});

describe("the words about the firmware", () => {
  const axidraw = machineById("axidraw-v3");
  const board = (firmware: string | null, kind: "serial" | "virtual" = "serial"): Plotter =>
    makePlotter("one", { firmware, kind });

  it.each(["2.0.0", "2.4.4", "2.8.1", "2.99.99"])("tell what firmware %s can miss", (firmware) => {
    expect(adviceWords(board(firmware), axidraw)).toMatch(/^Before firmware 3\.0\.0, .* less than 0\.3 s/);
  });

  it("tell that a firmware is newer than plotwright knows", () => {
    expect(adviceWords(board("4.1.0"), axidraw)).toContain("4.1.0 is newer than plotwright knows");
  });

  it("are left out where they are not true or not known", () => {
    for (const firmware of ["3.0.0", "3.0.3", "3.1.7", "Grbl 1.1h", null]) {
      expect(adviceWords(board(firmware), axidraw)).toBeNull();
    }
    expect(adviceWords(board("2.8.1", "virtual"), axidraw)).toBeNull();
    expect(adviceWords(board("2.8.1"), null)).toBeNull();
    const grbl = MACHINES.find(({ controller }) => controller.kind === "grbl");
    expect(adviceWords(board("Grbl 1.1h"), grbl ?? null)).toBeNull();
  });

  it("stand once with the facts about the plotter", () => {
    const html = page(createElement(MachineSetUp, null, null), { plotters: [board("2.8.1")] });
    expect(html.match(/Before firmware 3\.0\.0/g)).toHaveLength(1);
  });
});

describe("the button that stops a move by hand", () => {
  const shown = (activity: Plotter["activity"], role: "operate" | "watch"): boolean => {
    const connection = activity === "none" ? "idle" : "busy";
    const plotters = [makePlotter("one", { activity, connection })];
    const me = { role, id: null, name: null };
    // The steps of the first plot, which have the button too, are loaded when they are shown.
    const view = { ...DEFAULT_VIEW, hidesFirstPlot: true };
    return />Stop</.test(page(createElement(MachinePanel), { plotters, me, view, link: "connected" }));
  };

  it.each(["operate", "watch"] as const)(
    "is there while the plotter moves, for a device that may %s",
    (role) => {
      expect(shown("moving", role)).toBe(true);
      expect(shown("none", role)).toBe(false);
      // A plot has buttons of its own.
      expect(shown("plotting", role)).toBe(false);
    },
  );
});

/** A part of the page as HTML. */
function page(part: ReactElement, change: Partial<PageState>): string {
  const store = createPageStore({ settings: DEFAULT_PLOT_SETTINGS, view: DEFAULT_VIEW });
  const state = { ...store.getState(), plotterId: "one", ...change };
  const value = {
    store: { ...store, getState: () => state, getInitialState: () => state },
    backend: { features: {} } as Backend,
    actions: {} as Actions,
  };
  return renderToStaticMarkup(createElement(PageContext, { value }, part));
}
