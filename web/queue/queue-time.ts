/** How long a plotter's queue will take. */
import type { Job } from "../../src/schema/index.js";

interface QueueTime {
  readonly totalS: number;
  /** Runs to its end without the user. False while it is paused, or if it stops between jobs for new paper. */
  readonly isRunning: boolean;
}

/** The job's expected duration; null while it is being planned. */
export const expectedSOf = ({ expectedS, stats }: Job): number | null =>
  expectedS ?? stats?.durationS ?? null;

export const queueTime = (jobs: readonly Job[], runsOn: boolean): QueueTime => ({
  totalS: jobs.reduce((sum, job) => sum + (job.remainingS ?? expectedSOf(job) ?? 0), 0),
  isRunning: jobs.some(({ state }) => state === "plotting") && (runsOn || jobs.length === 1),
});
