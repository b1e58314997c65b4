/**
 * How much longer plots really take than planned, by machine: the median of the last ones that were finished
 * without a hold. Corrects what the page shows; plans stay as they are.
 */
import type { Job } from "../../src/schema/index.js";

const MOST_JOBS = 20;
/** A plot that took half or twice the time was not the machine's doing. */
const PLAUSIBLE = [0.5, 2] as const;

/** Real seconds for one planned, 1 until there is something to go by. `jobs` newest first. */
export function durationFactor(jobs: readonly Job[], machine: string): number {
  const factors = jobs
    .filter((job) => job.state === "done" && job.settings.machine === machine)
    .flatMap((job) =>
      job.plottedS !== null && job.stats !== null ? [job.plottedS / job.stats.durationS] : [],
    )
    .filter((factor) => factor >= PLAUSIBLE[0] && factor <= PLAUSIBLE[1])
    .slice(0, MOST_JOBS)
    .sort((a, b) => a - b);
  if (factors.length === 0) return 1;
  const middle = factors.length >> 1;
  const upper = factors[middle] ?? 1;
  return factors.length % 2 === 1 ? upper : (upper + (factors[middle - 1] ?? upper)) / 2;
}
