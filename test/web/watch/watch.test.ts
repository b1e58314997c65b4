/** What Watch computes from the page's state. */
import { describe, expect, it, vi } from "vitest";
import { DEFAULT_MOTION, DEFAULT_PEN, plan, type Trajectory } from "../../../src/index.js";
import { DEFAULT_PLOT_SETTINGS, type Job } from "../../../src/schema/index.js";
import { UNDO } from "../../../web/app/page-actions.js";
import { performByKey, type Page } from "../../../web/state/page-action.js";
import { BackendFault } from "../../../web/backend/backend.js";
import { createServerBackend } from "../../../web/backend/server/server-backend.js";
import { inkBox } from "../../../web/drawing/crop-picture.js";
import { jobUntilS } from "../../../web/preview/drawn-until.js";
import { rowsOf } from "../../../web/queue/copies.js";
import { createActions, type Actions } from "../../../web/state/actions.js";
import { openWatch } from "../../../web/state/open-watch.js";
import { DEFAULT_VIEW } from "../../../web/state/persist.js";
import { createPageStore, shownView, watchedJob } from "../../../web/state/store.js";
import { strokesOf } from "../../support/plots/local-planner.js";
import { makeJob, makePlotter } from "../../support/jobs/jobs-on-page.js";

const makeStore = () => {
  const store = createPageStore({ settings: DEFAULT_PLOT_SETTINGS, view: DEFAULT_VIEW });
  store.setState({ link: "connected", plotters: [makePlotter("virtual")], plotterId: "virtual" });
  return store;
};

describe("Watch", () => {
  it.each(["plotting", "paused", "interrupted"] as const)("opens when a job becomes %s", (state) => {
    const store = makeStore();
    openWatch(store);
    store.setState({ jobs: [makeJob("a")] });
    expect(shownView(store.getState())).toBe("prepare");
    store.setState({ jobs: [makeJob("a", { state })] });
    expect(shownView(store.getState())).toBe("watch");
    expect(watchedJob(store.getState())?.id).toBe("a");
  });

  it("stays closed when it was left for Prepare, and shows the last job after its end", () => {
    const store = makeStore();
    openWatch(store);
    store.setState({ jobs: [makeJob("a", { state: "plotting" })] });
    store.setState({ pageView: "prepare" });
    store.setState({ jobs: [makeJob("a", { state: "plotting", progress: 0.5 })] });
    expect(shownView(store.getState())).toBe("prepare");
    store.setState({ jobs: [makeJob("a", { state: "done", progress: 1 })] });
    expect(watchedJob(store.getState())?.state).toBe("done");
  });

  it("does not open for a mark that is plotted beside a drawing", () => {
    const store = makeStore();
    openWatch(store);
    store.setState({ utilityJobIds: ["mark"], jobs: [makeJob("mark", { state: "plotting" })] });
    expect(shownView(store.getState())).toBe("prepare");
  });

  it("is a watcher's only view", () => {
    const store = makeStore();
    store.setState({ me: { role: "watch", id: null, name: null } });
    expect(shownView(store.getState())).toBe("watch");
  });
});

describe("keys for the laid-out drawing", () => {
  it("are ignored in Watch, which does not show it", () => {
    const store = makeStore();
    const actions = { undo: vi.fn() } as unknown as Actions;
    const press = (): void => performByKey(UNDO, { store, actions } as unknown as Page);
    const { settings, presets, drawing, selectedPieces } = store.getState();
    store.setState({ pageView: "watch", undoStack: [{ settings, presets, drawing, selectedPieces }] });
    press();
    expect(actions.undo).not.toHaveBeenCalled();
    store.setState({ pageView: "prepare" });
    press();
    expect(actions.undo).toHaveBeenCalledTimes(1);
  });
});

describe("how far a watched job is drawn", () => {
  const trajectory: Trajectory = plan(
    strokesOf([0, 0, 100, 0], [0, 10, 100, 10]),
    DEFAULT_MOTION,
    DEFAULT_PEN,
  );

  it("is its place after it was cancelled, and all of it once it is done", () => {
    const place = { strokeIndex: 1, alongMm: 50 };
    const untilS = jobUntilS(makeJob("a", { state: "cancelled", place, progress: 0.7 }), trajectory, null)!;
    expect(untilS).toBeGreaterThan(trajectory.totalS / 2);
    expect(untilS).toBeLessThan(trajectory.totalS);
    expect(jobUntilS(makeJob("a", { state: "done", progress: 1 }), trajectory, null)).toBeNull();
    expect(jobUntilS(makeJob("a"), trajectory, null)).toBe(0);
  });
});

describe("the queue's rows", () => {
  const ids = (jobs: readonly Job[]): string[][] => rowsOf(jobs).map((row) => row.map(({ id }) => id));

  it("put consecutive copies into one row, and nothing else", () => {
    const [a, b, c] = ["a", "b", "c"].map((id) => makeJob(id, { name: "Fern" })) as [Job, Job, Job];
    const other = makeJob("d", { name: "Moss" });
    expect(ids([a, b, other, c])).toEqual([["a", "b"], ["d"], ["c"]]);
    expect(ids([a, { ...b, speedPct: 50 }, c])).toEqual([["a"], ["b"], ["c"]]);
    expect(ids([])).toEqual([]);
  });
});

describe("a thumbnail", () => {
  it("is cropped to the pixels that are neither transparent nor white", () => {
    const [width, height] = [6, 5];
    const data = new Uint8ClampedArray(4 * width * height);
    const set = (x: number, y: number, rgba: readonly number[]): void => data.set(rgba, 4 * (y * width + x));
    for (let x = 0; x < width; x++) set(x, 0, [255, 255, 255, 255]);
    expect(inkBox(data, width, height)).toBeNull();
    set(2, 1, [0, 0, 0, 255]);
    set(4, 3, [200, 30, 30, 90]);
    expect(inkBox(data, width, height)).toEqual({ x: 2, y: 1, width: 3, height: 3 });
  });
});

describe("an action that only the operator may do", () => {
  const makePage = () => {
    const store = makeStore();
    let isOperator = false;
    const duplicate = vi.fn((id: string) =>
      isOperator
        ? Promise.resolve(makeJob(id))
        : Promise.reject(new BackendFault("not-operator", "Somebody else is operating.")),
    );
    const take = () => {
      isOperator = true;
      return Promise.resolve({ operator: { id: "this", name: "Anna" } });
    };
    const server = createServerBackend(() => Promise.reject(new Error("no server")));
    const backend = {
      ...server,
      jobs: { ...server.jobs, duplicate },
      operator: { ...server.operator, take },
    };
    const planner = {
      request: () => undefined,
      export: () => undefined,
      strokes: () => undefined,
      sketches: () => undefined,
      measure: () => Promise.reject(new Error("not asked")),
    };
    const actions = createActions({ store, backend, planner, nowMs: () => 0, after: () => undefined });
    return { store, actions, duplicate };
  };
  const question = async (store: ReturnType<typeof makeStore>) =>
    vi.waitFor(() => {
      const { takeOverQuestion } = store.getState();
      if (!takeOverQuestion) throw new Error("not asked yet");
      return takeOverQuestion;
    });

  it("asks whether to take over, and is then done", async () => {
    const { store, actions, duplicate } = makePage();
    const done = actions.duplicateJob("a");
    (await question(store)).answer(true);
    expect((await done)?.id).toBe("a");
    expect(duplicate).toHaveBeenCalledTimes(2);
    expect(store.getState().takeOverQuestion).toBeNull();
  });

  it("is not done, without an error, if the user declines", async () => {
    const { store, actions } = makePage();
    const done = actions.duplicateJob("a");
    (await question(store)).answer(false);
    expect(await done).toBeNull();
    expect(store.getState().notices).toEqual([]);
  });
});
