import { describe, expect, it } from "vitest";
import type { JournalEntry, PlotProgress, PlotStart } from "../../../../host/plotter/plotter-port.js";
import { DEFAULT_PLOT_SETTINGS, type PlotSettings, type PlotWait } from "../../../../src/schema/index.js";
import { layeredStrokes, LocalPlanner } from "../../../support/plots/local-planner.js";
import { virtualBoardOf, virtualPlotter } from "../../../support/plots/virtual-plotter.js";

const LAYERS = [
  { id: "sky", name: "Sky", color: "#0000ff" },
  { id: "sea", name: "Sea", color: "#0000ff" },
  { id: "ink", name: "Ink", color: "#000000" },
];
const DRAWING = layeredStrokes(LAYERS, [
  [0, [10, 10, 60, 10]],
  [0, [60, 20, 10, 20]],
  [1, [10, 30, 60, 30]],
  [2, [60, 40, 10, 40]],
  [2, [10, 50, 60, 50]],
]);
const PEN = { color: null, widthMm: 0.5, offsetXMm: 0, offsetYMm: 0 };
const SETTINGS: PlotSettings = {
  ...DEFAULT_PLOT_SETTINGS,
  pens: [
    { id: "b", name: "Blue", ...PEN },
    { id: "k", name: "Black", ...PEN, color: "#111111" },
  ],
  layerPens: { sky: "b", sea: "b", ink: "k" },
  // The first pen is in the holder.
  layerStops: { sky: false },
};
const BLACK: PlotWait = { kind: "pen", layerName: "Ink", penName: "Black", color: "#111111" };

const BLUE: PlotWait = { kind: "pen", layerName: "Sky", penName: "Blue", color: "#0000ff" };

async function plotting(settings: PlotSettings = SETTINGS, start: PlotStart = {}, strokes = DRAWING) {
  const { world, driver, board } = await virtualPlotter();
  const journal: JournalEntry[] = [];
  const begin = async (from: PlotStart) => {
    const run = await world.run(
      driver.plot(new LocalPlanner(strokes), settings, {
        journal: { record: (entry) => journal.push(entry) },
        ...from,
      }),
    );
    const held: [boolean, PlotWait | null][] = [];
    run.onHeld((is, wait = null) => held.push([is, wait]));
    const nextHold = (): Promise<void> => new Promise((resolve) => run.onHeld((is) => is && resolve()));
    return { run, held, nextHold };
  };
  const drawnRows = (): number[] =>
    board
      .drawn()
      .filter(({ penDown, xy }) => penDown && xy.length > 2)
      .map(({ xy }) => Math.round(xy[1]));
  return { world, driver, board, journal, begin, drawnRows, ...(await begin(start)) };
}

describe("a plot with a change of pens", () => {
  it("waits at home with the pen up, names the pen, and continues when asked to", async () => {
    const { world, driver, board, run, held, nextHold, drawnRows } = await plotting();
    expect(driver.state.activity).toBe("plotting");
    await world.run(nextHold());
    expect(held).toEqual([[true, BLACK]]);
    expect(driver.state.activity).toBe("held");
    expect(board.state()).toMatchObject({ steps1: 0, steps2: 0, penUp: true, isBusy: false });
    expect(drawnRows()).toEqual([10, 20, 30]);
    await world.advance(60);
    expect(drawnRows()).toEqual([10, 20, 30]);
    await world.run(run.resume());
    expect(await world.run(run.finished)).toEqual({ kind: "done" });
    expect(held).toEqual([
      [true, BLACK],
      [false, null],
    ]);
    expect(drawnRows()).toEqual([10, 20, 30, 40, 50]);
    expect(board.state()).toMatchObject({ steps1: 0, steps2: 0, penUp: true });
    expect(driver.state).toMatchObject({ connection: "idle", activity: "none" });
  });

  it("reports the progress of the whole, up to 1, without the waits", async () => {
    const { world, run, nextHold } = await plotting();
    const seen: PlotProgress[] = [];
    run.onProgress((progress) => seen.push(progress));
    await world.run(nextHold());
    const atStop = seen[seen.length - 1];
    expect(atStop.progress).toBeGreaterThan(0.5);
    expect(atStop.progress).toBeLessThan(0.8);
    const beforeS = world.nowS();
    await world.advance(500);
    await world.run(run.resume());
    await world.run(run.finished);
    const last = seen[seen.length - 1];
    expect(last).toMatchObject({ progress: 1, remainingS: 0 });
    expect(last.elapsedS).toBeLessThan(beforeS + 20);
    expect(seen.every((p, i) => i === 0 || p.progress >= seen[i - 1].progress)).toBe(true);
    expect(seen.every((p, i) => i === 0 || p.planS >= seen[i - 1].planS - 1e-9)).toBe(true);
  });

  it("waits before the first stroke if its layer's name says so, even without a listener", async () => {
    const strokes = { ...DRAWING, layers: [{ ...LAYERS[0], name: "!Sky" }, ...LAYERS.slice(1)] };
    const { world, run, held, drawnRows } = await plotting({ ...SETTINGS, layerStops: {} }, {}, strokes);
    await world.advance(5);
    expect(held).toEqual([[true, expect.objectContaining({ layerName: "Sky", penName: "Blue" })]]);
    expect(drawnRows()).toEqual([]);
    await world.run(run.resume());
    await world.advance(3);
    expect(drawnRows()).toContain(10);
    await world.run(run.cancel().catch(() => undefined));
  });

  it("asks once: a hold after the answer, and a plot resumed behind it, do not ask again", async () => {
    const { world, driver, run, held, nextHold, journal, begin, drawnRows } = await plotting();
    await world.run(nextHold());
    await world.run(run.resume());
    await world.advance(1.5);
    await world.run(run.pause());
    expect(held[held.length - 1]).toEqual([true, null]);
    await world.run(run.resume());
    await world.advance(1);
    virtualBoardOf(driver).unplug();
    await world.run(run.finished.catch(() => undefined));
    await world.advance(5);
    const { place } = journal[journal.length - 1];
    expect(place.stroke).toBeGreaterThanOrEqual(3);
    const again = await begin({ from: place });
    await world.run(again.run.resume());
    expect(await world.run(again.run.finished)).toEqual({ kind: "done" });
    expect(again.held.filter(([, wait]) => wait !== null)).toEqual([]);
    expect(new Set(drawnRows())).toEqual(new Set([10, 20, 30, 40, 50]));
  });

  it("has its wait in the journal: a resumed plot only needs the answer", async () => {
    const { world, driver, run, nextHold, journal, begin, drawnRows } = await plotting();
    await world.run(nextHold());
    expect(journal[journal.length - 1].place).toEqual({ stroke: 3, alongMm: 0 });
    virtualBoardOf(driver).unplug();
    void run.cancel().catch(() => undefined);
    await world.run(run.finished.catch(() => undefined));
    await world.advance(5);
    const again = await begin({ from: { stroke: 3, alongMm: 0 } });
    expect(again.run.holdPlace).toEqual({ stroke: 3, alongMm: 0 });
    await world.run(again.run.resume());
    expect(await world.run(again.run.finished)).toEqual({ kind: "done" });
    expect(drawnRows()).toEqual([10, 20, 30, 40, 50]);
  });

  it("asks for the pen when it is reached if the plot was resumed before it", async () => {
    const { world, run, held, nextHold, drawnRows } = await plotting(SETTINGS, {
      from: { stroke: 2, alongMm: 0 },
    });
    await world.run(run.resume());
    await world.run(nextHold());
    expect(held[held.length - 1]).toEqual([true, BLACK]);
    await world.run(run.resume());
    await world.run(run.finished);
    expect(drawnRows()).toEqual([30, 40, 50]);
  });

  it("asks for the pen again when the user moves back before its stop", async () => {
    const { world, run, held, nextHold, drawnRows } = await plotting();
    await world.run(nextHold());
    run.moveHoldPlace({ strokes: -1 });
    expect(held[held.length - 1]).toEqual([true, null]);
    await world.run(run.resume());
    await world.run(nextHold());
    expect(held[held.length - 1]).toEqual([true, BLACK]);
    run.moveHoldPlace({ strokes: 1 });
    await world.run(run.resume());
    await world.run(run.finished);
    expect(drawnRows()).toEqual([10, 20, 30, 30, 50]);
  });

  it("asks for the previous pen when the user moves back before a change that was made", async () => {
    const { world, run, held, nextHold, drawnRows } = await plotting({ ...SETTINGS, layerStops: {} });
    await world.run(run.resume());
    await world.run(nextHold());
    await world.run(run.resume());
    await world.advance(1);
    await world.run(run.pause());
    run.moveHoldPlace({ strokes: -2 });
    expect(held[held.length - 1]).toEqual([true, BLUE]);
    // The black pen is still in the holder.
    run.moveHoldPlace({ strokes: 2 });
    expect(held[held.length - 1]).toEqual([true, null]);
    run.moveHoldPlace({ strokes: -2 });
    await world.run(run.resume());
    await world.run(nextHold());
    expect(held[held.length - 1]).toEqual([true, BLACK]);
    await world.run(run.resume());
    await world.run(run.finished);
    expect(drawnRows().slice(-3)).toEqual([30, 40, 50]);
  });

  it("can be held, changed and cancelled while it waits", async () => {
    const { world, board, run, nextHold } = await plotting();
    await world.run(nextHold());
    await world.run(run.change({ speedPct: 50 }));
    await world.run(run.pause());
    const cancelled = run.cancel();
    expect(await world.run(run.finished)).toEqual({ kind: "cancelled" });
    await cancelled;
    expect(board.state()).toMatchObject({ steps1: 0, steps2: 0, penUp: true });
  });

  it("lowers and lifts the pen for the new one, to the heights of the layer that comes next, without moving", async () => {
    const pen = { ...SETTINGS.pen, upPct: 60, downPct: 30, layers: { ink: { downPct: 20 } } };
    const { world, driver, board, run, nextHold, drawnRows } = await plotting({ ...SETTINGS, pen });
    await world.run(nextHold());
    const at = (): unknown => [driver.state.penUp, board.state().penUp, Math.round(board.state().penPct)];
    await world.run(run.movePenAtHold(false));
    expect(at()).toEqual([false, false, 20]);
    await world.run(run.change({ pen: { ...pen, layers: { ink: { downPct: 25 } } } }));
    expect(at()).toEqual([false, false, 25]);
    await world.run(run.movePenAtHold(true));
    expect(at()).toEqual([true, true, 60]);
    expect(board.state()).toMatchObject({ steps1: 0, steps2: 0 });
    await world.run(run.resume());
    expect(await world.run(run.finished)).toEqual({ kind: "done" });
    expect(drawnRows()).toEqual([10, 20, 30, 40, 50]);
  });

  it.each(["resume", "cancel", "leave"] as const)(
    "lifts a pen that stands on the paper before anything moves: %s",
    async (end) => {
      const { world, board, run, nextHold, drawnRows } = await plotting();
      await world.run(nextHold());
      await world.run(run.checkHoldPlace());
      const place = board.state();
      // Both are asked at once: the move that was asked for first is finished first.
      const lowered = run.movePenAtHold(false);
      const ended = run[end]();
      await world.run(lowered);
      await world.run(ended);
      if (end === "resume") await world.run(run.finished);
      const rows = [10, 20, 30];
      expect(drawnRows()).toEqual(end === "resume" ? [...rows, 40, 50] : rows);
      expect(board.state().penUp).toBe(true);
      const { steps1, steps2 } = end === "leave" ? place : { steps1: 0, steps2: 0 };
      expect(board.state()).toMatchObject({ steps1, steps2 });
    },
  );

  it("does not move the pen while it plots, or after the plot", async () => {
    const { world, run } = await plotting();
    await world.advance(1);
    await expect(run.movePenAtHold(false)).rejects.toThrow("The plot is not held");
    await world.run(run.cancel().catch(() => undefined));
    await expect(run.movePenAtHold(false)).rejects.toThrow("The plot is not held");
  });

  it("waits for the pen if it is paused on its way home to a stop, and is done if on the final way home", async () => {
    const { world, board, run, held, drawnRows } = await plotting();
    while (drawnRows().length < 3 || !board.state().penUp) await world.advance(0.1);
    await world.run(run.pause());
    expect(held[held.length - 1]).toEqual([true, BLACK]);
    await world.run(run.resume());
    while (drawnRows().length < 5 || !board.state().penUp) await world.advance(0.1);
    void run.pause().catch(() => undefined);
    expect(await world.run(run.finished)).toEqual({ kind: "done" });
    expect(board.state()).toMatchObject({ steps1: 0, steps2: 0 });
  });

  it.each([
    ["never", []],
    ["pens", ["Ink"]],
    ["layers", ["Sea", "Ink"]],
  ] as const)("stops according to the settings: %s", async (penStops, names) => {
    const { world, run, held } = await plotting({ ...SETTINGS, penStops });
    let isOver = false;
    void run.finished.then(() => (isOver = true));
    run.onHeld((is) => is && void run.resume());
    while (!isOver) await world.advance(1);
    expect(held.filter(([is]) => is).map(([, wait]) => wait?.layerName)).toEqual(names);
  });
});
