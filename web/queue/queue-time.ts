/** How long a plotter's queue will take. */
import type { Job } from "../../src/schema/index.js";

interface QueueTime {
  readonly totalS: number;
  /** Runs to its end without the user. False while it is paused, or if it stops between jobs for new paper. */
  readonly isRunning: boolean;
}

export const queueTime = (jobs: readonly Job[], runsOn: boolean): QueueTime => ({
  totalS: jobs.reduce((sum, job) => sum + (job.remainingS ?? job.expectedS ?? job.stats?.durationS ?? 0), 0),
  isRunning: jobs.some(({ state }) => state === "plotting") && (runsOn || jobs.length === 1),
});
