/** Which settings a page offers to apply to a running plot: those that the user changed on that page. */
import { renderToStaticMarkup } from "react-dom/server";
import { describe, expect, it } from "vitest";
import { DEFAULT_PLOT_SETTINGS, type Job, type PlotSettings } from "../../../src/schema/index.js";
import type { Backend } from "../../../web/backend/backend.js";
import { createActions } from "../../../web/state/actions.js";
import { DEFAULT_VIEW } from "../../../web/state/persist.js";
import { createPageStore, type PageStore } from "../../../web/state/store.js";
import { PageContext } from "../../../web/state/use-store.js";
import { Adjust, changedSettings } from "../../../web/watch/adjust.js";
import { makeJob, makePlotter } from "../../support/jobs/jobs-on-page.js";

const OFFER = "Apply the current pen and speed settings";
const faster = (settings: PlotSettings): PlotSettings => ({
  ...settings,
  motion: { ...settings.motion, draw: { ...settings.motion.draw, speedMmPerS: 80 } },
});

const openPage = (settings = DEFAULT_PLOT_SETTINGS) => {
  const store = createPageStore({ settings, view: DEFAULT_VIEW });
  store.setState({ link: "connected", plotters: [makePlotter("virtual")] });
  const sent = makeJob("a", { state: "plotting" });
  const backend = {
    drawings: { upload: () => Promise.resolve({ id: "upload" }) },
    jobs: {
      add: () => Promise.resolve(sent),
      start: () => Promise.resolve(sent),
      drawing: () => Promise.resolve("<svg/>"),
    },
  } as unknown as Backend;
  const planner = {
    request: () => undefined,
    export: () => undefined,
    strokes: () => undefined,
    sketches: () => undefined,
    measure: () => Promise.reject(new Error("not asked")),
  };
  const actions = createActions({ store, backend, planner, nowMs: () => 0, after: () => undefined });
  const seeJob = (job: Job = sent): void => store.setState({ jobs: [job] });
  /** What the section "While it plots" shows. */
  const shown = (): string => {
    const page: PageStore = { ...store, getInitialState: store.getState };
    return renderToStaticMarkup(
      <PageContext value={{ store: page, backend, actions }}>
        <Adjust />
      </PageContext>,
    );
  };
  return { store, actions, seeJob, shown };
};

describe("the pen and speed settings of a page", () => {
  it("are not offered to a plot that this page only watches, whatever they are", () => {
    const { actions, seeJob, shown } = openPage(faster(DEFAULT_PLOT_SETTINGS));
    seeJob();
    expect(shown()).toContain("Speed now");
    expect(shown()).not.toContain(OFFER);
    actions.openDrawing("another", "<svg/>");
    actions.changeSettings("speed", faster);
    expect(shown()).not.toContain(OFFER);
  });

  it.each(["plotDrawing", "queueDrawing"] as const)(
    "are offered after %s, once they are changed",
    async (send) => {
      const { actions, seeJob, shown } = openPage();
      actions.openDrawing("waves", "<svg/>");
      await actions[send]();
      seeJob();
      expect(shown()).not.toContain(OFFER);
      actions.changeSettings("margin", (now) => ({ ...now, prepare: { ...now.prepare, marginMm: 3 } }));
      expect(shown()).not.toContain(OFFER);
      actions.changeSettings("speed", faster);
      expect(shown()).toContain(OFFER);
      expect(shown()).toContain("Speed 80 mm/s with the pen down");
      seeJob(makeJob("a", { state: "plotting", settings: faster(DEFAULT_PLOT_SETTINGS) }));
      expect(shown()).not.toContain(OFFER);
    },
  );

  it("are not offered to one of several copies", async () => {
    const { store, actions, seeJob, shown } = openPage();
    actions.openDrawing("waves", "<svg/>");
    store.setState({ copies: 2 });
    await actions.queueDrawing();
    seeJob();
    actions.changeSettings("speed", faster);
    expect(shown()).not.toContain(OFFER);
  });

  it("are offered for a job that was opened here and changed", async () => {
    const { actions, seeJob, shown } = openPage();
    const job = makeJob("a", { state: "plotting" });
    seeJob(job);
    await actions.openJob(job);
    expect(shown()).not.toContain(OFFER);
    actions.changeSettings("speed", faster);
    expect(shown()).toContain(OFFER);
  });
});

describe("the changed settings in words", () => {
  const { pen, motion } = DEFAULT_PLOT_SETTINGS;

  it("name every difference, with its new value if that is a number", () => {
    const now = {
      pen: { ...pen, downPct: 28.5, overlap: "off" as const },
      motion: { ...motion, travel: { ...motion.travel, accelMmPerS2: 900 }, speedXMmPerS: 40 },
    };
    expect(changedSettings({ pen, motion }, now)).toEqual([
      "Height down 28.5 %",
      "Move while the pen lifts",
      "Acceleration 900 mm/s² with the pen up",
      "Speed along x 40 mm/s",
    ]);
  });

  it("name the rest together, and nothing that is equal or only left out", () => {
    const layers = { sky: { extraLiftMs: 100 } };
    const now = { pen: { ...pen, layers, liftPctPerS: 50 }, motion: { ...motion, ease: null } };
    expect(changedSettings({ pen, motion }, now)).toEqual(["Other settings of the pen and the speed"]);
  });
});

describe("a height that was found while plotting", () => {
  it("is offered to be kept, on the page that found it, until it is", () => {
    const { store, actions, seeJob, shown } = openPage();
    const { pen } = DEFAULT_PLOT_SETTINGS;
    const job = makeJob("a", { state: "plotting" });
    const lower = { ...job, settings: { ...job.settings, pen: { ...pen, downPct: pen.downPct - 1 } } };
    seeJob(lower);
    // Another page changed it, or the job came with it.
    expect(shown()).not.toContain("from now on?");
    store.setState({ nudgedJobId: "a" });
    expect(shown()).toContain(`Height down: keep ${pen.downPct - 1}\u202f% from now on?`);
    expect(shown()).not.toContain("Height up: keep");
    actions.changeSettings("pen down", (settings) => ({ ...settings, pen: lower.settings.pen }));
    expect(shown()).not.toContain("from now on?");
  });
});
