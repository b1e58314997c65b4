/** Changes of speeds and heights during a plot, and requests right after them. */
import { describe, expect, it } from "vitest";
import type { PenSettings, StrokeSet, VirtualBoard } from "../../../../src/index.js";
import { MOTION_MODES } from "../../../../src/internal.js";
import { DEFAULT_PLOT_SETTINGS } from "../../../../src/schema/index.js";
import { cases } from "../../../support/runs/full-run.js";
import { DRAWING, expectDrawn, plotting, seamsMm, seeded } from "../../../support/plots/live-plot.js";
import { layeredStrokes, strokesOf } from "../../../support/plots/local-planner.js";

/** Short strokes, dots and travels: most instants are near an end of something. */
const DASHES = [
  [10, 10, 40, 10],
  [10, 30, 40, 30],
  [42, 40, 42, 60],
];
const DOTS = [
  [10, 20],
  [42, 30],
] as const;
const DASHES_MM = 80;
const [FIRST, SECOND, LAST] = DASHES as [number[], number[], number[]];
const MORSE = strokesOf(FIRST, [...DOTS[0], ...DOTS[0]], SECOND, [...DOTS[1]], LAST);

/** All of MORSE is on the paper, and nothing else. */
function expectMorse(board: VirtualBoard): void {
  const { drawnMm } = board.statistics();
  expect(drawnMm).toBeCloseTo(DASHES_MM, 0);
  expectDrawn(board, strokesOf(...DASHES), 0.05);
  const touched = board.drawn().filter(({ penDown }) => penDown);
  for (const [x, y] of DOTS) {
    const isOn = touched.some(({ xy }) => Math.hypot(xy[0] - x, xy[1] - y) < 0.05);
    expect([x, y, isOn]).toEqual([x, y, true]);
  }
}

/** The pen was down nowhere else. */
function expectOnLine(board: VirtualBoard, { xy }: StrokeSet): void {
  for (const drawn of board.drawn().filter(({ penDown }) => penDown)) {
    expect(Math.max(...drawn.xy.filter((_, i) => i % 2 === 1).map((y) => Math.abs(y - xy[1])))).toBeLessThan(
      0.1,
    );
  }
}

describe("changes while it runs", () => {
  it("slows down within a second to the requested percentage, without leaving the line", async () => {
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

  it("presses harder at once if the pen is down, and from then on", async () => {
    const { world, board, run } = await plotting("junction");
    await world.advance(2);
    await world.run(run.change({ pen: { ...DEFAULT_PLOT_SETTINGS.pen, downPct: 20 } }));
    await world.advance(1);
    expect(board.state()).toMatchObject({ penUp: false });
    expect(board.state().penPct).toBeCloseTo(20, 0);
    expect(await world.run(run.finished)).toEqual({ kind: "done" });
    expect(board.statistics()).toMatchObject({ underrunCount: 0, penMoveCount: 8 });
  });

  it.each([0, 10, 25])("waits for the servo if the pen is pressed down to %i percent", async (downPct) => {
    const waiting: PenSettings = { ...DEFAULT_PLOT_SETTINGS.pen, overlap: "off" };
    const { world, board, run } = await plotting("junction", DRAWING, "2.8.1", waiting);
    await world.advance(2);
    await world.run(run.change({ pen: { ...waiting, downPct } }));
    expect(await world.run(run.finished)).toEqual({ kind: "done" });
    expect(board.statistics().movesBeforePenArrivedCount).toBe(0);
  });

  it("applies new settings at the hold point while held", async () => {
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

  it.each([0, 1, 2, 3, 4])("can be requested at any instant, many times (run %i)", async (seed) => {
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

  it.each(MOTION_MODES)("draws each stroke once whenever one is requested, in %s mode", async (mode) => {
    const random = seeded(MOTION_MODES.indexOf(mode) + 1);
    for (let i = 0; i < cases(50, 15); i++) {
      const { world, board, run } = await plotting(mode, MORSE);
      await world.advance(0.1 + 7 * random());
      await world.run(run.change({ speedPct: 40 + 100 * random() }));
      expect(await world.run(run.finished)).toEqual({ kind: "done" });
      expect(board.state()).toMatchObject({ steps1: 0, steps2: 0 });
      expect(board.statistics()).toMatchObject({ penMoveCount: 10 });
      expectMorse(board);
    }
  });

  it.each(["pause", "emergencyStop"] as const)(
    "draws each stroke once whenever a %s follows one at once",
    async (stop) => {
      const random = seeded(11);
      for (let i = 0; i < cases(80, 20); i++) {
        const { world, board, run } = await plotting("scurve", MORSE);
        await world.advance(0.1 + 7 * random());
        const changed = run.change({ speedPct: 60 });
        await world.advance(0.7 * random());
        await world.run(run[stop]());
        await world.run(run.resume());
        expect(await world.run(run.finished)).toEqual({ kind: "done" });
        await changed;
        expect(board.state()).toMatchObject({ steps1: 0, steps2: 0 });
        expect(Math.max(0, ...seamsMm(board).filter((mm) => mm < 1))).toBeLessThan(0.02);
        expectMorse(board);
      }
    },
  );

  it.each(MOTION_MODES)("lifts the pen whenever a pause follows one, in %s mode", async (mode) => {
    const line = strokesOf([10, 10, 250, 10]);
    for (let afterS = 0.1; afterS < 0.6; afterS += 0.02) {
      const { world, board, run } = await plotting(mode, line);
      await world.advance(2);
      const changed = run.change({ speedPct: 60 });
      await world.advance(afterS);
      await world.run(run.pause());
      expect([afterS, board.state().penUp]).toEqual([afterS, true]);
      await world.run(Promise.all([run.cancel(), run.finished, changed]));
      expectOnLine(board, line);
    }
  });

  it("ends with the last of two percentages, however soon it followed the first", async () => {
    const line = strokesOf([10, 10, 250, 10]);
    for (let afterS = 0.2; afterS < 0.6; afterS += 0.02) {
      const { world, board, run } = await plotting("junction", line);
      await world.advance(2);
      const first = run.change({ speedPct: 60 });
      await world.advance(afterS);
      await world.run(run.change({ speedPct: 30 }));
      await first;
      await world.advance(1);
      const from = board.state();
      await world.advance(0.1);
      expect((board.state().xMm - from.xMm) / 0.1).toBeCloseTo(15, 0);
    }
  });
});

/** A layer with the usual height, and one with its own. Each stroke has its own y. */
const layersWith = (name: string): StrokeSet =>
  layeredStrokes(
    [
      { id: "fine", name: "Fine", color: null },
      { id: "bold", name, color: null },
    ],
    [
      [0, [10, 10, 60, 10]],
      [1, [60, 20, 10, 20]],
      [1, [10, 30, 60, 30]],
      [1, [60, 40, 10, 40]],
      [0, [10, 50, 60, 50]],
    ],
  );

describe("a change in the middle of a stroke whose layer has its own height", () => {
  const PEN: PenSettings = { ...DEFAULT_PLOT_SETTINGS.pen, overlap: "off" };
  const OWN: PenSettings = { ...PEN, layers: { bold: { downPct: 10 } } };

  /** Plots with a change in the stroke at y = 20. By y of the stroke: the heights at which the pen drew it, percent. */
  async function heightsDrawn(
    change: { speedPct?: number; pen?: PenSettings },
    pen: PenSettings,
    name: string,
  ): Promise<Record<number, number[]>> {
    const { world, board, run } = await plotting("junction", layersWith(name), "2.8.1", pen);
    const heights: Record<number, number[]> = {};
    let before = board.state();
    let changed: Promise<void> | null = null;
    let isDone = false;
    void run.finished.then(() => (isDone = true));
    while (!isDone) {
      await world.advance(0.02);
      const now = board.state();
      const isDrawing = !now.penUp && now.penPct === before.penPct && now.xMm !== before.xMm;
      const y = Math.round(now.yMm);
      const pct = Math.round(now.penPct);
      if (isDrawing && !heights[y]?.includes(pct)) (heights[y] ??= []).push(pct);
      if (isDrawing && y === 20 && now.xMm < 45) changed ??= run.change(change);
      before = now;
    }
    await changed;
    expect(board.statistics()).toMatchObject({ underrunCount: 0, movesBeforePenArrivedCount: 0 });
    return heights;
  }

  it.each([
    ["the settings", OWN, "Bold"],
    ["the layer's name", PEN, "+h10 Bold"],
  ])("a change of the speed leaves the height set by %s", async (_, pen, name) => {
    expect(await heightsDrawn({ speedPct: 60 }, pen, name)).toEqual({
      10: [30],
      20: [10],
      30: [10],
      40: [10],
      50: [30],
    });
  });

  it("a change of the height of all layers changes only those without their own", async () => {
    expect(await heightsDrawn({ pen: { ...OWN, downPct: 20 } }, OWN, "Bold")).toEqual({
      10: [30],
      20: [10],
      30: [10],
      40: [10],
      50: [20],
    });
  });

  it("a change of the layer's own height applies at once", async () => {
    const pen = { ...OWN, layers: { bold: { downPct: 0 } } };
    expect(await heightsDrawn({ pen }, OWN, "Bold")).toEqual({
      10: [30],
      20: [10, 0],
      30: [0],
      40: [0],
      50: [30],
    });
  });
});
