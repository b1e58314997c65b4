/** A queue on a data folder, with one plotter that the test controls. */
import { expect } from "vitest";
import { DISK_FULL } from "../../../host/disk-fault.js";
import { JobQueue } from "../../../host/queue/job-queue.js";
import type { Claims } from "../../../host/queue/queue-parts.js";
import { DrawingFiles } from "../../../server/storage/drawing-files.js";
import { Store } from "../../../server/storage/store.js";
import type { Planning } from "../../../host/planning/planning.js";
import type { ServerEvent } from "../../../src/schema/index.js";
import { LED_PLANNING, LedPlotter } from "./fakes.js";

export interface OpenQueue {
  readonly store: Store;
  readonly plotter: LedPlotter;
  readonly events: ServerEvent[];
  readonly logged: string[];
  readonly queue: JobQueue;
}

export function openQueueIn(dir: string, planning: Planning = LED_PLANNING, claims?: Claims): OpenQueue {
  const store = Store.open(dir);
  const plotter = new LedPlotter();
  const events: ServerEvent[] = [];
  const logged: string[] = [];
  const queue = new JobQueue({
    store,
    files: new DrawingFiles(dir, 1_000_000),
    planning,
    plotters: new Map([[plotter.id, plotter]]),
    // What is announced is already on disk, unless the disk is reported as full.
    announce: (event) => {
      const isUnsaved = event.type === "job" && event.job.message?.includes(DISK_FULL) === true;
      if (event.type === "job" && !isUnsaved) expect(store.jobs()).toContainEqual(event.job);
      events.push(event);
    },
    nowIso: () => new Date().toISOString(),
    log: (line) => logged.push(line),
    claims,
  });
  return { store, plotter, events, logged, queue };
}
