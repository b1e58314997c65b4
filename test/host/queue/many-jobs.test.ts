/**
 * The queue's work at the end of a plot must not grow with the number of waiting jobs: other plotters are
 * plotting meanwhile.
 */
import { afterEach, describe, expect, it, vi } from "vitest";
import { prepareDataDir } from "../../../server/storage/data-dir.js";
import { DrawingFiles } from "../../../server/storage/drawing-files.js";
import { JobQueue } from "../../../host/queue/job-queue.js";
import { Store } from "../../../server/storage/store.js";
import type { ServerEvent } from "../../../src/schema/index.js";
import { LED_PLANNING, LedPlotter } from "../../support/jobs/led-plotter.js";
import { STATS, drawingOf, makeJob } from "../../support/jobs/jobs.js";
import { folderOfTest } from "../../support/processes/folders.js";

const SLOWER = 1.25;

afterEach(() => vi.restoreAllMocks());

const settled = (): Promise<void> => new Promise((resolve) => setImmediate(resolve));

/** Plots one job with `waitingCount` others behind it: the store calls and events at its end. */
async function endOfPlot(waitingCount: number): Promise<{ asked: string[]; announced: string[] }> {
  const dir = folderOfTest();
  prepareDataDir(dir);
  const store = Store.open(dir);
  store.transaction(() => {
    for (let i = 0; i <= waitingCount; i++) store.addJob(makeJob(`job-${i}`), drawingOf(`job-${i}`));
  });
  const plotter = new LedPlotter();
  const events: ServerEvent[] = [];
  let nowMs = Date.parse("2026-01-01T00:00:00Z");
  const queue = new JobQueue({
    store,
    files: new DrawingFiles(dir, 1_000_000),
    planning: LED_PLANNING,
    plotters: new Map([[plotter.id, plotter]]),
    announce: (event) => events.push(event),
    nowIso: () => new Date(nowMs).toISOString(),
  });
  try {
    await queue.start("job-0");
    const run = await plotter.nextRun();
    await settled();
    events.length = 0;
    nowMs += STATS.durationS * SLOWER * 1_000;
    const asked = spyOnStore();
    run.end({ kind: "done" });
    await settled();
    vi.restoreAllMocks();
    const expected = queue.list().filter((job) => job.expectedS === STATS.durationS * SLOWER);
    expect(expected).toHaveLength(waitingCount);
    const stored = store.jobs().filter((job) => job.expectedS === STATS.durationS * SLOWER);
    expect(stored).toHaveLength(waitingCount);
    return { asked, announced: events.map(({ type }) => type) };
  } finally {
    await queue.close();
    store.close();
  }
}

/** The names of the store's methods, in the order of the calls. */
function spyOnStore(): string[] {
  const calls: string[] = [];
  const methods = Object.entries(Object.getOwnPropertyDescriptors(Store.prototype));
  for (const [name, { value }] of methods) {
    if (name === "constructor" || typeof value !== "function") continue;
    const real = value as (...args: unknown[]) => unknown;
    vi.spyOn(Store.prototype, name as "order").mockImplementation(function (this: Store, ...args: unknown[]) {
      calls.push(name);
      return real.apply(this, args) as string[];
    });
  }
  return calls;
}

describe("the end of a plot", () => {
  it("makes as many store calls with 1 000 waiting jobs as with 3, and sends as many events", async () => {
    const few = await endOfPlot(3);
    const many = await endOfPlot(1_000);
    expect(few.announced.filter((type) => type === "expected")).toHaveLength(1);
    expect(many).toEqual(few);
  });
});
