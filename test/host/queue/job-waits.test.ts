/** Stops that a plot makes by itself, and the expected duration of plots. */
import { afterEach, beforeEach, describe, expect, it } from "vitest";
import { timeRatio } from "../../../host/queue/expected-time.js";
import { PlotwrightError } from "../../../src/errors.js";
import type { Job, PlotWait } from "../../../src/schema/index.js";
import { folderOfTest } from "../../support/processes/folders.js";
import { STATS, makeJob } from "../../support/jobs/jobs.js";
import { openQueueIn, settled, type OpenQueue } from "../../support/jobs/open-queue.js";

const BLUE: PlotWait = { kind: "pen", layerName: "2 sky", penName: "Blue 0.3", color: "#00f" };

let dir: string;
let nowMs: number;
let opened: OpenQueue;
beforeEach(() => {
  dir = folderOfTest();
  nowMs = Date.UTC(2026, 0, 1);
  openQueue();
});
afterEach(() => opened.close());

let { store, queue, add, nextRun, plotting } = {} as OpenQueue;
function openQueue(): void {
  opened = openQueueIn(dir, { nowIso: () => new Date(nowMs).toISOString() });
  ({ store, queue, add, nextRun, plotting } = opened);
}
/** As after a kill: nothing is closed properly. */
function crash(): void {
  store.close();
  openQueue();
}

async function plot(id: string, tookS: number): Promise<void> {
  await queue.start(id);
  const run = await nextRun();
  nowMs += tookS * 1000;
  run.end({ kind: "done" });
  await settled();
}

describe("a stop for a pen", () => {
  it("stores the waiting job with its pen, on disk too, until the user resumes it", async () => {
    const { id, run } = await plotting();
    run.holdPlace = { stroke: 2, alongMm: 0 };
    run.held(true, BLUE);
    const held = { state: "paused", wait: BLUE, message: 'Put in "Blue 0.3" for "2 sky".' };
    expect(queue.get(id)).toMatchObject(held);
    expect(store.jobs()[0]).toMatchObject(held);
    queue.plots.resume(id);
    expect(queue.get(id)).toMatchObject({ state: "plotting", wait: null, message: "Resuming." });
    queue.plots.pause(id);
    expect(queue.get(id)).toMatchObject({ state: "paused", wait: null });
  });

  it("tells the user that another board is connected than the one that began the plot", async () => {
    const { id, run } = await plotting();
    const board = { boardName: "left", boardSerialNumber: null, firmware: "2.8.1" };
    run.record({ place: { stroke: 2, alongMm: 0 }, board });
    crash();
    queue.plots.recover(id);
    expect(queue.get(id).message).toMatch(
      /^This is not the board that began the plot.*push the carriage to home/,
    );
  });

  it("is asked for again after a crash, but not after it was answered", async () => {
    const { id, run } = await plotting();
    run.record({ place: { stroke: 2, alongMm: 0 } });
    run.held(true, BLUE);
    crash();
    expect(queue.get(id)).toMatchObject({ state: "interrupted", wait: BLUE });
    queue.plots.recover(id);
    const again = await nextRun();
    expect(queue.get(id)).toMatchObject({
      state: "paused",
      wait: BLUE,
      message: expect.stringMatching(/^Put in "Blue 0.3" for "2 sky"\. The board still knows its position/),
    });
    queue.plots.resume(id);
    expect(again.asked).toEqual(["begin held", "resume"]);
    expect(queue.get(id)).toMatchObject({ state: "plotting", wait: null });
    again.record({ place: { stroke: 2, alongMm: 4 } });
    crash();
    expect(queue.get(id)).toMatchObject({ state: "interrupted", wait: null });
  });

  it("is due again after the plot was cancelled there and recovered, any number of times", async () => {
    const { id, run: first } = await plotting();
    const place = { stroke: 7, alongMm: 0 };
    first.holdPlace = place;
    first.held(true, BLUE);
    first.record({ place });
    for (let run = first; ; run = await nextRun()) {
      queue.plots.cancel(id);
      // A plotter releases a held plot to send it home.
      run.held(false);
      await settled();
      const kept = { wait: BLUE, place: { strokeIndex: 7, alongMm: 0 } };
      expect(queue.get(id)).toMatchObject({ state: "cancelled", ...kept });
      if (run !== first) break;
      expect(queue.plots.recover(id)).toMatchObject({ state: "paused", ...kept });
    }
    expect(queue.requeue(id)).toMatchObject({ state: "queued", wait: null, place: null });
  });

  it("is over when the job is done", async () => {
    const { id, run } = await plotting();
    run.held(true, BLUE);
    run.end({ kind: "done" });
    await settled();
    expect(queue.get(id)).toMatchObject({ state: "done", wait: null });
  });

  it("is not counted in the time that the plot took", async () => {
    const { id, run } = await plotting();
    nowMs += 5_000;
    run.held(true, BLUE);
    nowMs += 3_600_000;
    run.held(false);
    nowMs += 7_000;
    run.end({ kind: "done" });
    await settled();
    expect(queue.get(id).plottedS).toBe(12);
  });
});

describe("a plot in two parts", () => {
  it("took the time of both: one that was cancelled, and one that was interrupted, before it went on", async () => {
    for (const end of [
      { kind: "cancelled" } as const,
      null, // The board's cable is pulled.
    ]) {
      const { id, run } = await plotting();
      nowMs += 5_000;
      run.record({ place: { stroke: 2, alongMm: 1 } });
      if (end) queue.plots.cancel(id);
      else run.fail(new PlotwrightError("disconnected", "gone"));
      await settled();
      expect(queue.get(id).plottedS).toBe(5);
      nowMs += 3_600_000;
      queue.plots.recover(id);
      const rest = await nextRun();
      nowMs += 60_000;
      queue.plots.resume(id);
      await settled();
      nowMs += 7_000;
      rest.end({ kind: "done" });
      await settled();
      expect(queue.get(id)).toMatchObject({ state: "done", plottedS: 12 });
    }
  });

  it("begins at zero when it is plotted again", async () => {
    const { id, run } = await plotting();
    nowMs += 5_000;
    run.record({ place: { stroke: 2, alongMm: 1 } });
    queue.plots.cancel(id);
    await settled();
    expect(queue.requeue(id).plottedS).toBeNull();
  });
});

describe("the progress of a plot", () => {
  const part = { progress: 0.25, elapsedS: 3, remainingS: 9 };

  it("equals that at its place, after a kill too, and stays when the job is resumed", async () => {
    const { id, run } = await plotting();
    run.progress({ ...part, planS: 3, xMm: 0, yMm: 0, penUp: false, penMoving: false });
    run.record({ place: { stroke: 1, alongMm: 7 }, elapsedS: 3 });
    crash();
    expect(queue.get(id)).toMatchObject({
      ...part,
      state: "interrupted",
      place: { strokeIndex: 1, alongMm: 7 },
    });
    expect(store.jobs()[0]).toMatchObject(part);
    queue.plots.recover(id);
    await nextRun();
    crash();
    expect(queue.get(id)).toMatchObject({
      ...part,
      state: "interrupted",
      place: { strokeIndex: 1, alongMm: 7 },
    });
  });

  it("stays unchanged if the journal of an older version does not have it", async () => {
    const { id } = await plotting();
    store.saveJournal(id, { place: { stroke: 1, alongMm: 7 } });
    crash();
    expect(queue.get(id)).toMatchObject({ state: "interrupted", progress: 0, remainingS: STATS.durationS });
  });
});

describe("the expected time", () => {
  it("is the plan's at first, then follows the real times of the plotter's plots; that of ended jobs stays", async () => {
    const [first, second] = [await add("a"), await add("b")];
    expect(first.expectedS).toBe(STATS.durationS);
    await plot(first.id, STATS.durationS * 1.25);
    expect(queue.get(second.id).expectedS).toBeCloseTo(STATS.durationS * 1.25, 6);
    expect((await add("c")).expectedS).toBeCloseTo(STATS.durationS * 1.25, 6);
    expect(queue.get(first.id)).toMatchObject({
      expectedS: STATS.durationS,
      plottedS: STATS.durationS * 1.25,
    });
    crash();
    expect(queue.get(second.id).expectedS).toBeCloseTo(STATS.durationS * 1.25, 6);
  });

  it("uses the median of the plotter's own finished plots, and excludes plots of another kind", () => {
    const done = (took: number, more: Partial<Job> = {}): Job =>
      makeJob(String(took), { state: "done", plottedS: STATS.durationS * took, ...more });
    expect(timeRatio([], "virtual")).toBe(1);
    expect(timeRatio([done(1.1), done(1.9), done(1.2)], "virtual")).toBeCloseTo(1.2, 9);
    expect(timeRatio([done(1.1), done(1.2)], "virtual")).toBeCloseTo(1.15, 9);
    const others = [
      done(1.5, { plotterId: "other" }),
      done(1.5, { state: "cancelled" }),
      done(1.5, { speedPct: 150 }),
      done(1.5, { stats: null }),
      done(0.05),
      done(30),
    ];
    expect(timeRatio([...others, done(1.1)], "virtual")).toBeCloseTo(1.1, 9);
    const newest = Array.from({ length: 20 }, () => done(1.3));
    expect(timeRatio([...newest, ...Array.from({ length: 50 }, () => done(0.9))], "virtual")).toBeCloseTo(
      1.3,
      9,
    );
  });
});
