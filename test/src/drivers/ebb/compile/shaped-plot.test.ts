/** Shaped plots on virtual boards of every generation are exact to the step, on time, and smooth. */
import { describe, expect, it } from "vitest";
import { commandLine, DEFAULT_PEN, plan, type PenSettings } from "../../../../../src/index.js";
import { sampleStrokes } from "../../../../support/drawings/sample-strokes.js";
import { FIGURES, inQuality, SPRINGS, swinging } from "../../../../support/machines/swinging.js";
import { FastBoard } from "../../../../support/plots/virtual-plots.js";

/** Largest jump of speed between two commands, mm/s. LM counts whole steps and is coarse. */
const FIRMWARE = [
  { firmware: "2.5.3", jump: 12 },
  { firmware: "2.7.0", jump: 1 },
  { firmware: "2.8.1", jump: 1 },
  { firmware: "3.0.3", jump: 0.5 },
] as const;
const DRAWINGS = { ...FIGURES, "hello-paper": await sampleStrokes("hello-paper") };

const cases = FIRMWARE.flatMap((one) =>
  SPRINGS.flatMap((springs) =>
    Object.entries(DRAWINGS).map(([name, strokes]) => ({ ...one, springs, name, strokes })),
  ),
);

describe("a shaped plot", () => {
  it.each(cases)(
    "of $name has exact steps and small jumps on firmware $firmware, springs $springs.xHz Hz",
    ({ firmware, jump, springs, strokes }) => {
      const machine = swinging(springs);
      // Pen moves in flight cut commands. Before 3.0 reversals do too, so there the carriage waits for the pen.
      const pen: PenSettings = firmware === "3.0.3" ? DEFAULT_PEN : { ...DEFAULT_PEN, overlap: "off" };
      const trajectory = plan(strokes, inQuality("fast", springs), pen, { machine });
      const fast = new FastBoard(firmware, machine, pen);
      const stream = fast.compile(trajectory);
      const played = fast.play(stream);
      const { steps1, steps2 } = fast.board.state();
      expect({ firstWrong: played.firstWrong, errors: fast.errors, steps1, steps2 }).toEqual({
        firstWrong: null,
        errors: [],
        steps1: 0,
        steps2: 0,
      });
      expect(Math.abs(played.boardS / trajectory.totalS - 1)).toBeLessThan(0.002);
      expect(fast.board.statistics().largestJumpMmPerS).toBeLessThanOrEqual(jump);
      let [moves, short] = [0, 0];
      for (let i = 0; i < stream.count; i++) {
        if (!/^(LM|LT|T3)/.test(commandLine(stream, i))) continue;
        moves++;
        if (stream.boardS[i + 1] - stream.boardS[i] < 0.004_99) short++;
      }
      // Only around reversals of a motor, which need a cut where LT cannot turn.
      expect(short / moves).toBeLessThan(firmware === "3.0.3" ? 1e-9 : 0.04);
    },
    120_000,
  );
});
