/** The order and number of the events that a browser's host sends. */
import { afterEach, beforeEach, describe, expect, it, vi } from "vitest";
import type { ServerEvent } from "../../../../src/schema/index.js";
import { announcer } from "../../../../web/backend/browser/host.js";
import { makeJob } from "../../../support/jobs/jobs-on-page.js";

const progress = (planS: number, plotterId = "a"): ServerEvent => ({
  type: "progress",
  jobId: "job",
  plotterId,
  progress: 0.5,
  elapsedS: 1,
  remainingS: 1,
  planS,
  xMm: 0,
  yMm: 0,
  penUp: true,
  penMoving: false,
  atMs: 0,
  heldBackMs: 0,
  ahead: [],
});
const job: ServerEvent = { type: "job", job: makeJob("job") };
const order: ServerEvent = { type: "order", ids: [] };

let sent: ServerEvent[];
let written: Promise<void>;
let announce: (event: ServerEvent) => void;

beforeEach(() => {
  vi.useFakeTimers();
  sent = [];
  written = Promise.resolve();
  announce = announcer({ written: () => written }, (event) => sent.push(event));
});
afterEach(() => void vi.useRealTimers());

describe("the host's events", () => {
  it("contain the newest progress of each plotter, ten times a second", async () => {
    for (const event of [progress(1), progress(1, "b"), progress(2)]) announce(event);
    await vi.advanceTimersByTimeAsync(100);
    const held = { heldBackMs: 100 };
    expect(sent).toEqual([
      { ...progress(2), ...held },
      { ...progress(1, "b"), ...held },
    ]);
    announce(progress(3));
    await vi.advanceTimersByTimeAsync(100);
    expect(sent.slice(2)).toEqual([{ ...progress(3), ...held }]);
    await vi.advanceTimersByTimeAsync(1_000);
    expect(sent).toHaveLength(3);
  });

  it("never have progress after a later change of the job", async () => {
    announce(progress(1));
    announce(progress(2));
    announce(job);
    await vi.advanceTimersByTimeAsync(1_000);
    expect(sent).toEqual([progress(2), job]);
  });

  it("wait until the changes before them are stored, or can't be", async () => {
    let store = (): void => undefined;
    written = new Promise((resolve) => (store = resolve));
    announce(job);
    written = Promise.reject(new Error("full"));
    announce(order);
    await vi.advanceTimersByTimeAsync(1_000);
    expect(sent).toEqual([]);
    store();
    await vi.advanceTimersByTimeAsync(0);
    expect(sent).toEqual([job, order]);
  });
});
