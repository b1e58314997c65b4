/** What may be done with a job of the queue that several servers share. */
import { SERVER_LOST_AFTER_MS, type Plotter, type SharedJob } from "../../src/schema/index.js";

/** The server that took it has not been heard of for long; it may be off, or only cut off. */
export const isServerGone = ({ state, serverSeenAt }: SharedJob, nowMs: number): boolean =>
  (state === "taken" || state === "stored") &&
  (serverSeenAt === null || nowMs - Date.parse(serverSeenAt) > SERVER_LOST_AFTER_MS);

export const wayOut = (job: SharedJob, nowMs: number): "withdraw" | "give-back" | null => {
  if (job.state === "waiting") return "withdraw";
  return isServerGone(job, nowMs) && !job.hasBegun ? "give-back" : null;
};

/** Id of the machine whose every plotter may have the job; null for a job that is one plotter's. */
export const machineWanted = ({ target }: SharedJob): string | null =>
  /^machine (.+)$/.exec(target)?.[1] ?? null;

/** This server's plotters that do not get a waiting job only because their model is not set. */
export const leftOut = (job: SharedJob, plotters: readonly Plotter[]): readonly Plotter[] =>
  job.state === "waiting" && machineWanted(job) !== null
    ? plotters.filter(({ machine }) => machine === null)
    : [];
