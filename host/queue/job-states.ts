/**
 * The state machine of a job (diagram: src/schema/job.ts), as one pure function: (job, event) -> job; throws `conflict`.
 * The queue applies, stores and announces the result. And the first state of a new job.
 */
import { PlotwrightError, type ErrorCode, type StrokePosition } from "../../src/index.js";
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

interface Transition {
  readonly from: readonly JobState[];
  readonly to: JobState;
  /** For the message that it is not allowed now. */
  readonly verb: string;
}

/** The states in which each event is allowed, and the state it leads to. */
export const TRANSITIONS: Readonly<Record<JobEvent["type"], Transition>> = {
  start: { from: ["queued"], to: "plotting", verb: "started" },
  hold: { from: ["plotting"], to: "paused", verb: "paused" },
  release: { from: ["paused"], to: "plotting", verb: "resumed" },
  finish: { from: ["plotting"], to: "done", verb: "finished" },
  fail: { from: ["plotting", "paused"], to: "failed", verb: "failed" },
  interrupt: { from: ["plotting", "paused"], to: "interrupted", verb: "interrupted" },
  recover: { from: ["interrupted", "cancelled"], to: "paused", verb: "continued" },
  cancel: { from: ["queued", "plotting", "paused", "interrupted"], to: "cancelled", verb: "cancelled" },
  requeue: { from: ["done", "failed", "cancelled", "interrupted"], to: "queued", verb: "queued again" },
};

/** A new queued job with a new id; plotter, name, settings and figures come from `from`. */
export function queuedJob(
  from: Pick<Job, "plotterId" | "name" | "settings" | "stats" | "warnings" | "submittedBy">,
  nowIso: string,
): Job {
  return {
    ...(from.submittedBy === undefined ? {} : { submittedBy: from.submittedBy }),
    id: crypto.randomUUID(),
    plotterId: from.plotterId,
    name: from.name,
    state: "queued",
    settings: from.settings,
    stats: from.stats,
    warnings: from.warnings,
    progress: 0,
    elapsedS: 0,
    remainingS: from.stats?.durationS ?? null,
    message: null,
    place: null,
    speedPct: 100,
    plottedS: null,
    expectedS: null,
    wait: null,
    stopped: false,
    createdAt: nowIso,
    startedAt: null,
    endedAt: null,
  };
}

/** A place as a job has it. */
export const jobPlace = ({ stroke, alongMm }: StrokePosition): JobPlace => ({ strokeIndex: stroke, alongMm });

/** Whether the job is being plotted, or held on the plotter. */
export const isOnPlotter = ({ state }: Job): boolean => state === "plotting" || state === "paused";

/**
 * The job after the event, at the given time (ISO 8601); throws `conflict` if the event is not allowed now.
 */
export function applyJobEvent(job: Job, event: JobEvent, nowIso: string): Job {
  const { from, to, verb } = TRANSITIONS[event.type];
  const isUndrawn = event.type === "recover" && job.state === "cancelled" && job.place === null;
  if (!from.includes(job.state) || isUndrawn) {
    throw new PlotwrightError("conflict", `"${job.name}" is ${job.state}, so it can't be ${verb} now.`);
  }
  const next: Job = { ...job, state: to, message: null, stopped: false };
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

/**
 * Errors of the board or its connection, after which a plot can resume where it stopped. Any other error
 * would occur again.
 */
const INTERRUPTIONS: readonly ErrorCode[] = [
  "no-board",
  "disconnected",
  "board-error",
  "board-timeout",
  "busy",
  "not-allowed",
];

export const canContinue = (error: Error): boolean =>
  error instanceof PlotwrightError && INTERRUPTIONS.includes(error.code);
