/** What another program has left on the board changes nothing on the paper. */
import { describe, expect, it } from "vitest";
import type { DrawnPolyline } from "../../../../src/drivers/drawn-polylines.js";
import { machineById, VirtualBoard } from "../../../../src/index.js";
import { DEFAULT_PLOT_SETTINGS } from "../../../../src/schema/index.js";
import { ManualClock } from "../../../support/clocks/manual-clock.js";
import { strokesOf } from "../../../support/plots/local-planner.js";
import { plotOnBoard } from "../../../support/plots/plot-on-board.js";
import { ascii } from "../../../support/plots/virtual-plots.js";

const DRAWING = strokesOf([20, 20, 90, 25, 60, 80], [30, 70, 80, 30]);
const MACHINES = ["axidraw-v3", "nextdraw-8511"] as const;

/** Pen-down lines of our plot on a board that was left like this. */
async function drawnAfter(
  machine: (typeof MACHINES)[number],
  firmware: string,
  lines: readonly string[],
): Promise<DrawnPolyline[]> {
  const world = new ManualClock();
  const board = new VirtualBoard({ clock: world, machine: machineById(machine), firmware });
  board.gantry?.push({ xMm: 40, yMm: 25 });
  for (const line of lines) board.receive(ascii(`${line}\r`));
  await world.advance(5);
  const theirs = board.drawn().length;
  const settings = { ...DEFAULT_PLOT_SETTINGS, machine };
  const { run } = await plotOnBoard(world, board, DRAWING, settings);
  await world.run(run.finished);
  return board
    .drawn()
    .slice(theirs)
    .filter(({ penDown }) => penDown);
}

const points = (lines: readonly DrawnPolyline[]): number[] => lines.flatMap(({ xy }) => [...xy]);

/** Of the maker's software: replies in one line, a queue of 16, frames of one slot, and its variables. The slots are of another program. */
const SET_UP = [
  "CU,10,1",
  "CU,4,16",
  "SC,8,1",
  "SC,9,5",
  "SC,4,9000",
  "SC,5,6000",
  "SC,11,1000",
  "SC,12,1000",
];
const VARIABLES = ["SL,41,10", "SL,143,11", ...[24, 25, 26, 27, 28, 29, 30, 31].map((i) => `SL,${i},${i}`)];
const JOB = ["SP,0,100", "T3,5000,200000000,0,0,100000000,0,0,3", "SP,1,100"];

describe.each(MACHINES)("a plot on a %s", (machine) => {
  describe.each(["3.0.3", "3.1.7"])("with firmware %s", (firmware) => {
    it.each([
      [
        "a job of the maker's software that switched the motors off",
        [...SET_UP, ...VARIABLES, "EM,1,1", ...JOB, "EM,0,0"],
      ],
      ["one that ended where it began", [...SET_UP, ...VARIABLES, "EM,1,1", "CS", ...JOB, "HM,3000"]],
      ["one with coarser steps", [...SET_UP, ...VARIABLES, "EM,2,2", "CS", ...JOB, "HM,3000"]],
      ["homing that was killed", [...SET_UP, "CU,50,0", "EM,1,0", "CU,52,2", "CU,51,2", "SM,200,-100,0"]],
      ["a supply threshold of its own", [...SET_UP, "CU,60,300", "SR,1000", "EM,0,0"]],
    ])("draws after %s as after a fresh start", async (_what, lines) => {
      const fresh = points(await drawnAfter(machine, firmware, []));
      const after = points(await drawnAfter(machine, firmware, lines));
      expect(after.length).toBeGreaterThan(0);
      // One end may differ by a step.
      const off =
        after.length === fresh.length ? after.map((value, i) => Math.abs(value - fresh[i])) : [Infinity];
      expect(Math.max(...off)).toBeLessThan(0.02);
    });
  });
});
