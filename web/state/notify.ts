/** Tells the user, with the system's own notifications, when a plot ends or waits: only after they asked for it. */
import type { Job } from "../../src/schema/index.js";
import { text } from "../text/text.js";
import type { PageStore } from "./store.js";

const words = text.notify;

/** What to say of a job that has changed from one state to another; null when nobody needs to come. */
export const noticeOfChange = (
  before: Job["state"] | null,
  now: Job["state"],
  name: string,
): string | null => {
  if (before === null || before === now) return null;
  if (now === "done") return words.done(name);
  if (now === "failed") return words.failed(name);
  if (now === "interrupted") return words.interrupted(name);
  return null;
};

/** Watches the jobs and hands out sentences; returns a function that stops. */
export const watchJobs = (store: PageStore, say: (sentence: string) => void): (() => void) =>
  store.subscribe((state, before) => {
    if (state.jobs === before.jobs || before.jobs.length === 0) return;
    const states = new Map(before.jobs.map((job) => [job.id, job.state]));
    for (const job of state.jobs) {
      const sentence = noticeOfChange(states.get(job.id) ?? null, job.state, job.name);
      if (sentence !== null) say(sentence);
    }
  });
