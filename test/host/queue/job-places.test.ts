/** The place from which a plot continues, while it has not drawn anything since it was resumed. */
import { afterEach, beforeEach, describe, expect, it } from "vitest";
import { PlotwrightError } from "../../../src/index.js";
import type { JobPlace } from "../../../src/schema/index.js";
import { folderOfTest } from "../../support/processes/folders.js";
import type { LedRun } from "../../support/jobs/led-plotter.js";
import { openQueueIn, settled, type OpenQueue } from "../../support/jobs/open-queue.js";

const PLACE: JobPlace = { strokeIndex: 1, alongMm: 0 };

let dir: string;
let opened: OpenQueue;
beforeEach(() => {
  dir = folderOfTest();
  openQueue();
});
afterEach(() => opened.close());

let { store, queue, nextRun, plotting } = {} as OpenQueue;
function openQueue(): void {
  opened = openQueueIn(dir);
  ({ store, queue, nextRun, plotting } = opened);
}

/** Starts a job at PLACE; nothing is drawn yet. */
const started = () => plotting({ from: PLACE });

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
    openQueue();
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
