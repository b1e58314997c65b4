import fc from "fast-check";
import { describe, expect, it } from "vitest";
import { PlotwrightError, type ErrorCode } from "../../../src/index.js";
import { ERROR_TABLE } from "../../../src/internal.js";
import { ENDED_STATES, JOB_STATES, jobSchema, type Job, type JobState } from "../../../src/schema/index.js";
import {
  TRANSITIONS,
  applyJobEvent,
  canContinue,
  queuedJob,
  type JobEvent,
} from "../../../host/queue/job-states.js";
import { makeJob, STATS } from "../../support/jobs/jobs.js";

const NOW = "2026-05-01T12:00:00.000Z";
const PLACE = { strokeIndex: 2, alongMm: 3 };
const event: fc.Arbitrary<JobEvent> = fc.constantFrom<JobEvent>(
  { type: "start" },
  { type: "hold" },
  { type: "release" },
  { type: "finish" },
  { type: "fail", message: "The board went away." },
  { type: "interrupt", message: "The server stopped.", place: PLACE },
  { type: "recover" },
  { type: "cancel", place: null },
  { type: "cancel", place: { strokeIndex: 1, alongMm: 4 } },
  { type: "requeue" },
);

describe("a job", () => {
  it("is in a known state, with times that match it, after any events", () => {
    fc.assert(
      fc.property(fc.array(event, { maxLength: 30 }), (events) => {
        let job: Job = makeJob("a");
        for (const one of events) {
          const before = job;
          try {
            job = applyJobEvent(job, one, NOW);
          } catch (error) {
            expect(error).toBeInstanceOf(PlotwrightError);
            expect((error as PlotwrightError).code).toBe("conflict");
            expect(job).toBe(before);
          }
          expect(jobSchema.parse(job)).toEqual(job);
          expect(job.endedAt !== null).toBe(ENDED_STATES.includes(job.state));
          if (job.state === "queued") expect(job.startedAt).toBeNull();
          if (job.state === "plotting" || job.state === "paused") expect(job.startedAt).not.toBeNull();
          if (job.state === "done") expect(job.progress).toBe(1);
          if (job.state === "failed" || job.state === "interrupted") expect(job.message).not.toBeNull();
        }
      }),
    );
  });

  it("can be cancelled from every state that is not an end, and queued again from every end", () => {
    for (const state of JOB_STATES) {
      const isEnd = ENDED_STATES.includes(state);
      expect(TRANSITIONS.cancel.from.includes(state)).toBe(!isEnd);
      expect(TRANSITIONS.requeue.from.includes(state)).toBe(isEnd || state === "interrupted");
    }
  });

  it("explains why an event can't happen", () => {
    expect(() => applyJobEvent(makeJob("a", { name: "Fern" }), { type: "hold" }, NOW)).toThrow(
      `"Fern" is queued, so it can't be paused now.`,
    );
  });

  it("starts fresh when it is queued again", () => {
    const done = applyJobEvent(applyJobEvent(makeJob("a"), { type: "start" }, NOW), { type: "finish" }, NOW);
    const again = applyJobEvent({ ...done, elapsedS: 12, remainingS: 0 }, { type: "requeue" }, NOW);
    expect(again).toMatchObject({
      state: "queued",
      progress: 0,
      elapsedS: 0,
      startedAt: null,
      endedAt: null,
    });
    expect(again.settings).toBe(done.settings);
  });

  it.each<[JobEvent, Partial<Record<JobState, JobState>>]>([
    [{ type: "start" }, { queued: "plotting" }],
    [{ type: "hold" }, { plotting: "paused" }],
    [{ type: "release" }, { paused: "plotting" }],
    [{ type: "finish" }, { plotting: "done" }],
    [
      { type: "fail", message: "x" },
      { plotting: "failed", paused: "failed" },
    ],
    [
      { type: "interrupt", message: "x", place: PLACE },
      { plotting: "interrupted", paused: "interrupted" },
    ],
    [{ type: "recover" }, { interrupted: "paused", cancelled: "paused" }],
    [
      { type: "cancel", place: PLACE },
      { queued: "cancelled", plotting: "cancelled", paused: "cancelled", interrupted: "cancelled" },
    ],
    [{ type: "requeue" }, { done: "queued", failed: "queued", cancelled: "queued", interrupted: "queued" }],
  ])("goes from state to state by $type only where that is allowed", (event, after) => {
    for (const state of JOB_STATES) {
      const job = makeJob("a", { state, place: PLACE, startedAt: NOW });
      const next = (): JobState => applyJobEvent(job, event, NOW).state;
      if (after[state] === undefined) expect(next).toThrow("so it can't be");
      else expect([state, next()]).toEqual([state, after[state]]);
    }
  });

  it("is continued where it stopped, with the time that was left", () => {
    const stats = { ...STATS, durationS: 100 };
    const stopped = { stats, progress: 0.25, place: PLACE, startedAt: NOW, endedAt: NOW, remainingS: null };
    for (const state of ["interrupted", "cancelled"] as const) {
      const continued = (more: Partial<Job>): Job =>
        applyJobEvent(makeJob("a", { ...stopped, state, ...more }), { type: "recover" }, NOW);
      expect(continued({})).toMatchObject({ state: "paused", place: PLACE, remainingS: 75, endedAt: null });
      expect(continued({ remainingS: 7 }).remainingS).toBe(7);
      expect(continued({ stats: null }).remainingS).toBeNull();
    }
  });

  it("that was cancelled before it drew anything cannot be continued, but one that was interrupted can", () => {
    const recovered = (state: JobState): Job =>
      applyJobEvent(makeJob("a", { state, place: null, startedAt: NOW }), { type: "recover" }, NOW);
    expect(() => recovered("cancelled")).toThrow("is cancelled, so it can't be continued now");
    expect(recovered("interrupted")).toMatchObject({ state: "paused", place: null });
  });

  it("keeps the place where it was cancelled, if it had begun", () => {
    const cancelled = (startedAt: string | null): Job =>
      applyJobEvent(
        makeJob("a", { state: startedAt === null ? "queued" : "paused", startedAt }),
        { type: "cancel", place: PLACE },
        NOW,
      );
    expect(cancelled(NOW).place).toEqual(PLACE);
    expect(cancelled(null).place).toBeNull();
  });
});

describe("a new job", () => {
  it("has the time of its plan left, and the device that submitted it", () => {
    const stats = { ...STATS, durationS: 100 };
    const submittedBy = { id: "s", name: "Anna" };
    expect(queuedJob({ ...makeJob("a"), stats, submittedBy }, NOW)).toMatchObject({
      remainingS: 100,
      submittedBy,
    });
    const plain = queuedJob({ ...makeJob("a"), stats: null }, NOW);
    expect(plain.remainingS).toBeNull();
    expect("submittedBy" in plain).toBe(false);
  });
});

it("a plot continues after faults of the board and its connection only", () => {
  const codes = Object.keys(ERROR_TABLE) as ErrorCode[];
  const isContinued = (code: ErrorCode): boolean => canContinue(new PlotwrightError(code, "x"));
  expect(codes.filter(isContinued).sort()).toEqual(
    ["board-error", "board-timeout", "busy", "disconnected", "no-board", "not-allowed"].sort(),
  );
  expect(canContinue(new Error("x"))).toBe(false);
});
