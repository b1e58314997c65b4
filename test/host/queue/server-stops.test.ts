/**
 * A server that stops in each state of a plot: a held plot does not move, any other one lifts its pen and goes home.
 * After the restart the plot resumes exactly where it stopped.
 */
import { afterEach, beforeEach, describe, expect, it } from "vitest";
import { JobQueue } from "../../../host/queue/job-queue.js";
import type { PlotPlanner } from "../../../host/planning/planning.js";
import { NodePlotter } from "../../support/plots/node-plotter.js";
import { prepareDataDir } from "../../../server/storage/data-dir.js";
import { DrawingFiles } from "../../../server/storage/drawing-files.js";
import { Store } from "../../../server/storage/store.js";
import { PlotwrightError, type VirtualBoard } from "../../../src/index.js";
import { DEFAULT_PLOT_SETTINGS, type Job, type PlotSettings } from "../../../src/schema/index.js";
import { compareDrawn } from "../../support/drawings/drawn-truth.js";
import { layeredStrokes, LocalPlanner } from "../../support/plots/local-planner.js";
import { ManualClock } from "../../support/clocks/manual-clock.js";
import { LED_PLANNING, LedPlotter } from "../../support/jobs/led-plotter.js";
import { drawingOf } from "../../support/jobs/jobs.js";
import { folderOfTest } from "../../support/processes/folders.js";
import { virtualBoardOf } from "../../support/plots/virtual-plotter.js";

/** About ten seconds of drawing. */
const STROKES = layeredStrokes(
  [
    { id: "sky", name: "Sky", color: "#0000ff" },
    { id: "sea", name: "Sea", color: "#000000" },
  ],
  [
    [0, [10, 10, 200, 10]],
    [0, [200, 60, 10, 60]],
    [1, [10, 70, 100, 70]],
  ],
);
const SETTINGS: PlotSettings = { ...DEFAULT_PLOT_SETTINGS, layerStops: { sky: false, sea: false } };
const GAP_MM = 0.05;
const BACK_MM = 5;
/** What a board may draw of the commands after a refused one. */
const WINDOW_MM = 40;

let dir: string;
let world: ManualClock;
let driver: NodePlotter;
let board: VirtualBoard;
let store: Store;
let queue: JobQueue;
let openPlanner: (signal: AbortSignal) => Promise<PlotPlanner>;

beforeEach(() => {
  dir = folderOfTest();
  prepareDataDir(dir);
  world = new ManualClock();
  openPlanner = () => Promise.resolve(new LocalPlanner(STROKES));
});
afterEach(async () => {
  await world.run(stopServer());
  await driver.close();
});

function openQueue(): void {
  const plotter = Object.assign(new LedPlotter(), {
    snapshot: () => ({ ...new LedPlotter().snapshot(), ...driver.state }),
    plot: driver.plot.bind(driver),
  });
  store = Store.open(dir);
  queue = new JobQueue({
    store,
    files: new DrawingFiles(dir, 1_000_000),
    planning: { ...LED_PLANNING, open: (_drawing, _settings, signal) => openPlanner(signal) },
    plotters: new Map([[plotter.id, plotter]]),
    announce: () => undefined,
    nowIso: () => "2026-01-01T00:00:00.000Z",
  });
}

async function stopServer(): Promise<void> {
  await queue.close();
  store.close();
}

/** The server starts again. The board kept its position, unless `meanwhile` takes it. */
async function startServer(meanwhile = (): void => board.unplug()): Promise<void> {
  meanwhile();
  await world.advance(5);
  openQueue();
}

async function started(settings = SETTINGS): Promise<string> {
  const { id } = await queue.add({ name: "fern", settings, drawing: drawingOf("fern") });
  await world.run(queue.start(id));
  return id;
}
async function until(id: string, state: Job["state"]): Promise<void> {
  for (let i = 0; i < 1_000 && queue.get(id).state !== state; i++) await world.advance(0.05);
  expect(queue.get(id).state).toBe(state);
}

const motors = () => {
  const { steps1, steps2, motorsOn } = board.state();
  return { steps1, steps2, motorsOn };
};
const AT_HOME = { steps1: 0, steps2: 0, penUp: true, isBusy: false };

async function stopAndStart(): Promise<void> {
  await world.run(stopServer());
  await startServer();
}
async function cancelIt(id: string): Promise<void> {
  queue.plots.cancel(id);
  await until(id, "cancelled");
}

async function resumeAndCompare(id: string, twiceMm = 0): Promise<void> {
  queue.plots.recover(id);
  await world.advance(1);
  await finishAndCompare(id, twiceMm);
}

async function finishAndCompare(id: string, twiceMm: number): Promise<void> {
  queue.plots.resume(id);
  await until(id, "done");
  const { gapMm, overlapMm } = compareDrawn(STROKES, board.drawn());
  expect(gapMm).toBeLessThan(GAP_MM);
  expect(overlapMm).toBeLessThan(twiceMm + GAP_MM);
  expect(board.state()).toMatchObject(AT_HOME);
}

/** Within the first, the second and the last stroke. */
const INSTANTS_S = [1.5, 6.5, 10];

describe.each(["2.8.1", "3.0.3"])("on firmware %s", (firmware) => {
  beforeEach(async () => {
    driver = new NodePlotter({ device: "virtual", clock: world, firmware });
    await world.run(driver.start());
    board = virtualBoardOf(driver);
    openQueue();
  });

  describe("a server that stops while a plot is held", () => {
    it.each(INSTANTS_S)("a server that stops after an emergency stop at %s s moves nothing", async (s) => {
      const id = await started();
      await world.advance(s);
      await world.run(queue.plots.emergencyStop(id));
      const stopped = motors();
      const { place } = queue.get(id);
      await world.run(stopServer());
      await world.advance(2);
      expect(board.state()).toMatchObject({ ...stopped, penUp: true, isBusy: false });
      await startServer();
      expect(queue.get(id)).toMatchObject({ state: "interrupted", place });
      await resumeAndCompare(id);
    });

    it.each(INSTANTS_S)("a server that stops %s s into an emergency stop moves nothing", async (s) => {
      const id = await started();
      await world.advance(s);
      const stopping = queue.plots.emergencyStop(id);
      await world.run(stopServer());
      await stopping;
      const stopped = motors();
      expect(stopped).not.toMatchObject({ steps1: 0, steps2: 0 });
      await world.advance(2);
      expect(board.state()).toMatchObject({ ...stopped, penUp: true, isBusy: false });
      await startServer();
      await resumeAndCompare(id);
    });

    it.each(INSTANTS_S)(
      "a server that stops while the user holds a plot at %s s moves nothing, and keeps a moved place",
      async (s) => {
        const id = await started();
        await world.advance(s);
        queue.plots.pause(id);
        await until(id, "paused");
        const stopped = motors();
        const { place } = queue.plots.movePlace(id, { mm: -BACK_MM });
        await world.run(stopServer());
        await world.advance(2);
        expect(motors()).toEqual(stopped);
        await startServer();
        expect(queue.get(id)).toMatchObject({ state: "interrupted", place });
        await resumeAndCompare(id, BACK_MM);
      },
    );

    it("a server that stops between two strokes keeps a moved place, although the carriage rests on the way to the next", async () => {
      const id = await started();
      // Above the first stroke's end, from where it travels to the second.
      while (board.state().xMm < 199.9 || board.state().yMm < 11) await world.advance(0.01);
      await world.run(queue.plots.emergencyStop(id));
      expect(board.state().yMm).toBeLessThan(59);
      const { place } = queue.plots.movePlace(id, { mm: -BACK_MM });
      expect(place?.strokeIndex).toBe(0);
      await world.run(stopServer());
      await startServer();
      queue.plots.recover(id);
      await world.advance(1);
      expect(queue.get(id)).toMatchObject({ state: "paused", place });
      await finishAndCompare(id, BACK_MM);
    });

    it("a server that stops while a plot waits for a pen leaves it at home, and still waits for the pen", async () => {
      const id = await started({ ...SETTINGS, layerStops: { sky: false, sea: true } });
      await until(id, "paused");
      await world.run(stopServer());
      expect(board.state()).toMatchObject(AT_HOME);
      await startServer();
      const wait = { kind: "pen", layerName: "Sea" };
      expect(queue.get(id)).toMatchObject({ place: { strokeIndex: 2, alongMm: 0 }, wait });
      await resumeAndCompare(id);
    });

    it("a server that stops with the position lost does not take another one for home", async () => {
      const id = await started();
      await world.advance(6.5);
      await world.run(stopServer());
      await startServer(() => board.resetByPower());
      const { place } = queue.get(id);
      queue.plots.recover(id);
      await world.advance(1);
      await world.run(stopServer());
      await world.advance(2);
      expect(board.state()).toMatchObject({ motorsOn: false, isBusy: false });
      await startServer();
      expect(driver.state.xMm).toBeNull();
      expect(queue.get(id)).toMatchObject({ state: "interrupted", place });
      await resumeAndCompare(id);
    });

    it("a server that stops where an earlier server left the plot moves nothing and keeps its place", async () => {
      const id = await started();
      await world.advance(6.5);
      await world.run(queue.plots.emergencyStop(id));
      const stopped = motors();
      const { place } = queue.get(id);
      for (let times = 0; times < 3; times++) {
        await world.run(stopServer());
        await startServer();
        queue.plots.recover(id);
        // Before and after the pen and the place have been checked.
        await world.advance(times);
      }
      await world.run(stopServer());
      await world.advance(2);
      expect(motors()).toEqual(stopped);
      await startServer();
      expect(queue.get(id)).toMatchObject({ state: "interrupted", place });
      await resumeAndCompare(id);
    });
  });

  it("keeps the place that a board reported after a lost connection, if the server stops before the plot resumes", async () => {
    const id = await started();
    await world.advance(6.5);
    board.unplug();
    await until(id, "interrupted");
    await world.advance(5);
    queue.plots.recover(id);
    await world.advance(1);
    const { place } = queue.get(id);
    await world.run(stopServer());
    await startServer();
    expect(queue.get(id)).toMatchObject({ state: "interrupted", place });
    await resumeAndCompare(id);
  });

  it("leaves nothing out after a refused command, a move home and a restart", async () => {
    const id = await started();
    await world.advance(6.6);
    board.refuseNext();
    await until(id, "interrupted");
    const { place } = queue.get(id);
    await world.run(driver.home());
    await world.run(stopServer());
    await startServer();
    expect(queue.get(id)).toMatchObject({ state: "interrupted", place });
    await resumeAndCompare(id, WINDOW_MM);
  });

  it.each([0.02, 0.1, 0.2, 0.3])(
    "draws nothing twice if the server is killed %s s after it resumed",
    async (s) => {
      const id = await started();
      await world.advance(6.5);
      queue.plots.pause(id);
      await until(id, "paused");
      queue.plots.resume(id);
      while (board.state().penUp) await world.advance(0.01);
      await world.advance(s);
      store.close();
      await startServer();
      await resumeAndCompare(id);
    },
  );

  describe("wherever the carriage is moved between two starts of the server, a plot", () => {
    /** On the way from the first stroke to the second, as if the first one were drawn. */
    async function movedBetweenStarts(): Promise<void> {
      await world.run(driver.moveTo(200, 40));
      await world.run(stopServer());
      await startServer();
    }

    it.each([
      ["interrupted", stopAndStart],
      ["cancelled", cancelIt],
    ] as const)(
      "a plot that was %s keeps its place wherever the carriage is moved between two starts of the server",
      async (state, end) => {
        const id = await started();
        await world.advance(1.5);
        await end(id);
        expect(queue.get(id).state).toBe(state);
        const { place } = queue.get(id);
        await movedBetweenStarts();
        queue.plots.recover(id);
        await world.advance(1);
        expect(queue.get(id)).toMatchObject({ state: "paused", place });
        await finishAndCompare(id, 0);
      },
    );

    it("starts at the place that the user chose", async () => {
      await movedBetweenStarts();
      const from = { strokeIndex: 0, alongMm: 100 };
      const { id } = await queue.add({
        name: "fern",
        settings: SETTINGS,
        drawing: drawingOf("fern"),
        from,
      });
      await world.run(queue.start(id));
      await world.advance(1);
      expect(queue.get(id)).toMatchObject({ state: "paused", place: from });
    });
  });

  describe("a server that stops while a plot", () => {
    it("is planned moves nothing", async () => {
      openPlanner = (signal) =>
        new Promise((_, reject) => {
          const cancelled = new PlotwrightError("cancelled", "The plot was cancelled.");
          signal.addEventListener("abort", () => reject(cancelled), { once: true });
        });
      const id = await started();
      await world.advance(1);
      const before = motors();
      await world.run(stopServer());
      expect(motors()).toEqual(before);
      openPlanner = () => Promise.resolve(new LocalPlanner(STROKES));
      await startServer();
      expect(queue.get(id).state).toBe("interrupted");
      await resumeAndCompare(id);
    });

    it("lifts its pen before it starts does not draw", async () => {
      const id = await started();
      await world.advance(0.05);
      await world.run(stopServer());
      expect(board.state()).toMatchObject(AT_HOME);
      await startServer();
      await resumeAndCompare(id);
    });

    it.each(INSTANTS_S)("draws (%s s) goes home, and leaves nothing out after the restart", async (s) => {
      const id = await started();
      await world.advance(s);
      await world.run(stopServer());
      expect(board.state()).toMatchObject(AT_HOME);
      await startServer();
      expect(queue.get(id).state).toBe("interrupted");
      await resumeAndCompare(id);
    });

    it("resumes after a restart, and has not drawn yet, keeps its place", async () => {
      const id = await started();
      await world.advance(6.5);
      await world.run(stopServer());
      await startServer();
      const { place } = queue.get(id);
      queue.plots.recover(id);
      await world.advance(1);
      queue.plots.resume(id);
      await world.advance(0.2);
      await world.run(stopServer());
      expect(board.state()).toMatchObject(AT_HOME);
      await startServer();
      expect(queue.get(id)).toMatchObject({ state: "interrupted", place });
      await resumeAndCompare(id);
    });

    it.each(INSTANTS_S)("is cancelled (%s s) goes home, and leaves it cancelled", async (s) => {
      const id = await started();
      await world.advance(s);
      queue.plots.cancel(id);
      await world.advance(0.1);
      await world.run(stopServer());
      expect(board.state()).toMatchObject(AT_HOME);
      await startServer();
      expect(queue.get(id).state).toBe("cancelled");
      await resumeAndCompare(id);
    });
  });
});
