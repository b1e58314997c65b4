/** A queue on a data folder, with one or two plotters that the test controls. */
import { expect } from "vitest";
import { DISK_FULL } from "../../../host/disk-fault.js";
import type { Planning } from "../../../host/planning/planning.js";
import { JobQueue } from "../../../host/queue/job-queue.js";
import type { Claims, NewQueueJob } from "../../../host/queue/queue-parts.js";
import { prepareDataDir } from "../../../server/storage/data-dir.js";
import { DrawingFiles } from "../../../server/storage/drawing-files.js";
import { Store } from "../../../server/storage/store.js";
import { DEFAULT_PLOT_SETTINGS, type Job, type ServerEvent } from "../../../src/schema/index.js";
import { LED_PLANNING, LedPlotter, type LedRun } from "./led-plotter.js";
import { drawingOf } from "./jobs.js";

export interface OpenQueue {
  readonly store: Store;
  readonly plotter: LedPlotter;
  readonly events: ServerEvent[];
  readonly logged: string[];
  readonly queue: JobQueue;
  add(name: string, more?: Partial<NewQueueJob>): Promise<Job>;
  /** The run of the job that was started last, once its planner is open. */
  nextRun(): Promise<LedRun>;
  /** Adds a job and starts it. */
  plotting(more?: Partial<NewQueueJob>): Promise<{ readonly id: string; readonly run: LedRun }>;
  close(): Promise<void>;
}

/** Until what the queue has begun is done. */
export const settled = (): Promise<void> => new Promise((resolve) => setImmediate(resolve));

export function openQueueIn(
  dir: string,
  options: {
    readonly planning?: Planning;
    readonly claims?: Claims;
    readonly nowIso?: () => string;
    /** Beside the first one. */
    readonly otherPlotter?: LedPlotter;
  } = {},
): OpenQueue {
  prepareDataDir(dir);
  const store = Store.open(dir);
  const plotter = new LedPlotter();
  const events: ServerEvent[] = [];
  const logged: string[] = [];
  const queue = new JobQueue({
    store,
    files: new DrawingFiles(dir, 1_000_000),
    planning: options.planning ?? LED_PLANNING,
    plotters: new Map([plotter, options.otherPlotter ?? plotter].map((one) => [one.id, one])),
    // What is announced is already on disk, unless the disk is reported as full.
    announce: (event) => {
      const isUnsaved = event.type === "job" && event.job.message?.includes(DISK_FULL) === true;
      if (event.type === "job" && !isUnsaved) expect(store.jobs()).toContainEqual(event.job);
      events.push(event);
    },
    nowIso: options.nowIso ?? (() => new Date().toISOString()),
    log: (line) => logged.push(line),
    claims: options.claims,
  });
  const add = (name: string, more: Partial<NewQueueJob> = {}): Promise<Job> =>
    queue.add({ name, settings: DEFAULT_PLOT_SETTINGS, drawing: drawingOf(name), ...more });
  const nextRun = async (): Promise<LedRun> => {
    const run = await plotter.nextRun();
    await settled();
    return run;
  };
  const plotting = async (more: Partial<NewQueueJob> = {}) => {
    const { id } = await add("fern", more);
    await queue.start(id);
    return { id, run: await nextRun() };
  };
  const close = async (): Promise<void> => {
    await queue.close();
    store.close();
  };
  return { store, plotter, events, logged, queue, add, nextRun, plotting, close };
}
