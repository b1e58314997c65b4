/** Jobs of the shared queue: what can be done with them. */
import { SERVER_LOST_AFTER_MS, type Plotter, type SharedJob } from "../../src/schema/index.js";

/** The server that took the job has not reported for long. It may be off, or have no connection. */
export const isServerGone = ({ state, serverSeenAt }: SharedJob, nowMs: number): boolean =>
  (state === "taken" || state === "stored") &&
  (serverSeenAt === null || nowMs - Date.parse(serverSeenAt) > SERVER_LOST_AFTER_MS);

export const possibleAction = (job: SharedJob, nowMs: number): "withdraw" | "give-back" | null => {
  if (job.state === "waiting") return "withdraw";
  return isServerGone(job, nowMs) && !job.hasBegun ? "give-back" : null;
};

/** For a job that any plotter of one machine may take: the machine's id. Null for a job of a named plotter. */
export const machineWanted = ({ target }: SharedJob): string | null =>
  /^machine (.+)$/.exec(target)?.[1] ?? null;

/** This server's plotters that can't take a waiting job because their model is not set. */
export const leftOut = (job: SharedJob, plotters: readonly Plotter[]): readonly Plotter[] =>
  job.state === "waiting" && machineWanted(job) !== null
    ? plotters.filter(({ machine }) => machine === null)
    : [];
