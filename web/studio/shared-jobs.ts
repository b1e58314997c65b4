/** What may be done with a job of the queue that several servers share. */
import { SERVER_LOST_AFTER_MS, type SharedJob } from "../../src/schema/index.js";

/** The server that took it has not been heard of for long; it may be off, or only cut off. */
export const isServerGone = ({ state, serverSeenAt }: SharedJob, nowMs: number): boolean =>
  (state === "taken" || state === "stored") &&
  (serverSeenAt === null || nowMs - Date.parse(serverSeenAt) > SERVER_LOST_AFTER_MS);

export const wayOut = (job: SharedJob, nowMs: number): "withdraw" | "give-back" | null => {
  if (job.state === "waiting") return "withdraw";
  return isServerGone(job, nowMs) && !job.hasBegun ? "give-back" : null;
};
