import type { Job } from "../../../src/schema/index.js";

/** Queue in its order, then history as a set: times of the same millisecond have no order. */
export function pictureOf(jobs: readonly Job[]): string {
  const word = (job: Job): string => `${job.id}:${job.state}`;
  const queued = jobs.filter((job) => job.state === "queued").map(word);
  const ended = jobs.filter((job) => job.state !== "queued").map(word);
  return `${queued.join(" ")} | ${ended.sort().join(" ")}`;
}
