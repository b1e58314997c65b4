import { afterEach, beforeEach, describe, expect, it } from "vitest";
import { PlotwrightError } from "../../../src/index.js";
import { DEFAULT_PLOT_SETTINGS } from "../../../src/schema/index.js";
import { folderOfTest } from "../../support/processes/folders.js";
import { LED_PLANNING, LedPlotter } from "../../support/jobs/led-plotter.js";
import { openQueueIn, settled, type OpenQueue } from "../../support/jobs/open-queue.js";

let dir: string;
let opened: OpenQueue;
beforeEach(() => {
  dir = folderOfTest();
  openQueue();
});
afterEach(() => opened.close());

let { store, plotter, events, queue, add, nextRun, plotting } = {} as OpenQueue;
function openQueue(options?: Parameters<typeof openQueueIn>[1]): void {
  opened = openQueueIn(dir, options);
  ({ store, plotter, events, queue, add, nextRun, plotting } = opened);
}

const names = (): string[] => queue.list().map((job) => `${job.name} ${job.state}`);

describe("the queue", () => {
  it.each([
    ["done", null],
    ["cancelled", null],
    ["interrupted", new PlotwrightError("disconnected", "The cable came off.")],
    ["failed", new PlotwrightError("bad-file", "Nothing to draw.")],
  ] as const)("keeps what may be seen on the paper with a job that is %s", async (state, error) => {
    const { id, run } = await plotting();
    run.start.noted?.("The pen rested at A.");
    expect(queue.get(id).message).toBe("The pen rested at A.");
    queue.plots.pause(id);
    queue.plots.resume(id);
    run.start.noted?.("The pen rested at B.");
    if (error !== null) run.fail(error);
    else run.end({ kind: state });
    await settled();
    const reason = error === null ? "" : `${error.message} `;
    expect(queue.get(id)).toMatchObject({
      state,
      message: `${reason}The pen rested at A. The pen rested at B.`,
    });
    expect(events.at(-2)).toMatchObject({ job: { message: queue.get(id).message } });
  });

  it("plots a job through progress and hold to its end, announcing each step", async () => {
    const { id, run } = await plotting();
    run.progress({
      progress: 0.5,
      elapsedS: 6,
      remainingS: 6,
      planS: 6,
      xMm: 1,
      yMm: 2,
      penUp: false,
      penMoving: false,
    });
    expect(queue.get(id)).toMatchObject({ state: "plotting", progress: 0.5, remainingS: 6 });
    queue.plots.pause(id);
    expect(queue.get(id).state).toBe("paused");
    queue.plots.resume(id);
    expect(queue.get(id).state).toBe("plotting");
    run.end({ kind: "done" });
    await settled();
    expect(queue.get(id)).toMatchObject({ state: "done", progress: 1, remainingS: 0 });
    expect(run.asked).toEqual(["pause", "resume"]);
    const states = events.flatMap((event) => (event.type === "job" ? [event.job.state] : []));
    expect(new Set(states)).toEqual(new Set(["queued", "plotting", "paused", "done"]));
    expect(events).toContainEqual(
      expect.objectContaining({ type: "progress", jobId: id, xMm: 1, yMm: 2, penUp: false }),
    );
  });

  it("reports the failure, keeps the rest of the queue, and can plot again", async () => {
    const first = await add("fern");
    await add("moss");
    await queue.start(first.id);
    const run = await nextRun();
    run.fail(new PlotwrightError("out-of-bounds", "It is larger than the machine."));
    await settled();
    expect(names()).toEqual(["moss queued", "fern failed"]);
    expect(queue.get(first.id).message).toBe("It is larger than the machine.");
    queue.requeue(first.id);
    expect(names()).toEqual(["moss queued", "fern queued"]);
    await queue.start(first.id);
    (await plotter.nextRun()).end({ kind: "done" });
    await settled();
    expect(names()).toEqual(["moss queued", "fern done"]);
  });

  it("refuses a second job while one is on the plotter", async () => {
    const first = await add("fern");
    const second = await add("moss");
    await queue.start(first.id);
    await expect(queue.start(second.id)).rejects.toThrow(/"fern" is being plotted/);
    expect(queue.get(second.id).state).toBe("queued");
  });

  it("releases its claim on a shared job if the board disappears before it begins", async () => {
    const asked: string[] = [];
    await opened.close();
    openQueue({
      claims: {
        claim: (id) => {
          asked.push(`claim ${id}`);
          plotter.connection = "absent";
          return Promise.resolve(null);
        },
        release: (id) => Promise.resolve(void asked.push(`release ${id}`)),
      },
    });
    const { id } = await add("fern");
    await expect(queue.start(id)).rejects.toThrow(expect.objectContaining({ code: "no-board" }));
    expect(asked).toEqual([`claim ${id}`, `release ${id}`]);
    // Without a board, no claim is made.
    await expect(queue.start(id)).rejects.toThrow(expect.objectContaining({ code: "no-board" }));
    expect(asked.length).toBe(2);
    expect(names()).toEqual(["fern queued"]);
  });

  it("refuses to start without a board, and the job stays queued", async () => {
    const { id } = await add("fern");
    plotter.connection = "absent";
    await expect(queue.start(id)).rejects.toThrow(expect.objectContaining({ code: "no-board" }));
    expect(queue.get(id).state).toBe("queued");
  });

  it("cancels a job that is still being planned", async () => {
    await opened.close();
    openQueue({
      planning: {
        ...LED_PLANNING,
        open: (_drawing, _settings, signal) =>
          new Promise((_resolve, reject) => {
            signal.addEventListener("abort", () => reject(new PlotwrightError("cancelled", "stop")));
          }),
      },
    });
    const { id } = await add("fern");
    await queue.start(id);
    queue.plots.cancel(id);
    await settled();
    expect(queue.get(id).state).toBe("cancelled");
    expect(plotter.runs).toEqual([]);
  });

  it("does not add a job whose drawing can't be planned", async () => {
    await opened.close();
    const measure = () => Promise.reject(new PlotwrightError("bad-file", "This is not an SVG."));
    openQueue({ planning: { ...LED_PLANNING, measure } });
    await expect(add("fern")).rejects.toThrow("This is not an SVG.");
    expect(queue.list()).toEqual([]);
    expect(events).toEqual([]);
  });

  it("stores heights and speeds that were changed while plotting", async () => {
    const { id } = await plotting();
    const pen = { ...DEFAULT_PLOT_SETTINGS.pen, downPct: 21 };
    await queue.change(id, { pen, speedPct: 60 });
    expect(store.jobs()[0]).toMatchObject({ speedPct: 60, settings: { pen } });
    await queue.plots.emergencyStop(id);
    expect(queue.get(id).state).toBe("paused");
  });

  it("gives the run what was changed while it was still being planned", async () => {
    await opened.close();
    let finishPlan = (): void => undefined;
    const gate = new Promise<void>((resolve) => {
      finishPlan = resolve;
    });
    const open: typeof LED_PLANNING.open = async (...args) => {
      await gate;
      return LED_PLANNING.open(...args);
    };
    openQueue({ planning: { ...LED_PLANNING, open } });
    const { id } = await add("fern");
    await queue.start(id);
    const pen = { ...DEFAULT_PLOT_SETTINGS.pen, downPct: 21 };
    await queue.change(id, { speedPct: 60 });
    await queue.change(id, { pen });
    expect(store.jobs()[0]).toMatchObject({ speedPct: 60, settings: { pen } });
    finishPlan();
    const run = await nextRun();
    await settled();
    expect(run.changes).toEqual([{ pen, motion: DEFAULT_PLOT_SETTINGS.motion, speedPct: 60 }]);
  });

  it("asks a run for no change if nothing was changed", async () => {
    const { run } = await plotting();
    await settled();
    expect(run.changes).toEqual([]);
  });

  it("tells an emergency stop from a pause until it is resumed, and whether the position holds", async () => {
    const { id } = await plotting();
    await queue.plots.emergencyStop(id);
    expect(queue.get(id)).toMatchObject({ state: "paused", stopped: true });
    expect(queue.get(id).message).toMatch(/^Stopped at once.* still knows its position/);
    queue.plots.resume(id);
    await settled();
    expect(queue.get(id)).toMatchObject({ state: "plotting", stopped: false });
    queue.plots.pause(id);
    await settled();
    expect(queue.get(id)).toMatchObject({ state: "paused", stopped: false });
    plotter.xMm = null;
    await queue.plots.emergencyStop(id);
    expect(queue.get(id)).toMatchObject({ state: "paused", stopped: true });
    expect(queue.get(id).message).toMatch(/^Stopped at once.* does not know where/);
  });

  it("holds a plot that is stopped while it is still being planned", async () => {
    const { id } = await add("fern");
    await queue.start(id);
    await queue.plots.emergencyStop(id);
    await nextRun();
    expect(queue.get(id).state).toBe("paused");
  });

  it("makes copies that share the drawing, right after the original", async () => {
    const fern = await add("fern");
    await add("moss");
    const copy = queue.duplicate(fern.id);
    expect(names()).toEqual(["fern queued", "fern queued", "moss queued"]);
    expect(queue.list()[1]?.id).toBe(copy.id);
    expect(queue.drawingOf(copy.id)).toBe(queue.drawingOf(fern.id));
    queue.plots.cancel(fern.id);
    queue.duplicate(fern.id);
    expect(names()).toEqual(["fern queued", "moss queued", "fern queued", "fern cancelled"]);
    await queue.remove(fern.id);
    expect(store.isUsed(queue.drawingOf(copy.id))).toBe(true);
  });

  it("adds a job for each sheet of a drawing that is spread over several, in order, all or none", async () => {
    const { prepare } = DEFAULT_PLOT_SETTINGS;
    const spread = { ...DEFAULT_PLOT_SETTINGS, prepare: { ...prepare, tileColumns: 2, tileRows: 2 } };
    const first = await add("map", { settings: spread, copies: 2 });
    const sheets = [1, 2, 3, 4].map((tile) => `map (sheet ${tile} of 4) queued`);
    expect(names()).toEqual([...sheets, ...sheets]);
    expect(queue.list()[0]?.id).toBe(first.id);
    expect(queue.list().map(({ settings }) => settings.prepare.tile)).toEqual([1, 2, 3, 4, 1, 2, 3, 4]);
    // The one that is wanted again.
    await add("map", { settings: { ...spread, prepare: { ...spread.prepare, tile: 3 } } });
    expect(names().at(-1)).toBe("map queued");
    const begun = add("map", { settings: spread, from: { strokeIndex: 0, alongMm: 0 } });
    await expect(begun).rejects.toThrow(/4 sheets.*Choose one/);
    expect(queue.list()).toHaveLength(9);
  });

  it("waits between jobs for the paper, or continues automatically if configured", async () => {
    const [a, b] = [await add("fern"), await add("moss")];
    await queue.start(a.id);
    (await plotter.nextRun()).end({ kind: "done" });
    await settled();
    expect(queue.get(b.id).state).toBe("queued");
    queue.saveSettings({ runOn: true });
    await add("ivy");
    await queue.start(b.id);
    (await plotter.nextRun()).end({ kind: "done" });
    await settled();
    expect(names().slice(0, 1)).toEqual(["ivy plotting"]);
    (await plotter.nextRun()).fail(new PlotwrightError("board-error", "Motor power is off."));
    await settled();
    store.close();
    openQueue();
    expect(queue.settings()).toEqual({ runOn: true });
  });

  it("waits for paper between sheets of a drawing that has several, even if it continues automatically", async () => {
    const { prepare } = DEFAULT_PLOT_SETTINGS;
    const spread = { ...DEFAULT_PLOT_SETTINGS, prepare: { ...prepare, tileColumns: 2, tileRows: 1 } };
    queue.saveSettings({ runOn: true });
    const moss = await add("moss");
    const first = await add("map", { settings: spread });
    await add("ivy");
    await add("tide", { settings: { ...spread, prepare: { ...spread.prepare, tile: 2 } } });
    await queue.start(moss.id);
    // A drawing before the sheets may share their paper, as the user has chosen.
    (await nextRun()).end({ kind: "done" });
    await settled();
    expect(queue.get(first.id).state).toBe("plotting");
    (await nextRun()).end({ kind: "done" });
    await settled();
    const [second] = queue.list();
    expect([second.name, second.state]).toEqual(["map (sheet 2 of 2)", "queued"]);
    expect(second.message).toBe("This is another sheet of a drawing: put in new paper, then start it.");
    expect(queue.startsByItself(second)).toBe(false);
    await queue.start(second.id);
    expect(queue.get(second.id)).toMatchObject({ state: "plotting", message: null });
    (await nextRun()).end({ kind: "done" });
    await settled();
    expect(names().slice(0, 2)).toEqual(["ivy plotting", "tide queued"]);
    expect(queue.startsByItself(queue.list()[1])).toBe(false);
    (await nextRun()).end({ kind: "done" });
    await settled();
    expect(names()[0]).toBe("tide plotting");
  });

  it("continues with the next waiting job of the same plotter, and with that one only", async () => {
    store.close();
    openQueue({ otherPlotter: new LedPlotter("other", "Other plotter") });
    queue.saveSettings({ runOn: true });
    const { run } = await plotting();
    const onOther = await add("moss", { plotterId: "other" });
    const cancelled = await add("lichen");
    queue.plots.cancel(cancelled.id);
    const [next, last] = [await add("ivy"), await add("sedge")];
    run.end({ kind: "done" });
    await settled();
    const states = [onOther, cancelled, next, last].map(({ id }) => {
      const { state, message } = queue.get(id);
      return [state, message];
    });
    expect(states).toEqual([
      ["queued", null],
      ["cancelled", null],
      ["plotting", null],
      ["queued", null],
    ]);
    (await nextRun()).end({ kind: "done" });
    await settled();
    expect(queue.get(last.id).state).toBe("plotting");
    (await nextRun()).end({ kind: "done" });
    await settled();
  });

  it("changes settings only while queued, and the name at any time", async () => {
    const { id } = await add("fern");
    const settings = { prepare: { marginMm: 12 } };
    expect((await queue.patch(id, { settings })).settings.prepare.marginMm).toBe(12);
    queue.plots.cancel(id);
    await expect(queue.patch(id, { settings })).rejects.toMatchObject({ code: "conflict" });
    expect((await queue.patch(id, { name: "bracken" })).name).toBe("bracken");
  });

  it("keeps a job until its plot has ended", async () => {
    const { id, run } = await plotting();
    await expect(queue.remove(id)).rejects.toMatchObject({ code: "conflict" });
    run.end({ kind: "done" });
    await settled();
    await queue.remove(id);
    expect(queue.list()).toEqual([]);
    expect(events.at(-1)).toEqual({ type: "job-removed", id });
  });
});
