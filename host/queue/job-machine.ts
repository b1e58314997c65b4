/**
 * The state machine of a job, as one pure function: (job, event) -> job; throws `conflict`.
 *
 *   queued ──start──> plotting ──finish──> done
 *                       │  ^ └──fail──> failed ──requeue──> queued (also from done, cancelled, interrupted)
 *                  hold v  │ release
 *                      paused ──cancel──> cancelled      (also from queued, plotting, interrupted)
 *
 *   plotting, paused ──interrupt──> interrupted ──recover──> paused: nothing moves until it is resumed
 *                                 cancelled ──recover──> paused: only if part of it is drawn; continues there
 *
 * The queue applies, stores and announces the result.
 */
import { PlotwrightError } from "../../src/index.js";
import type { Job, JobPlace, JobState } from "../../src/schema/index.js";

export type JobEvent =
  | { readonly type: "start" }
  | { readonly type: "hold" }
  | { readonly type: "release" }
  | { readonly type: "finish" }
  | { readonly type: "fail"; readonly message: string }
  | { readonly type: "interrupt"; readonly message: string; readonly place: JobPlace | null }
  | { readonly type: "recover" }
  /** `place`: the first place not drawn yet; null if nothing is drawn. */
  | { readonly type: "cancel"; readonly place: JobPlace | null }
  | { readonly type: "requeue" };

/** The states in which each event is allowed, and the state it leads to. */
export const TRANSITIONS: Readonly<
  Record<JobEvent["type"], { readonly from: readonly JobState[]; readonly to: JobState }>
> = {
  start: { from: ["queued"], to: "plotting" },
  hold: { from: ["plotting"], to: "paused" },
  release: { from: ["paused"], to: "plotting" },
  finish: { from: ["plotting"], to: "done" },
  fail: { from: ["plotting", "paused"], to: "failed" },
  interrupt: { from: ["plotting", "paused"], to: "interrupted" },
  recover: { from: ["interrupted", "cancelled"], to: "paused" },
  cancel: { from: ["queued", "plotting", "paused", "interrupted"], to: "cancelled" },
  requeue: { from: ["done", "failed", "cancelled", "interrupted"], to: "queued" },
};

/**
 * The job after the event, at the given time (ISO 8601); throws `conflict` if the event is not allowed now.
 */
export function applyJobEvent(job: Job, event: JobEvent, nowIso: string): Job {
  const { from, to } = TRANSITIONS[event.type];
  const isUndrawn = event.type === "recover" && job.state === "cancelled" && job.place === null;
  if (!from.includes(job.state) || isUndrawn) throw cannot(job, event.type);
  const next: Job = { ...job, state: to, message: null };
  switch (event.type) {
    case "start":
      return { ...next, startedAt: nowIso };
    case "hold":
      return next;
    case "recover":
      return { ...next, remainingS: job.remainingS ?? remainingS(job), endedAt: null };
    case "release":
      return { ...next, wait: null };
    case "interrupt":
      return { ...next, message: event.message, place: event.place };
    case "finish":
      return { ...next, progress: 1, place: null, wait: null, remainingS: 0, endedAt: nowIso };
    case "fail":
      return { ...next, message: event.message, wait: null, remainingS: null, endedAt: nowIso };
    case "cancel":
      return {
        ...next,
        place: job.startedAt === null ? null : event.place,
        remainingS: null,
        endedAt: nowIso,
      };
    case "requeue":
      return {
        ...next,
        place: null,
        wait: null,
        speedPct: 100,
        plottedS: null,
        progress: 0,
        elapsedS: 0,
        remainingS: null,
        startedAt: null,
        endedAt: null,
      };
  }
}

/** The planned remaining time; null if the job was never planned. */
const remainingS = ({ stats, progress }: Job): number | null =>
  stats === null ? null : stats.durationS * (1 - progress);

const VERBS: Readonly<Record<JobEvent["type"], string>> = {
  start: "started",
  hold: "paused",
  release: "resumed",
  finish: "finished",
  fail: "failed",
  interrupt: "interrupted",
  recover: "continued",
  cancel: "cancelled",
  requeue: "queued again",
};

function cannot(job: Job, event: JobEvent["type"]): PlotwrightError {
  return new PlotwrightError(
    "conflict",
    `"${job.name}" is ${job.state}, so it can't be ${VERBS[event]} now.`,
  );
}
