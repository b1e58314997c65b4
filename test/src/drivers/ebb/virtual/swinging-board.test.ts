/** The virtual board with a swinging pen: its motors are exact to the step, and its pen swings as simulated. */
import { describe, expect, it } from "vitest";
import { DEFAULT_MOTION, DEFAULT_PEN, planJob, VirtualBoard } from "../../../../../src/index.js";
import { swingPen } from "../../../../../src/internal.js";
import { SegmentGrid } from "../../../../support/drawings/segment-grid.js";
import { FIGURES, inQuality, SPRINGS, swinging } from "../../../../support/machines/swinging.js";
import { FastBoard } from "../../../../support/plots/virtual-plots.js";

const [springs] = SPRINGS;
const machine = swinging(springs);
const strokes = FIGURES.squares;

const played = (motion: typeof DEFAULT_MOTION, firmware: string, isSwinging: boolean) => {
  const { trajectory } = planJob({ strokes }, { motion, pen: DEFAULT_PEN }, machine, { firmware });
  const fast = new FastBoard(firmware, machine, DEFAULT_PEN, isSwinging ? { springs } : {});
  const { firstWrong } = fast.play(fast.compile(trajectory));
  const lines = fast.board.drawn().filter(({ penDown }) => penDown);
  return { trajectory, firstWrong, lines, board: fast.board };
};

/** Max. distance of the lines from the drawing, mm. */
const largestError = (lines: readonly { xy: Float64Array }[]): number => {
  const asked = new SegmentGrid(1);
  for (let s = 0; s + 1 < strokes.offsets.length; s++)
    asked.addPolyline(strokes.xy, 2 * strokes.offsets[s], 2 * strokes.offsets[s + 1]);
  let largest = 0;
  for (const { xy } of lines)
    for (let i = 0; i < xy.length; i += 2) largest = Math.max(largest, asked.distance(xy[i], xy[i + 1]));
  return largest;
};

describe.each(["2.8.1", "3.0.3"])("a virtual board with springs, firmware %s", (firmware) => {
  it("draws what the simulated pen of the plan draws, with exact steps", () => {
    const { trajectory, firstWrong, lines, board } = played(DEFAULT_MOTION, firmware, true);
    const exact = played(DEFAULT_MOTION, firmware, false);
    expect(firstWrong).toBeNull();
    const { steps1, steps2 } = exact.board.state();
    expect(board.state()).toMatchObject({ steps1, steps2 });
    const simulated = new SegmentGrid(1);
    let last: [number, number] | null = null;
    swingPen(trajectory, springs, 0.001, ({ x, y, stroke }) => {
      if (stroke >= 0 && last) simulated.addPolyline([...last, x, y]);
      last = [x, y];
    });
    let furthest = 0;
    for (const { xy } of lines) {
      for (let i = 0; i < xy.length; i += 2) {
        // Where a stroke begins and ends the pen also swings while it waits, which the simulation skips.
        const isAtEnd = Math.hypot(xy[i] - xy[0], xy[i + 1] - xy[1]) < 1;
        if (!isAtEnd) furthest = Math.max(furthest, simulated.distance(xy[i], xy[i + 1], 0.01));
      }
    }
    // Two microsteps, and a shift in time by the ticks that a command's end costs.
    expect(furthest).toBeLessThan(0.03);
  });

  it("rings unshaped, less in Fine, and not at all without springs", () => {
    const unshaped = largestError(played(DEFAULT_MOTION, firmware, true).lines);
    const fine = largestError(played(inQuality("fine", springs), firmware, true).lines);
    const exact = largestError(played(DEFAULT_MOTION, firmware, false).lines);
    expect(exact).toBeLessThan(0.06);
    expect(unshaped).toBeGreaterThan(0.12);
    expect(fine).toBeLessThan(0.6 * unshaped);
  });
});

describe("the swinging pen", () => {
  it("stops swinging after the motors stop, and is then at their position", () => {
    const board = new VirtualBoard({
      clock: { nowS: () => 0, after: () => () => undefined },
      firmware: "2.8.1",
      machine,
      speed: Infinity,
      springs,
    });
    const send = (line: string): void => board.receive(Uint8Array.from(`${line}\r`, (c) => c.charCodeAt(0)));
    for (const line of ["EM,1,1", "SP,0,100", "SM,2000,8000,8000", "SM,3000,0,0", "SP,1,100"]) send(line);
    const [line] = board.drawn().filter(({ penDown }) => penDown);
    const { xMm } = board.state();
    const xs = [...line.xy].filter((_, i) => i % 2 === 0);
    // Stopped from 50 mm/s: the first swing beyond the stop is v/ω long.
    const beyond = Math.max(...xs) - xMm;
    expect(beyond).toBeGreaterThan(0.4);
    expect(beyond).toBeLessThan(0.56);
    expect(xs[xs.length - 1]).toBeCloseTo(xMm, 2);
    // At rest there is nothing to record.
    expect(xs.length).toBeLessThan(2_000 + 2_500);
  });
});
