/** Hold, emergency stop, changes while running: what they leave on the paper, and where the motors end. */
import { describe, expect, it } from "vitest";
import { PlotterDriver } from "../../server/plotter/plotter.js";
import type { LivePlotRun } from "../../server/plotter/types.js";
import { MOTION_MODES, type MotionMode, type StrokeSet, type VirtualBoard } from "../../src/index.js";
import { DEFAULT_PLOT_SETTINGS, type PlotSettings } from "../../src/schema/index.js";
import { LocalPlanner, strokesOf } from "../support/local-planner.js";
import { ManualClock } from "../support/manual-clock.js";
import { farthest, SegmentGrid } from "../support/segment-grid.js";

/** Curves, sharp corners, a reversal, short strokes: about ten seconds of plotting. */
const DRAWING: StrokeSet = strokesOf(
  Array.from({ length: 200 }, (_, i) => [
    60 + 30 * Math.cos((i / 199) * 2 * Math.PI),
    50 + 30 * Math.sin((i / 199) * 2 * Math.PI),
  ]).flat(),
  [20, 20, 90, 20, 90, 45, 25, 45.5, 90, 46],
  [100, 60, 103, 61],
  [105, 60, 108, 61],
);

interface Rig {
  readonly world: ManualClock;
  readonly driver: PlotterDriver;
  readonly board: VirtualBoard;
  readonly run: LivePlotRun;
}

const settingsOf = (mode: MotionMode): PlotSettings => ({
  ...DEFAULT_PLOT_SETTINGS,
  motion: { ...DEFAULT_PLOT_SETTINGS.motion, mode },
});

async function plotting(mode: MotionMode, firmware = "2.8.1", strokes = DRAWING): Promise<Rig> {
  const world = new ManualClock();
  const driver = new PlotterDriver({ device: "virtual", clock: world, firmware });
  await world.run(driver.start());
  const run = await world.run(driver.plot(new LocalPlanner(strokes), settingsOf(mode)));
  return { world, driver, board: driver.virtualBoard!, run };
}

/** The lines drawn so far, pen down. */
const lines = (board: VirtualBoard): Float64Array[] =>
  board
    .drawn()
    .filter(({ penDown, xy }) => penDown && xy.length > 2)
    .map(({ xy }) => xy);

function gridOfStrokes({ xy, offsets }: StrokeSet): SegmentGrid {
  const grid = new SegmentGrid(1);
  for (let s = 0; s + 1 < offsets.length; s++) grid.addPolyline(xy, 2 * offsets[s]!, 2 * offsets[s + 1]!);
  return grid;
}

function* pairs(xy: ArrayLike<number>): Iterable<readonly [number, number]> {
  for (let i = 0; i < xy.length; i += 2) yield [xy[i]!, xy[i + 1]!];
}

/** Everything drawn lies on the drawing, and everything of the drawing is drawn. */
function expectDrawn(board: VirtualBoard, strokes: StrokeSet, withinMm: number): void {
  const drawn = new SegmentGrid(1);
  const source = gridOfStrokes(strokes);
  for (const line of lines(board)) {
    drawn.addPolyline(line);
    expect(farthest(pairs(line), source)).toBeLessThan(withinMm);
  }
  expect(farthest(pairs(strokes.xy), drawn)).toBeLessThan(withinMm);
}

/** mm between the end of each line and the beginning of the next, where they belong to the same stroke. */
function seamsMm(board: VirtualBoard): number[] {
  const all = lines(board);
  const seams: number[] = [];
  for (let i = 1; i < all.length; i++) {
    const [before, after] = [all[i - 1]!, all[i]!];
    const mm = Math.hypot(after[0]! - before[before.length - 2]!, after[1]! - before[before.length - 1]!);
    if (mm < 2) seams.push(mm);
  }
  return seams;
}

function seeded(seed: number): () => number {
  let state = seed;
  return () => (state = (state * 48271) % 2147483647) / 2147483647;
}

/** Pause to held: what is in flight (a window and a command), slowing down from 150 mm/s, the lift, a poll. */
const HELD_WITHIN_S = 0.5 + 0.15 + 0.25 + 0.05;

describe("a hold at any instant", () => {
  it.each(MOTION_MODES)(
    "leaves no gap and no doubled stretch, and ends exactly, in %s mode",
    async (mode) => {
      const random = seeded(MOTION_MODES.indexOf(mode) + 7);
      for (let i = 0; i < 70; i++) {
        const { world, board, run } = await plotting(mode);
        await world.advance(0.05 + 13 * random());
        const beforeS = world.nowS();
        await world.run(run.pause());
        expect(world.nowS() - beforeS).toBeLessThan(HELD_WITHIN_S);
        expect(board.state()).toMatchObject({ penUp: true, isBusy: false });
        await world.advance(1);
        const heldAt = board.state();
        await world.advance(1);
        expect(board.state()).toMatchObject({ steps1: heldAt.steps1, steps2: heldAt.steps2 });
        await world.run(run.resume());
        expect(await world.run(run.finished)).toEqual({ kind: "done" });
        expect(board.state()).toMatchObject({ steps1: 0, steps2: 0, penUp: true });
        expect(Math.max(0, ...seamsMm(board))).toBeLessThan(0.02);
        expectDrawn(board, DRAWING, 0.05 + 0.02);
        expect(board.statistics().underrunCount).toBe(0);
      }
    },
  );

  it("can be repeated, before the first hold has even come to rest", async () => {
    const { world, board, run } = await plotting("junction");
    for (let i = 0; i < 12; i++) {
      await world.advance(0.4);
      const paused = run.pause();
      const resumed = run.resume();
      await world.run(Promise.all([paused, resumed]));
    }
    expect(await world.run(run.finished)).toEqual({ kind: "done" });
    expect(Math.max(0, ...seamsMm(board))).toBeLessThan(0.02);
    expectDrawn(board, DRAWING, 0.05);
  });
});

describe("an emergency stop at any instant", () => {
  it.each(["2.8.1", "3.0.3"])(
    "is gone on from without a gap, and ends exactly, on firmware %s",
    async (firmware) => {
      const random = seeded(41);
      for (let i = 0; i < 40; i++) {
        const { world, board, run } = await plotting("junction", firmware);
        await world.advance(0.3 + 12 * random());
        const beforeS = world.nowS();
        await world.run(run.emergencyStop());
        expect(world.nowS() - beforeS).toBeLessThan(HELD_WITHIN_S);
        expect(board.state()).toMatchObject({ penUp: true, isBusy: false });
        await world.run(run.resume());
        expect(await world.run(run.finished)).toEqual({ kind: "done" });
        expect(board.state()).toMatchObject({ steps1: 0, steps2: 0, penUp: true });
        expect(Math.max(0, ...seamsMm(board))).toBeLessThan(0.02);
        expectDrawn(board, DRAWING, 0.05);
      }
    },
  );

  it("stops a 3.x board in the middle of its move", async () => {
    const { world, board, run } = await plotting("junction", "3.0.3");
    await world.advance(3);
    const stopped = run.emergencyStop();
    const at = board.state();
    await world.advance(0.01);
    expect(board.state()).toMatchObject({ steps1: at.steps1, steps2: at.steps2 });
    await world.run(stopped);
  });
});

describe("changes while it runs", () => {
  it("slows down within a second to the percentage asked for, without leaving the line", async () => {
    const { world, board, run } = await plotting("junction");
    await world.advance(2);
    const speed = async (): Promise<number> => {
      const from = board.state();
      await world.advance(0.1);
      const to = board.state();
      return Math.hypot(to.xMm - from.xMm, to.yMm - from.yMm) / 0.1;
    };
    expect(await speed()).toBeGreaterThan(45);
    const changed = run.change({ speedPct: 40 });
    await world.advance(0.9);
    await changed;
    expect(await speed()).toBeCloseTo(20, 0);
    expect(board.state().penUp).toBe(false);
    await world.run(run.change({ speedPct: 100 }));
    await world.advance(1);
    expect(await speed()).toBeGreaterThan(45);
    expect(await world.run(run.finished)).toEqual({ kind: "done" });
    expect(board.state()).toMatchObject({ steps1: 0, steps2: 0 });
    expect(board.statistics()).toMatchObject({ underrunCount: 0, penMoveCount: 8 });
    expectDrawn(board, DRAWING, 0.05);
  });

  it("presses harder at once where the pen is down, and from then on", async () => {
    const { world, board, run } = await plotting("junction");
    await world.advance(2);
    await world.run(run.change({ pen: { ...DEFAULT_PLOT_SETTINGS.pen, downPct: 20 } }));
    await world.advance(1);
    expect(board.state()).toMatchObject({ penUp: false });
    expect(board.state().penPct).toBeCloseTo(20, 0);
    expect(await world.run(run.finished)).toEqual({ kind: "done" });
    expect(board.statistics()).toMatchObject({ underrunCount: 0, penMoveCount: 8 });
  });

  it("takes new settings at the hold point while held", async () => {
    const { world, board, run } = await plotting("junction");
    await world.advance(2);
    await world.run(run.pause());
    await world.run(run.change({ pen: { ...DEFAULT_PLOT_SETTINGS.pen, downPct: 10 } }));
    await world.run(run.resume());
    await world.advance(1);
    expect(board.state().penPct).toBeCloseTo(10, 0);
    await world.run(run.finished);
    expectDrawn(board, DRAWING, 0.05);
  });

  it.each([0, 1, 2, 3, 4])("can be asked for at any instant, many times (run %i)", async (seed) => {
    const { world, board, run } = await plotting("junction");
    const random = seeded(seed + 1);
    for (let i = 0; i < 8; i++) {
      await world.advance(random());
      await world.run(run.change({ speedPct: 20 + Math.floor(150 * random()) }));
    }
    expect(await world.run(run.finished)).toEqual({ kind: "done" });
    expect(board.state()).toMatchObject({ steps1: 0, steps2: 0 });
    expect(board.statistics().penMoveCount).toBe(8);
    expectDrawn(board, DRAWING, 0.05);
  });
});

describe("the hold point", () => {
  it("can be moved back, looked at with the pen up, and gone on from", async () => {
    const { world, board, run } = await plotting("junction");
    await world.advance(5);
    await world.run(run.pause());
    const held = run.holdPlace!;
    expect(run.moveHoldPlace({ mm: -10 })).toEqual({ stroke: held.stroke, alongMm: held.alongMm - 10 });
    const before = board.state();
    await world.run(run.checkHoldPlace());
    const there = board.state();
    expect(there.penUp).toBe(true);
    const movedMm = Math.hypot(there.xMm - before.xMm, there.yMm - before.yMm);
    expect(movedMm).toBeGreaterThan(9);
    expect(movedMm).toBeLessThanOrEqual(10.05);
    await world.run(run.resume());
    await world.run(run.finished);
    expectDrawn(board, DRAWING, 0.05);
  });

  it("moves by whole strokes and stays within the drawing", async () => {
    const { world, run } = await plotting("junction");
    await world.advance(5);
    await world.run(run.pause());
    const { stroke } = run.holdPlace!;
    expect(run.moveHoldPlace({ strokes: -1 })).toEqual({ stroke, alongMm: 0 });
    expect(run.moveHoldPlace({ strokes: 2 })).toEqual({ stroke: stroke + 2, alongMm: 0 });
    expect(run.moveHoldPlace({ strokes: -99 })).toEqual({ stroke: 0, alongMm: 0 });
    expect(run.moveHoldPlace({ mm: 1e6 }).stroke).toBe(3);
    await world.run(Promise.all([run.cancel(), run.finished]));
  });
});
