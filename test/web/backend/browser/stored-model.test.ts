/** The browser's model of jobs and plotters behaves like the server's database. */
import { afterEach, beforeEach, describe, expect, it } from "vitest";
import type { JobStore, PlotterStore } from "../../../../host/storage.js";
import { JobList } from "../../../../host/queue/job-list.js";
import { applyJobEvent, TRANSITIONS, type JobEvent } from "../../../../host/queue/job-states.js";
import { queuedJob } from "../../../../host/queue/job-states.js";
import { Store } from "../../../../server/storage/store.js";
import { prepareDataDir } from "../../../../server/storage/data-dir.js";
import { DEFAULT_PLOT_SETTINGS, type Job } from "../../../../src/schema/index.js";
import { StoredModel } from "../../../../web/backend/browser/stored-model.js";
import { seeded } from "../../../support/plots/live-plot.js";
import { folderOfTest } from "../../../support/processes/folders.js";

/** IndexedDB as maps; values are copied, as IndexedDB does. */
class Records {
  readonly jobs = new Map<string, unknown>();
  readonly plotters = new Map<string, unknown>();
  readonly settings = new Map<string, unknown>();
  readonly journals = new Map<string, unknown>();

  put(store: string, key: string, value: unknown): void {
    this.of(store).set(key, structuredClone(value));
  }

  remove(store: string, key: string): void {
    this.of(store).delete(key);
  }

  private of(store: string): Map<string, unknown> {
    return this[store as "jobs"];
  }
}

let dir: string;
let server: Store;
let records: Records;
let browser: StoredModel;

beforeEach(() => {
  dir = folderOfTest();
  prepareDataDir(dir);
  server = Store.open(dir);
  records = new Records();
  browser = new StoredModel(records, records);
});
afterEach(() => {
  server.close();
});

const SIZE = { widthMm: 60, heightMm: 40, scaleX: 1, scaleY: 1, turnedDeg: 0 };
const STATS = {
  size: SIZE,
  strokeCount: 1,
  pointCount: 2,
  drawMm: 3,
  travelMm: 4,
  penLiftCount: 1,
  durationS: 10,
};

function newJob(number: number): Job {
  const from = { plotterId: number % 2 === 0 ? "main" : "other", name: `job ${number}`, warnings: [] };
  return queuedJob({ ...from, settings: DEFAULT_PLOT_SETTINGS, stats: STATS }, "2026-01-01T00:00:00.000Z");
}

/** Does the same on both. Both must throw or neither. */
function both<T>(act: (store: JobStore & PlotterStore) => T): T | undefined {
  const [a, b] = [server, browser].map((store) => {
    try {
      return { value: act(store) };
    } catch (error) {
      return { fault: (error as Error).message };
    }
  });
  expect(b).toEqual(a);
  return "value" in a ? a.value : undefined;
}

describe("the browser's stored model", () => {
  it("agrees with the server's database after any changes", { timeout: 60_000 }, () => {
    const random = seeded(5);
    const pick = <T>(list: readonly T[]): T => list[Math.floor(random() * list.length)];
    const ids: string[] = [];
    for (let step = 0; step < 400; step++) {
      const id = ids.length === 0 ? "none" : pick(ids);
      const kind = Math.floor(random() * 7);
      if (kind <= 1 || ids.length < 3) {
        const job = newJob(step);
        const beforeId = random() < 0.3 ? id : null;
        // The server refuses a place before an ended job, and then adds nothing.
        const isWaiting = browser.jobs().some((one) => one.id === beforeId && one.endedAt === null);
        both((store) => store.addJob(job, { id: job.id, bytes: 1 }, isWaiting ? beforeId : null));
        ids.push(job.id);
      } else if (kind === 2) both((store) => store.moveJob(id, null));
      else if (kind === 3) {
        const other = pick(ids);
        both((store) => store.moveJob(id, other));
      } else if (kind === 4) {
        const job = browser.jobs().find((one) => one.id === id)!;
        const events = (Object.keys(TRANSITIONS) as JobEvent["type"][]).filter(
          (type) => type !== "recover" && TRANSITIONS[type].from.includes(job.state),
        );
        const event = { type: pick(events), message: "m", place: { strokeIndex: 0, alongMm: 1 } } as JobEvent;
        const next = applyJobEvent(job, event, new Date(1e12 + step * 1_000).toISOString());
        both((store) => store.saveJob(next));
      } else if (kind === 5) both((store) => store.saveExpected("main", 1 + 0.1 * (step % 3)));
      else {
        both((store) => store.removeJob(id));
        ids.splice(ids.indexOf(id), 1);
      }
      expect(browser.order()).toEqual(server.order());
    }
    expect(browser.jobs()).toEqual(server.jobs());
    // Reading returns what was written.
    expect(new StoredModel(records, records).jobs()).toEqual(server.jobs());
  });

  it("keeps plotters, settings and journals", () => {
    both((store) => store.savePlotter({ id: "main", name: null, device: "auto", machine: null }));
    both((store) => store.savePlotter({ id: "b", name: "B", device: "virtual", machine: null }));
    both((store) => store.savePlotterSettings("main", { heights: 1 }));
    both((store) => store.savePlotter({ id: "main", name: "A", device: "auto", machine: "x" }));
    both((store) => store.savePlotterSettings("none", {}));
    both((store) => store.plotters());
    both((store) => store.plotterSettings());
    both((store) => store.removePlotter("b"));
    both((store) => store.plotters());
    both((store) => store.saveSetting("queue:main", { runOn: true }));
    both((store) => store.setting("queue:main"));
    both((store) => store.setting("nothing"));
    const job = newJob(0);
    both((store) => store.addJob(job, { id: "d", bytes: 1 }));
    both((store) => store.saveJournal(job.id, { place: { stroke: 1, alongMm: 2 } }));
    both((store) => store.journal(job.id));
    both((store) => store.removeJob(job.id));
    both((store) => store.drawingOf(job.id));
    const again = new StoredModel(records, records);
    expect(again.plotters()).toEqual(server.plotters());
    expect(again.setting("queue:main")).toEqual({ runOn: true });
    expect(again.journal(job.id)).toBeUndefined();
  });

  it("counts jobs that it can't read, and leaves them stored", () => {
    records.put("jobs", "x", { job: { id: "x", state: "of a later version" }, drawing: "d", position: 1 });
    const model = new StoredModel(records, records);
    expect(model.unreadableCount).toBe(1);
    expect(model.jobs()).toEqual([]);
    expect(records.jobs.has("x")).toBe(true);
  });
});

describe("the history", () => {
  const ENDED_COUNT = 120;
  /** Four jobs end at the same moment. */
  const ended = (index: number): Job => ({
    ...queuedJob(
      { plotterId: `plotter-${index % 3}`, name: `Moonrise ${index}`, settings, stats: null, warnings: [] },
      NOW,
    ),
    state: "done",
    endedAt: new Date(Date.parse(NOW) + 1_000 * Math.floor(index / 4)).toISOString(),
  });
  const settings = DEFAULT_PLOT_SETTINGS;
  const NOW = "2026-01-01T00:00:00.000Z";

  const idsOf = (jobs: readonly Job[]): string[] => jobs.map(({ id }) => id);

  /** All parts of the history after the ids that are known, one after the other. */
  const rest = (list: JobList, known: readonly string[], plotterId?: string): string[] => {
    const found = [...known];
    for (;;) {
      const page = list.older({ after: found.at(-1), plotterId });
      expect(page.jobs.length).toBeLessThanOrEqual(50);
      found.push(...idsOf(page.jobs));
      if (!page.hasOlderJobs) return found;
    }
  };

  it("is read in parts of 50 from both stores, in order, of one plotter or of all", () => {
    for (const store of [server, browser]) {
      for (let index = 0; index < ENDED_COUNT; index++) store.addJob(ended(index), { id: "d", bytes: 1 });
      const waiting = { ...ended(0), id: crypto.randomUUID(), state: "queued", endedAt: null } as const;
      store.addJob(waiting, { id: "d", bytes: 1 });
      const announced: string[][] = [];
      const list = new JobList({
        store,
        nowIso: () => NOW,
        announce: (event) => void (event.type === "order" && announced.push(event.ids)),
      });
      const { jobs, hasOlderJobs } = list.recent();
      expect([jobs[0], jobs.length, hasOlderJobs]).toEqual([waiting, 51, true]);
      list.announceOrder();
      expect(announced).toEqual([idsOf(jobs)]);
      const [, ...history] = idsOf(list.list());
      expect(rest(list, idsOf(jobs).slice(1))).toEqual(history);
      expect(rest(list, [])).toEqual(history);
      const own = history.filter((id) => list.get(id).plotterId === "plotter-1");
      expect(rest(list, [], "plotter-1")).toEqual(own);
      const named = list.older({ name: "RISE 11" }).jobs.map(({ name }) => name);
      expect(named).toEqual([
        "Moonrise 119",
        "Moonrise 118",
        "Moonrise 117",
        "Moonrise 116",
        "Moonrise 115",
        "Moonrise 114",
        "Moonrise 113",
        "Moonrise 112",
        "Moonrise 111",
        "Moonrise 110",
        "Moonrise 11",
      ]);
      expect(list.older({ name: "rise 11", plotterId: "plotter-2" }).jobs).toHaveLength(5);
      expect(list.older({ name: "none" })).toEqual({ jobs: [], hasOlderJobs: false });
      expect(() => list.older({ after: "none" })).toThrow("There is no job none.");
      for (const id of history.slice(30)) list.remove(id);
      expect(list.recent()).toMatchObject({ hasOlderJobs: false, jobs: { length: 31 } });
    }
  });
});
