/** Jobs that were interrupted or cancelled, also by a restart, and where they go on. */
import { afterEach, beforeEach, describe, expect, it } from "vitest";
import { SERVER_STOPPED } from "../../../host/queue/job-words.js";
import { PlotwrightError } from "../../../src/index.js";
import { DEFAULT_PLOT_SETTINGS } from "../../../src/schema/index.js";
import { folderOfTest } from "../../support/processes/folders.js";
import { openQueueIn, settled, type OpenQueue } from "../../support/jobs/open-queue.js";

let dir: string;
let opened: OpenQueue;
beforeEach(() => {
  dir = folderOfTest();
  openQueue();
});
afterEach(() => opened.close());

let { store, plotter, logged, queue, add, nextRun, plotting } = {} as OpenQueue;
function openQueue(options?: Parameters<typeof openQueueIn>[1]): void {
  opened = openQueueIn(dir, options);
  ({ store, plotter, logged, queue, add, nextRun, plotting } = opened);
}

const names = (): string[] => queue.list().map((job) => `${job.name} ${job.state}`);

describe("the queue, after a plot that did not end", () => {
  it("marks the running plot as interrupted after a restart, and keeps the others' order", async () => {
    const jobs = [await add("fern"), await add("moss"), await add("ivy")];
    queue.move(jobs[2].id, jobs[1].id);
    await queue.start(jobs[0].id);
    await plotter.nextRun();
    store.close();
    openQueue();
    expect(names()).toEqual(["fern interrupted", "ivy queued", "moss queued"]);
    expect(queue.get(jobs[0].id).message).toBe(SERVER_STOPPED);
  });

  it("resumes an interrupted job at the journal's place, held, and the place can be moved", async () => {
    const { id, run: broken } = await plotting();
    broken.record({ place: { stroke: 3, alongMm: 4.5 } });
    broken.record({ place: { stroke: 7, alongMm: 1.25 } });
    broken.fail(new PlotwrightError("disconnected", "The board was unplugged."));
    await settled();
    expect(queue.get(id)).toMatchObject({
      state: "interrupted",
      message: "The board was unplugged.",
      place: { strokeIndex: 7, alongMm: 1.25 },
    });
    expect(queue.plots.recover(id).state).toBe("paused");
    const run = await nextRun();
    expect(run.asked).toEqual(["begin held"]);
    expect(queue.get(id)).toMatchObject({ state: "paused", place: { strokeIndex: 7, alongMm: 1.25 } });
    expect(queue.plots.movePlace(id, { strokes: -2, mm: 3 }).place).toEqual({
      strokeIndex: 5,
      alongMm: 4.25,
    });
    await queue.plots.checkPlace(id);
    queue.plots.resume(id);
    expect(queue.get(id)).toMatchObject({ state: "plotting", place: null });
    run.end({ kind: "done" });
    await settled();
    expect(queue.get(id).state).toBe("done");
  });

  it("says what is to be brought back by hand if the board knows neither position nor height", async () => {
    const { id, run } = await plotting();
    run.record({ place: { stroke: 3, alongMm: 4.5 } });
    run.fail(new PlotwrightError("disconnected", "The board was unplugged."));
    await settled();
    Object.assign(plotter, { xMm: null, heightUnsure: true });
    expect(queue.plots.recover(id).message).toMatch(
      /lost its position: push the carriage to home.* does not know how high its pen is: .*turn its Z axis by hand/,
    );
  });

  it("moves the pen of a job only while it waits for another one", async () => {
    const { id, run } = await plotting();
    await expect(queue.plots.movePen(id, false)).rejects.toThrow("does not wait for another pen");
    run.held(true);
    await expect(queue.plots.movePen(id, false)).rejects.toThrow("does not wait for another pen");
    run.held(false);
    run.held(true, { kind: "pen", layerName: "Ink", penName: "Black", color: null });
    expect(await queue.plots.movePen(id, false)).toMatchObject({ id, state: "paused" });
    await queue.plots.movePen(id, true);
    expect(run.asked).toEqual(["pen down", "pen up"]);
    run.end({ kind: "cancelled" });
    await settled();
    await expect(queue.plots.movePen(id, false)).rejects.toThrow(/so it can't be given another pen now/);
  });

  it("starts at the requested place, paused there until it is resumed", async () => {
    const from = { strokeIndex: 1, alongMm: 0 };
    const { id, place } = await add("fern", { from });
    expect(place).toEqual(from);
    expect(queue.duplicate(id).place).toBe(null);
    await queue.start(id);
    const run = await nextRun();
    expect([run.asked, run.holdPlace]).toEqual([["begin held"], { stroke: 1, alongMm: 0 }]);
    expect(queue.get(id)).toMatchObject({ state: "paused", place: from });
    queue.plots.resume(id);
    expect(queue.get(id)).toMatchObject({ state: "plotting", place: null });
    run.end({ kind: "done" });
    await settled();
    expect(queue.requeue(id).place).toBe(null);
  });

  it("keeps the layout in which its first stroke was chosen, and begins with that stroke", async () => {
    const { id } = await add("fern", { from: { strokeIndex: 1, alongMm: 0 } });
    const { prepare, pen } = DEFAULT_PLOT_SETTINGS;
    const moved = { ...DEFAULT_PLOT_SETTINGS, prepare: { ...prepare, marginMm: 40 } };
    await expect(queue.patch(id, { settings: moved })).rejects.toThrow("starts at stroke 2");
    const lower = { ...DEFAULT_PLOT_SETTINGS, pen: { ...pen, downPct: 20 } };
    expect((await queue.patch(id, { settings: lower })).place).toEqual({ strokeIndex: 1, alongMm: 0 });
    const beyond = add("moss", { from: { strokeIndex: 1e6, alongMm: 0 } });
    await expect(beyond).rejects.toThrow("strokes, so it can't start at number");
  });

  it("recovers a cancelled job where it was cancelled, paused", async () => {
    const { id, run: first } = await plotting();
    first.record({ place: { stroke: 7, alongMm: 1.25 } });
    queue.plots.cancel(id);
    first.end({ kind: "cancelled" });
    await settled();
    const cancelled = queue.get(id);
    expect(cancelled).toMatchObject({ state: "cancelled", place: { strokeIndex: 7, alongMm: 1.25 } });
    expect(cancelled.endedAt).not.toBeNull();
    expect(queue.plots.recover(id)).toMatchObject({ state: "paused", endedAt: null });
    const run = await nextRun();
    expect(run.asked).toEqual(["begin held"]);
    expect(queue.get(id)).toMatchObject({ state: "paused", place: { strokeIndex: 7, alongMm: 1.25 } });
  });

  it("can't recover a cancelled job that was never begun", async () => {
    const { id } = await add("fern");
    queue.plots.cancel(id);
    expect(() => queue.plots.recover(id)).toThrow("it can't be continued now");
  });

  it("continues when it is resumed before the plotter has recovered it", async () => {
    const { id, run: broken } = await plotting();
    broken.record({ place: { stroke: 7, alongMm: 1.25 } });
    broken.fail(new PlotwrightError("disconnected", "The board was unplugged."));
    await settled();
    queue.plots.recover(id);
    expect(queue.plots.resume(id).state).toBe("paused");
    const run = await nextRun();
    expect(run.asked).toEqual(["resume"]);
    expect(queue.get(id)).toMatchObject({ state: "plotting", place: null });
  });

  it("offers to continue a plot whose board failed before anything was drawn, paused at its beginning", async () => {
    const { id, run: broken } = await plotting();
    broken.fail(new PlotwrightError("board-timeout", "The board has stopped answering."));
    await settled();
    expect(queue.get(id)).toMatchObject({
      state: "interrupted",
      message: "The board has stopped answering.",
    });
    queue.plots.recover(id);
    const run = await nextRun();
    expect(run.asked).toEqual(["begin held"]);
    expect(run.holdPlace).toEqual({ stroke: 0, alongMm: 0 });
    expect(queue.get(id).state).toBe("paused");
  });

  it("offers to continue a plot that has begun to draw, however it ended", async () => {
    const { id, run: broken } = await plotting();
    broken.record({ place: { stroke: 3, alongMm: 4.5 } });
    broken.fail(new Error("A programming error."));
    await settled();
    expect(queue.get(id)).toMatchObject({ state: "interrupted", place: { strokeIndex: 3, alongMm: 4.5 } });
  });

  it("begins at the beginning when it is plotted again, if it is interrupted before it draws", async () => {
    const { id, run } = await plotting();
    run.record({ place: { stroke: 12, alongMm: 8 } });
    store.close();
    openQueue();
    queue.requeue(id);
    await queue.start(id);
    await plotter.nextRun();
    store.close();
    openQueue();
    expect(queue.get(id)).toMatchObject({ state: "interrupted", place: null });
  });

  it("continues plotting with a full disk, and reports once that it can't write", async () => {
    const { id, run } = await plotting();
    const { saveJournal } = store;
    store.saveJournal = () => {
      throw new Error("database or disk is full");
    };
    run.record({});
    run.record({});
    store.saveJournal = saveJournal;
    run.record({ place: { stroke: 2, alongMm: 1 } });
    expect(logged).toEqual(["the state of a plot can't be stored: database or disk is full"]);
    run.end({ kind: "done" });
    await settled();
    expect(queue.get(id).state).toBe("done");
  });

  it("knows after a kill how far a job had come, and nothing moves until the user asks", async () => {
    const { id, run } = await plotting();
    run.record({ place: { stroke: 12, alongMm: 8 } });
    store.close();
    openQueue();
    await settled();
    expect(queue.get(id)).toMatchObject({ state: "interrupted", place: { strokeIndex: 12, alongMm: 8 } });
    expect(plotter.runs).toEqual([]);
    queue.requeue(id);
    expect(queue.get(id)).toMatchObject({ state: "queued", place: null });
  });
});
