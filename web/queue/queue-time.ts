/** How much a plotter's queue has to do. */
import type { Job } from "../../src/schema/index.js";

interface QueueTime {
  readonly totalS: number;
  /** It gets to its end by itself from here. False while it is paused, or when it stops for paper on the way. */
  readonly isRunning: boolean;
}

export const queueTime = (jobs: readonly Job[], runsOn: boolean): QueueTime => ({
  totalS: jobs.reduce((sum, job) => sum + (job.remainingS ?? job.expectedS ?? job.stats?.durationS ?? 0), 0),
  isRunning: jobs.some(({ state }) => state === "plotting") && (runsOn || jobs.length === 1),
});
