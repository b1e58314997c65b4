/** Pen heights changed while it plots: the server saves a change only after it has planned the rest again. */
import { describe, expect, it } from "vitest";
import {
  DEFAULT_PLOT_SETTINGS,
  type Job,
  type JobChange,
  type PlotSettings,
} from "../../../src/schema/index.js";
import type { Backend } from "../../../web/backend/backend.js";
import { createActions } from "../../../web/state/actions.js";
import { DEFAULT_VIEW } from "../../../web/state/persist.js";
import { createPageStore, penOf } from "../../../web/state/store.js";
import { makeJob } from "../../support/jobs/jobs-on-page.js";

type Pen = PlotSettings["pen"];
const PEN: Pen = { ...DEFAULT_PLOT_SETTINGS.pen, upPct: 60, downPct: 30 };

const settle = (): Promise<void> => new Promise((resolve) => setTimeout(resolve));

/** A page with a running plot, and its requests, which the test answers. */
const openPage = () => {
  const store = createPageStore({ settings: DEFAULT_PLOT_SETTINGS, view: DEFAULT_VIEW });
  const requests: { change: JobChange; resolve(job: Job): void; reject(error: Error): void }[] = [];
  const backend = {
    jobs: {
      change: (_id: string, change: JobChange) =>
        new Promise<Job>((resolve, reject) => requests.push({ change, resolve, reject })),
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
  const withPen = (pen: Pen): Job =>
    makeJob("a", { state: "plotting", settings: { ...DEFAULT_PLOT_SETTINGS, pen } });
  store.setState({ jobs: [withPen(PEN)] });
  const job = (): Job => store.getState().jobs[0];
  const shown = (): Pen => penOf(store.getState(), job());
  return {
    shown,
    requests,
    /** A press of "+". */
    raise: (which: "upPct" | "downPct") => void actions.changeJobPen(job(), { [which]: shown()[which] + 1 }),
    apply: (pen: Pen) => void actions.changeJob("a", { pen }),
    answer: (k: number): Promise<void> => {
      requests[k].resolve(withPen({ ...PEN, ...(requests[k].change.pen as Pen) }));
      return settle();
    },
    refuse: (k: number): Promise<void> => {
      requests[k].reject(new Error("The plot is still being planned."));
      return settle();
    },
  };
};

describe("a press before the last one is answered", () => {
  it("keeps the other height", () => {
    const { raise, requests } = openPage();
    raise("upPct");
    raise("downPct");
    expect(requests[1].change.pen).toEqual({ ...PEN, upPct: 61, downPct: 31 });
  });

  it("adds another step, which is shown at once", async () => {
    const { raise, requests, shown, answer } = openPage();
    raise("upPct");
    raise("upPct");
    expect([requests[1].change.pen?.upPct, shown().upPct]).toEqual([62, 62]);
    await answer(0);
    expect(shown().upPct).toBe(62);
    await answer(1);
    expect(shown()).toEqual({ ...PEN, upPct: 62 });
  });

  it("keeps the pen settings that were just applied", () => {
    const { raise, apply, requests } = openPage();
    apply({ ...PEN, extraLiftMs: 150, upPct: 80 });
    raise("upPct");
    expect(requests[1].change.pen).toEqual({ ...PEN, extraLiftMs: 150, upPct: 81 });
  });
});

it("a press that is refused shows the plot's height again", async () => {
  const { raise, shown, refuse } = openPage();
  raise("upPct");
  await refuse(0);
  expect(shown()).toEqual(PEN);
});
