/** The place from which a plot continues, while it has not drawn anything since it was resumed. */
import { afterEach, beforeEach, describe, expect, it } from "vitest";
import type { JobQueue } from "../../host/queue/job-queue.js";
import { prepareDataDir } from "../../server/storage/data-dir.js";
import type { Store } from "../../server/storage/store.js";
import { PlotwrightError } from "../../src/index.js";
import { DEFAULT_PLOT_SETTINGS, type JobPlace } from "../../src/schema/index.js";
import type { LedPlotter, LedRun } from "./support/fakes.js";
import { drawingOf } from "./support/jobs.js";
import { openQueueIn } from "./support/open-queue.js";
import { folderOfTest } from "../support/folders.js";

const PLACE: JobPlace = { strokeIndex: 1, alongMm: 0 };

let dir: string;
let store: Store;
let plotter: LedPlotter;
let queue: JobQueue;

beforeEach(() => {
  dir = folderOfTest();
  prepareDataDir(dir);
  ({ store, plotter, queue } = openQueueIn(dir));
});
afterEach(async () => {
  await queue.close();
  store.close();
});

const settled = (): Promise<void> => new Promise((resolve) => setImmediate(resolve));

/** Starts a job at PLACE; nothing is drawn yet. */
async function started(): Promise<{ id: string; run: LedRun }> {
  const { id } = await queue.add({
    name: "fern",
    settings: DEFAULT_PLOT_SETTINGS,
    drawing: drawingOf("fern"),
    from: PLACE,
  });
  await queue.start(id);
  return { id, run: await nextRun() };
}

async function nextRun(): Promise<LedRun> {
  const run = await plotter.nextRun();
  await settled();
  return run;
}

async function cancelled(id: string, run: LedRun): Promise<void> {
  queue.plots.cancel(id);
  run.end({ kind: "cancelled" });
  await settled();
}

describe("the place of a job that was resumed, and has not drawn since", () => {
  it("stays if it is cancelled, any number of times", async () => {
    const { id, run: first } = await started();
    for (let run = first, times = 0; times < 3; times++) {
      queue.plots.resume(id);
      expect(queue.get(id)).toMatchObject({ state: "plotting", place: null });
      await cancelled(id, run);
      expect(queue.get(id)).toMatchObject({ state: "cancelled", place: PLACE });
      queue.plots.recover(id);
      run = await nextRun();
    }
  });

  it("stays if the server is killed", async () => {
    const { id, run } = await started();
    await cancelled(id, run);
    queue.plots.recover(id);
    await nextRun();
    queue.plots.resume(id);
    store.close();
    ({ store, plotter, queue } = openQueueIn(dir));
    expect(queue.get(id)).toMatchObject({ state: "interrupted", place: PLACE });
  });

  it("stays if the rest could not be planned", async () => {
    const { id, run } = await started();
    await cancelled(id, run);
    queue.plots.recover(id);
    const again = await nextRun();
    again.fail(new PlotwrightError("too-large", "There was no memory for it."));
    await settled();
    expect(queue.get(id)).toMatchObject({ state: "interrupted", place: PLACE });
  });
});
