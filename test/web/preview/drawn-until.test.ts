import { describe, expect, it } from "vitest";
import { DEFAULT_MOTION, DEFAULT_PEN, plan, type Trajectory } from "../../../src/index.js";
import { DEFAULT_PLOT_SETTINGS, type Job } from "../../../src/schema/index.js";
import { drawnUntilS } from "../../../web/preview/drawn-until.js";
import { createPageStore, type PageState } from "../../../web/state/store.js";
import { DEFAULT_VIEW } from "../../../web/state/persist.js";
import type { Planned } from "../../../web/worker/protocol.js";
import { strokesOf } from "../../support/plots/local-planner.js";
import { makeJob } from "../../support/jobs/jobs-on-page.js";

const trajectory: Trajectory = plan(strokesOf([0, 0, 100, 0], [0, 10, 100, 10]), DEFAULT_MOTION, DEFAULT_PEN);
const halfS = trajectory.totalS / 2;

const pageWith = (job: Job, more: Partial<PageState> = {}): PageState => ({
  ...createPageStore({ settings: DEFAULT_PLOT_SETTINGS, view: DEFAULT_VIEW }).getState(),
  planned: { trajectory } as Planned,
  drawing: { key: "a", name: "a", text: "", sheet: null, jobId: job.id, sourceId: job.id },
  jobs: [job],
  ...more,
});
const live = {
  type: "progress" as const,
  jobId: "a",
  plotterId: "virtual",
  planS: 1.5,
  xMm: 0,
  yMm: 0,
  penUp: false,
  penMoving: false,
  atMs: 0,
  heldBackMs: 0,
  ahead: [],
};

describe("how much of the drawing on the paper is drawn", () => {
  it.each(["paused", "interrupted"] as const)("is the job's place while it is %s", (state) => {
    const second = drawnUntilS(pageWith(makeJob("a", { state, place: { strokeIndex: 1, alongMm: 50 } })))!;
    const first = drawnUntilS(
      pageWith(makeJob("a", { state, place: { strokeIndex: 0, alongMm: 50 } }), { live }),
    )!;
    expect(first).toBeGreaterThan(0);
    expect(first).toBeLessThan(halfS);
    expect(second).toBeGreaterThan(halfS);
    expect(second).toBeLessThan(trajectory.totalS);
  });

  it("is the job's progress if it lost its board and its place is still the beginning", () => {
    const place = { strokeIndex: 0, alongMm: 0 };
    const job = makeJob("a", { state: "interrupted", progress: 0.25, place });
    expect(drawnUntilS(pageWith(job))).toBeCloseTo(halfS / 2, 9);
  });

  it("is the job's place during a pen change, also when the job was opened again with no report yet", () => {
    const place = { strokeIndex: 1, alongMm: 0 };
    const wait = { kind: "pen" as const, layerName: "Red", penName: null, color: null };
    const job = makeJob("a", { state: "paused", progress: 0, place, wait });
    for (const report of [null, live]) {
      const atS = drawnUntilS(pageWith(job, { live: report }))!;
      expect(atS).toBeGreaterThan(halfS * 0.8);
      expect(atS).toBeLessThan(trajectory.totalS);
    }
  });

  it("is the last report while it plots, or its progress before the first report", () => {
    const job = makeJob("a", { state: "plotting", progress: 0.25 });
    expect(drawnUntilS(pageWith(job, { live }))).toBe(1.5);
    expect(drawnUntilS(pageWith(job))).toBe(trajectory.totalS / 4);
    expect(drawnUntilS(pageWith(job, { live: { ...live, jobId: "b" } }))).toBe(trajectory.totalS / 4);
  });

  it("is unknown for a job that waits or has ended, and for another drawing, so all of it is shown", () => {
    expect(drawnUntilS(pageWith(makeJob("a")))).toBeNull();
    expect(drawnUntilS(pageWith(makeJob("a", { state: "done", progress: 1 })))).toBeNull();
    const job = makeJob("a", { state: "paused", progress: 0.5 });
    expect(drawnUntilS(pageWith(job, { drawing: null }))).toBeNull();
    expect(drawnUntilS(pageWith(job, { planned: null }))).toBeNull();
  });
});
