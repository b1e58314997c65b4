import { describe, expect, it } from "vitest";
import { queueTime } from "../../../web/queue/queue-time.js";
import { makeJob } from "../../support/jobs/jobs-on-page.js";

const waiting = makeJob("next", { expectedS: 3_600 });
const withActive = (state: "plotting" | "paused" | "interrupted") =>
  makeJob("active", { state, expectedS: 900, remainingS: 600 });

describe("the time of a queue", () => {
  it("is the rest of the running plot plus all that wait", () => {
    expect(queueTime([withActive("plotting"), waiting], true)).toEqual({ totalS: 4_200, isRunning: true });
  });

  it.each(["paused", "interrupted"] as const)("has no known end while a plot is %s", (state) => {
    expect(queueTime([withActive(state), waiting], true).isRunning).toBe(false);
    expect(queueTime([withActive(state)], false).isRunning).toBe(false);
  });

  it("has no end before it is started", () => {
    expect(queueTime([waiting], true).isRunning).toBe(false);
  });

  it("has no end if it stops for paper between two plots", () => {
    expect(queueTime([withActive("plotting"), waiting], false).isRunning).toBe(false);
    expect(queueTime([withActive("plotting")], false).isRunning).toBe(true);
  });
});
