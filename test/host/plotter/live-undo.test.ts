/** Taking back the last stroke of a live drawing, on a board whose time passes only when the test lets it. */
import fc from "fast-check";
import { describe, expect, it } from "vitest";
import { livePlanner, LiveStrokes } from "../../../host/plotter/live-strokes.js";
import { DEFAULT_MOTION, machineById, strokesOf, type Line } from "../../../src/index.js";
import { maxOffDrawingMm } from "../../../src/internal.js";
import { DEFAULT_PLOT_SETTINGS } from "../../../src/schema/index.js";
import { compareDrawn } from "../../support/drawings/drawn-truth.js";
import { virtualPlotter } from "../../support/plots/virtual-plotter.js";
import { cases } from "../../support/runs/full-run.js";

const BESIDE_MM = maxOffDrawingMm(DEFAULT_MOTION, machineById("axidraw-v3")) + 0.05;

/** A wavy line to the right, with a point every half mm. */
const wave = (yMm: number, lengthMm: number): Line =>
  Array.from({ length: Math.round(2 * lengthMm) + 1 }, (_, i) => [20 + i / 2, yMm + 4 * Math.sin(i / 8)]);

async function drawing() {
  const { world, driver, board } = await virtualPlotter();
  const source = new LiveStrokes(machineById("axidraw-v3"), 300, 2_000);
  /** What the strokes are after each change. */
  const lines: [number, number][][] = [];
  source.record = {
    begin: (x, y) => void lines.push([[x, y]]),
    add: (x, y) => void lines.at(-1)!.push([x, y]),
    takeBack: (xy, withBegin) => {
      const line = lines.at(-1)!;
      expect(line.splice(line.length - xy.length / 2).flat()).toEqual([...xy]);
      expect(line.length === 0).toBe(withBegin);
      if (withBegin) lines.pop();
    },
  };
  const run = await world.run(driver.plot(livePlanner(source), DEFAULT_PLOT_SETTINGS, { live: source }));
  const end = async (): Promise<void> => {
    source.end();
    await world.run(run.finished);
    expect(board.state()).toMatchObject({ steps1: 0, steps2: 0, penUp: true });
    const { gapMm, overlapMm, awayMm } = compareDrawn(strokesOf(lines), board.drawn());
    expect(Math.max(gapMm, overlapMm)).toBeLessThan(0.06);
    expect(awayMm).toBeLessThan(BESIDE_MM);
  };
  return { world, board, source, run, lines, end };
}

describe("undo in a live drawing", () => {
  it("takes back a stroke that waits as a whole, without a stop of the one that is drawn", async () => {
    const { world, board, source, lines, end } = await drawing();
    source.stroke(wave(30, 100));
    source.stroke(wave(60, 40));
    await world.advance(1.5);
    expect(source.undo()).toEqual({ takenBack: 81, left: 0 });
    expect(lines).toHaveLength(1);
    await end();
    expect(board.statistics()).toMatchObject({ penMoveCount: 2, underrunCount: 0 });
  });

  it("stops on the stroke that is drawn, and leaves out the rest of it", async () => {
    const { world, board, source, run, lines, end } = await drawing();
    for (const [x, y] of wave(30, 200)) source.lineTo(x, y);
    await world.advance(3);
    const { xMm } = board.state();
    const { takenBack, left } = source.undo();
    expect(takenBack).toBeGreaterThan(200);
    expect(left).toBeLessThan(200);
    const [x] = lines[0].at(-1)!;
    // What is sent ahead, and the stopping distance.
    expect(x - xMm).toBeGreaterThan(0);
    expect(x - xMm).toBeLessThan(15);
    await world.run(source.idle());
    await world.advance(0.5);
    expect(board.state().penUp).toBe(true);
    expect(source.undo()).toEqual({ takenBack: 0, left: lines[0].length });
    source.stroke(wave(50, 20));
    await end();
    expect(run).toBeDefined();
  });

  it("takes back a stroke on the way to it: nothing of it is drawn", async () => {
    const { world, board, source, lines, end } = await drawing();
    source.stroke([
      [250, 180],
      [260, 190],
    ]);
    await world.advance(0.4);
    expect(source.undo()).toEqual({ takenBack: 2, left: 0 });
    expect(lines).toEqual([]);
    await world.advance(3);
    source.stroke([
      [20, 20],
      [30, 30],
    ]);
    await end();
    expect(board.statistics().penMoveCount).toBe(2);
  });

  it.each([[[]], [[wave(30, 10)]]])(
    "keeps a dot that is drawn while its stroke may still grow, and draws the next one",
    async (before) => {
      const { world, board, source, lines, end } = await drawing();
      for (const line of before) source.stroke(line);
      source.lineTo(50, 60);
      await world.run(source.idle());
      expect(source.undo()).toEqual({ takenBack: 0, left: 1 });
      source.lineTo(80, 60);
      await world.advance(3);
      expect(board.state()).toMatchObject({ penUp: true });
      expect(board.state().xMm).toBeCloseTo(80, 1);
      expect(source.isAllDrawn).toBe(true);
      expect(lines).toHaveLength(before.length + 2);
      await end();
      expect(board.statistics().penMoveCount).toBe(2 * lines.length);
    },
  );

  it("takes back nothing where nothing is left to draw, and nothing after the end", async () => {
    const { world, source, end } = await drawing();
    expect(source.undo()).toEqual({ takenBack: 0, left: 0 });
    source.stroke(wave(30, 10));
    await world.run(source.idle());
    expect(source.undo()).toMatchObject({ takenBack: 0 });
    await end();
    expect(() => source.undo()).toThrow("ended");
  });

  it("draws what is left, once, whenever strokes are taken back, also while it is paused", async () => {
    const step = fc.record({
      what: fc.constantFrom("stroke", "grow", "grow", "lift", "undo", "undo", "pause", "resume"),
      points: fc.integer({ min: 1, max: 120 }),
      waitS: fc.oneof(fc.constant(0), fc.double({ min: 0, max: 1.5, noNaN: true })),
    });
    await fc.assert(
      fc.asyncProperty(fc.array(step, { minLength: 3, maxLength: 14 }), async (steps) => {
        const { world, source, run, end } = await drawing();
        let row = 0;
        let isPaused = false;
        for (const { what, points, waitS } of steps) {
          const y = 12 + 13 * row;
          if (what === "stroke") source.stroke(wave(y, points));
          if (what === "grow") {
            const from = source.isOpen ? source.pointCount : 0;
            if (!source.isOpen) row++;
            const line = wave(12 + 13 * (row - 1), 250);
            const first = source.isOpen ? from - source.firstPointOf(source.strokeCount - 1) : 0;
            for (const [x, yMm] of line.slice(first, first + points)) source.lineTo(x, yMm);
          }
          if (what === "stroke") row++;
          if (what === "lift") source.penUp();
          if (what === "undo") {
            const before = source.allPoints;
            const { takenBack: gone } = source.undo();
            expect(source.allPoints).toBe(before - gone);
          }
          if (what === "pause" && !isPaused) await world.run(run.pause());
          if (what === "resume" && isPaused) await world.run(run.resume());
          if (what === "pause" || what === "resume") isPaused = what === "pause";
          await world.advance(waitS);
          expect(source.allDrawn).toBeLessThanOrEqual(source.allPoints);
        }
        if (isPaused) await world.run(run.resume());
        await end();
      }),
      { numRuns: cases(200, 12) },
    );
  }, 300_000);
});
