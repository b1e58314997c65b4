import { describe, expect, it } from "vitest";
import { machineById } from "../../../src/index.js";
import { DEFAULT_PLOT_SETTINGS, type ServerEvent } from "../../../src/schema/index.js";
import { parseServerEvent } from "../../../src/schema/index.js";
import { DEFAULT_VIEW } from "../../../web/state/persist.js";
import { applyServerEvent } from "../../../web/state/server-events.js";
import {
  activeJob,
  createPageStore,
  currentPlotter,
  lostByHand,
  needsTick,
  type PageState,
} from "../../../web/state/store.js";
import { makeJob, makePlotter } from "../../support/jobs/jobs-on-page.js";

const start = (): PageState =>
  createPageStore({ settings: DEFAULT_PLOT_SETTINGS, view: DEFAULT_VIEW }).getState();
const after = (state: PageState, ...events: ServerEvent[]): PageState =>
  events.reduce((now, event) => ({ ...now, ...applyServerEvent(now, event) }), state);
const snapshot = (...ids: string[]): ServerEvent => ({
  type: "snapshot",
  snapshot: {
    version: "0.1.0",
    queue: { runOn: false },
    queues: {},
    operator: null,
    serverNotices: [],
    localName: null,
    machines: [],
    plotters: [makePlotter("virtual")],
    plotterSettings: {},
    jobs: ids.map((id) => makeJob(id)),
    hasOlderJobs: false,
  },
});
const progress = (jobId: string, share: number): ServerEvent => ({
  type: "progress",
  jobId,
  plotterId: "virtual",
  progress: share,
  elapsedS: 10,
  remainingS: 30,
  planS: 9.5,
  xMm: 12,
  yMm: 34,
  penUp: false,
  penMoving: false,
  atMs: 0,
  heldBackMs: 0,
  ahead: [],
});

describe("server events", () => {
  it("a snapshot replaces everything and chooses a plotter", () => {
    const state = after(start(), snapshot("old"), snapshot("a", "b"));
    expect(state.jobs.map(({ id }) => id)).toEqual(["a", "b"]);
    expect(currentPlotter(state)?.id).toBe("virtual");
  });

  it("messages of jobs, plotters and the server name the page's controls, not flags", () => {
    const message = 'choose its model with --machine, or "machine" in the settings.';
    const connected = snapshot() as Extract<ServerEvent, { type: "snapshot" }>;
    const plotter = { ...makePlotter("virtual"), message };
    const notice = { id: "n", at: "2026-01-01T00:00:00.000Z", message };
    const job = { ...makeJob("a"), message };
    const parts = { plotters: [plotter], jobs: [job], serverNotices: [notice] };
    for (const state of [
      after(start(), { type: "snapshot", snapshot: { ...connected.snapshot, ...parts } }),
      after(start(), { type: "plotter", plotter }, { type: "job", job }, { type: "notice", notice }),
      after(
        start(),
        { type: "plotters", plotters: [plotter] },
        { type: "job", job },
        { type: "notice", notice },
      ),
    ])
      expect([...state.plotters, ...state.jobs, ...state.serverNotices].map((item) => item.message)).toEqual(
        Array(3).fill("choose its model with “Model”."),
      );
  });

  it("the machines come with the snapshot, and again when one is stored", () => {
    const listed = (widthMm: number) => ({
      ...machineById("axidraw-v3"),
      id: "mine",
      widthMm,
      builtIn: false,
    });
    const connected = snapshot() as Extract<ServerEvent, { type: "snapshot" }>;
    const state = after(start(), {
      type: "snapshot",
      snapshot: { ...connected.snapshot, machines: [listed(300)] },
    });
    expect(state.machines).toEqual([listed(300)]);
    const stored = parseServerEvent(JSON.stringify({ type: "machines", machines: [listed(600)] }));
    expect(after(state, stored!).machines).toEqual([listed(600)]);
  });

  it("a job is replaced in its place, or added at the end", () => {
    const state = after(
      start(),
      snapshot("a", "b"),
      { type: "job", job: makeJob("a", { state: "plotting" }) },
      { type: "job", job: makeJob("c") },
    );
    expect(state.jobs.map(({ id, state: s }) => `${id} ${s}`)).toEqual([
      "a plotting",
      "b queued",
      "c queued",
    ]);
    expect(activeJob(state)?.id).toBe("a");
  });

  it.each([
    ["corner", { xMm: null }],
    ["height", { heightUnsure: true }],
    ["both", { xMm: null, heightUnsure: true }],
  ] as const)(
    "a plot goes on only after a tick if its plotter has lost the %s, and is ticked again",
    (lost, more) => {
      const job = makeJob("a", { state: "paused", progress: 0.4 });
      const plotter = makePlotter("virtual", more);
      const held = after(start(), { type: "plotter", plotter }, { type: "job", job });
      expect(lostByHand(held, job)).toBe(lost);
      expect(needsTick(held, job)).toBe(true);
      const ticked = after({ ...held, tickedJobId: job.id }, { type: "plotter", plotter });
      expect(needsTick(ticked, job)).toBe(false);
      const known = after(ticked, { type: "plotter", plotter: makePlotter("virtual") });
      expect(lostByHand(known, job)).toBeNull();
      expect(needsTick(after(known, { type: "plotter", plotter }), job)).toBe(true);
      // Nothing of it is drawn.
      expect(lostByHand(held, { ...job, progress: 0 })).toBeNull();
    },
  );

  it("an order event sorts, even with unknown ids", () => {
    const state = after(start(), snapshot("a", "b", "c"), { type: "order", ids: ["c", "ghost", "a"] });
    expect(state.jobs.map(({ id }) => id)).toEqual(["c", "a", "b"]);
  });

  it("progress moves the bar and the pen", () => {
    const state = after(start(), snapshot("a"), progress("a", 0.25));
    expect(state.jobs[0]).toMatchObject({ progress: 0.25, remainingS: 30 });
    expect(state.live).toMatchObject({ jobId: "a", planS: 9.5 });
    expect(currentPlotter(state)).toMatchObject({ xMm: 12, yMm: 34, penUp: false, penMoving: false });
  });

  it("the live plot ends with its job", () => {
    const state = after(start(), snapshot("a"), progress("a", 0.9), {
      type: "job",
      job: makeJob("a", { state: "done", progress: 1 }),
    });
    expect(state.live).toBeNull();
    expect(activeJob(state)).toBeNull();
  });

  it("a snapshot keeps the live plot while its job is plotting, and drops it otherwise", () => {
    const plotting = after(start(), snapshot("a", "b"), progress("a", 0.5));
    const reconnected = (...jobs: ReturnType<typeof makeJob>[]): PageState["live"] => {
      const connected = snapshot() as Extract<ServerEvent, { type: "snapshot" }>;
      return after(plotting, { type: "snapshot", snapshot: { ...connected.snapshot, jobs } }).live;
    };
    expect(reconnected(makeJob("b"), makeJob("a", { state: "plotting" }))).toMatchObject({ jobId: "a" });
    expect(reconnected(makeJob("a", { state: "done" }))).toBeNull();
    expect(reconnected(makeJob("a", { state: "cancelled" }), makeJob("b", { state: "plotting" }))).toBeNull();
    expect(reconnected(makeJob("b", { state: "plotting" }))).toBeNull();
    expect(reconnected()).toBeNull();
  });

  it("a removed job is gone", () => {
    expect(after(start(), snapshot("a", "b"), { type: "job-removed", id: "a" }).jobs).toHaveLength(1);
  });

  it("new expected times change only the jobs that they name", () => {
    const state = after(start(), snapshot("a", "b"), { type: "expected", expectedS: { b: 99 } });
    expect(state.jobs.map(({ expectedS }) => expectedS)).toEqual([makeJob("a").expectedS, 99]);
  });

  it("an unknown event is ignored", () => {
    expect(parseServerEvent("not json")).toBeNull();
    expect(parseServerEvent('{"type":"weather"}')).toBeNull();
    expect(parseServerEvent('{"type":"job-removed","id":"a"}')).toEqual({ type: "job-removed", id: "a" });
  });
});
