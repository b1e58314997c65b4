/** Pages that share a plotter have the same heights, pens and presets, with undo. */
import { describe, expect, it } from "vitest";
import { machineById } from "../../../src/index.js";
import {
  DEFAULT_PLOT_SETTINGS,
  plotterSettingsSchema,
  type ListedMachine,
  type PlotSettings,
  type PlotterSettings,
} from "../../../src/schema/index.js";
import { BackendFault, type Backend } from "../../../web/backend/backend.js";
import { addPen } from "../../../web/layers/layer-settings.js";
import { DEFAULT_VIEW } from "../../../web/state/persist.js";
import { createActions } from "../../../web/state/actions.js";
import { applyServerEvent } from "../../../web/state/server-events.js";
import { createPageStore, type PageState, type PageStore } from "../../../web/state/store.js";
import { makeJob, makePlotter } from "../../support/jobs/jobs-on-page.js";

const settle = (): Promise<void> => new Promise((resolve) => setTimeout(resolve, 5));

/** The server's stored values, sent to each open page. */
class Plotters {
  readonly stored: Record<string, PlotterSettings> = {};
  machine: string | null = null;
  refuses = false;
  /** Another browser is the operator. */
  isOthers = false;
  putCount = 0;
  private readonly pages: { readonly store: PageStore; readonly follow: () => void }[] = [];

  readonly backend = {
    plotters: {
      saveSettings: (id: string, settings: PlotterSettings) => {
        this.putCount++;
        if (this.isOthers) return Promise.reject(new BackendFault("not-operator", "Anna is operating."));
        if (this.refuses) return Promise.reject(new Error("Somebody else is operating."));
        this.stored[id] = plotterSettingsSchema.parse(JSON.parse(JSON.stringify(settings)));
        this.tell();
        return Promise.resolve(this.stored[id]);
      },
      patch: (id: string, { machine }: { readonly machine: string }) => {
        this.machine = machine;
        this.tell();
        return Promise.resolve(makePlotter(id, { machine }));
      },
    },
    operator: {
      take: () => {
        this.isOthers = false;
        return Promise.resolve();
      },
    },
  } as unknown as Backend;

  tell(): void {
    for (const { store, follow } of this.pages) {
      store.setState({ ...this.state() });
      follow();
    }
  }

  open(more: Partial<PageState> = {}) {
    const store = createPageStore({ settings: DEFAULT_PLOT_SETTINGS, view: DEFAULT_VIEW });
    store.setState(more);
    let nowMs = 0;
    const actions = createActions({
      store,
      backend: this.backend,
      planner: {
        request: () => undefined,
        export: () => undefined,
        strokes: () => undefined,
        sketches: () => undefined,
        measure: () => Promise.reject(new Error("not asked")),
      },
      nowMs: () => (nowMs += 10_000),
      after: (_delayMs, callback) => void setTimeout(callback, 0),
    });
    this.pages.push({ store, follow: actions.followPlotter });
    store.setState({ link: "connected", me: { role: "operate", id: "a", name: "A" }, ...this.state() });
    actions.followPlotter();
    return {
      store,
      actions,
      pen: () => store.getState().settings.pen,
      setUp: async (upPct: number) => {
        actions.changeSettings("up", (settings) => ({ ...settings, pen: { ...settings.pen, upPct } }));
        await settle();
      },
      undo: async () => {
        actions.undo();
        await settle();
      },
    };
  }

  private state() {
    return {
      plotters: [makePlotter("left", { machine: this.machine }), makePlotter("right")],
      plotterSettings: { ...this.stored },
    };
  }
}

describe("two pages of one plotter", () => {
  it("have the same heights, whichever of them changes them", async () => {
    const plotters = new Plotters();
    const [anna, ben] = [plotters.open(), plotters.open()];
    await anna.setUp(71);
    expect(ben.pen().upPct).toBe(71);
    await ben.setUp(72);
    expect([anna.pen().upPct, plotters.stored["left"].pen.upPct]).toEqual([72, 72]);
    expect(plotters.open().pen().upPct).toBe(72);
    // A page that only follows stores nothing.
    expect(plotters.putCount).toBe(2);
  });

  it("have the same pens, presets and model", async () => {
    const plotters = new Plotters();
    const [anna, ben] = [plotters.open(), plotters.open()];
    const pen = { id: "pen-1", name: "Red", color: null, widthMm: 0.4, offsetXMm: 0, offsetYMm: 0 };
    anna.actions.changeSettings("pens", (settings) => ({ ...settings, pens: [pen] }));
    anna.actions.savePreset("Fineliner");
    anna.actions.changeSettings("machine", (settings) => ({ ...settings, machine: "axidraw-se-a3" }));
    await settle();
    const { settings, presets } = ben.store.getState();
    expect([settings.pens, presets.map(({ name }) => name), settings.machine]).toEqual([
      [pen],
      ["Fineliner"],
      "axidraw-se-a3",
    ]);
  });

  it("change nothing when the server has stored a new pen", async () => {
    const plotters = new Plotters();
    const { actions, store } = plotters.open();
    actions.changeSettings("pens", (settings) => addPen(settings, { name: "Red" }));
    const { settings, undoStack } = store.getState();
    await settle();
    expect(plotters.putCount).toBe(1);
    // Another object would be planned again.
    expect(store.getState().settings).toBe(settings);
    expect(store.getState().undoStack).toEqual(undoStack);
  });

  it("undo on each of them what was changed on either", async () => {
    const plotters = new Plotters();
    const [anna, ben] = [plotters.open(), plotters.open()];
    await anna.setUp(71);
    await anna.setUp(80);
    await ben.undo();
    expect([anna.pen().upPct, plotters.stored["left"].pen.upPct]).toEqual([71, 71]);
    anna.actions.savePreset("Brush");
    await settle();
    anna.actions.removePreset("Brush");
    await settle();
    expect(plotters.stored["left"].presets).toEqual([]);
    await anna.undo();
    expect(plotters.stored["left"].presets.map(({ name }) => name)).toEqual(["Brush"]);
    expect(ben.store.getState().presets).toHaveLength(1);
  });

  it("show the plotter's values again if a change is refused, and say why", async () => {
    const plotters = new Plotters();
    const anna = plotters.open();
    await anna.setUp(71);
    plotters.refuses = true;
    await anna.setUp(99);
    expect(anna.pen().upPct).toBe(71);
    expect(anna.store.getState().notices.map(({ text }) => text)).toEqual(["Somebody else is operating."]);
  });

  it.each([
    ["nothing was stored", []],
    ["heights were stored", [71]],
  ])("ask to take over where another browser operates: %s", async (_name, stored) => {
    const plotters = new Plotters();
    const anna = plotters.open();
    for (const upPct of stored) await anna.setUp(upPct);
    const before = anna.pen().upPct;
    plotters.isOthers = true;
    await anna.setUp(99);
    // Moved on while the question is open: one question for both.
    await anna.setUp(98);
    anna.store.getState().takeOverQuestion!.answer(false);
    await settle();
    expect(anna.store.getState().takeOverQuestion).toBe(null);
    expect(anna.pen().upPct).toBe(before);
    expect(anna.store.getState().notices).toEqual([]);
    await anna.setUp(97);
    anna.store.getState().takeOverQuestion!.answer(true);
    await settle();
    expect(anna.pen().upPct).toBe(97);
    expect(plotters.stored["left"].pen.upPct).toBe(97);
  });

  it("leave what belongs to the drawing to each page", async () => {
    const plotters = new Plotters();
    const [anna, ben] = [plotters.open(), plotters.open()];
    anna.actions.changeSettings("layer", (settings) => ({
      ...settings,
      pen: { ...settings.pen, layers: { sky: { upPct: 90 } } },
      prepare: { ...settings.prepare, marginMm: 33 },
    }));
    await settle();
    expect(plotters.putCount).toBe(0);
    await ben.setUp(64);
    expect(anna.pen()).toMatchObject({ upPct: 64, layers: { sky: { upPct: 90 } } });
  });
});

describe("another plotter", () => {
  it("has its own values, and undo does not carry those of the first to it", async () => {
    const plotters = new Plotters();
    const page = plotters.open();
    await page.setUp(71);
    page.actions.choosePlotter("right");
    expect(page.pen().upPct).toBe(DEFAULT_PLOT_SETTINGS.pen.upPct);
    expect(page.store.getState().undoStack).toEqual([]);
    await page.setUp(55);
    page.actions.choosePlotter("left");
    expect(page.pen().upPct).toBe(71);
    expect(Object.entries(plotters.stored).map(([id, { pen }]) => [id, pen.upPct])).toEqual([
      ["left", 71],
      ["right", 55],
    ]);
  });
});

describe("a custom machine that another page stores", () => {
  const mine: ListedMachine = { ...machineById("axidraw-v3"), id: "mine", widthMm: 600, builtIn: false };
  const springs = { xHz: 14, yHz: 17, damping: 0.05 };

  it("is the plotter's model here too, also after its ringing was measured there", () => {
    const plotters = new Plotters();
    const { store, actions } = plotters.open();
    const tell = (machine: ListedMachine): void => {
      store.setState((state) => applyServerEvent(state, { type: "machines", machines: [machine] }));
      actions.followPlotter();
    };
    tell(mine);
    plotters.machine = "mine";
    plotters.tell();
    expect(store.getState().settings).toMatchObject({ machine: "mine", customMachine: { widthMm: 600 } });
    tell({ ...mine, springs });
    expect(store.getState().settings.customMachine?.springs).toEqual(springs);
  });
});

describe("a job that is opened", () => {
  const old: PlotSettings = {
    ...DEFAULT_PLOT_SETTINGS,
    pen: { ...DEFAULT_PLOT_SETTINGS.pen, upPct: 5, layers: { sky: { upPct: 90 } } },
  };
  const open = async (state: "done" | "paused") => {
    const plotters = new Plotters();
    Object.assign(plotters.backend, { jobs: { drawing: () => Promise.resolve("<svg/>") } });
    const page = plotters.open({ jobs: [makeJob("a", { settings: old, state })] });
    await page.setUp(71);
    await page.actions.openJob(page.store.getState().jobs[0]);
    return { plotters, page };
  };

  it("has the plotter's current heights, not the job's", async () => {
    const { page } = await open("done");
    expect(page.pen()).toMatchObject({ upPct: 71, layers: { sky: { upPct: 90 } } });
    expect(page.store.getState().drawing).toMatchObject({ jobId: null, sourceId: "a" });
  });

  it("has its own settings while it is plotted; the next drawing has the plotter's again", async () => {
    const { plotters, page } = await open("paused");
    expect(page.pen().upPct).toBe(5);
    plotters.tell();
    expect(page.pen().upPct).toBe(5);
    page.actions.openDrawing("next", "<svg/>");
    expect(page.pen().upPct).toBe(71);
    expect(plotters.stored["left"].pen.upPct).toBe(71);
  });
});
