import fc from "fast-check";
import { describe, expect, it } from "vitest";
import { PlotwrightError } from "../../../src/index.js";
import { ENDED_STATES, JOB_STATES, jobSchema, type Job } from "../../../src/schema/index.js";
import { TRANSITIONS, applyJobEvent, type JobEvent } from "../../../host/queue/job-states.js";
import { makeJob } from "../../support/jobs/jobs.js";

const NOW = "2026-05-01T12:00:00.000Z";
const event: fc.Arbitrary<JobEvent> = fc.constantFrom<JobEvent>(
  { type: "start" },
  { type: "hold" },
  { type: "release" },
  { type: "finish" },
  { type: "fail", message: "The board went away." },
  { type: "interrupt", message: "The server stopped.", place: { strokeIndex: 2, alongMm: 3 } },
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
});
