/** Each refusal and each alarm of a Grbl in mid-plot: the words, the pen, the state afterwards, and that nothing is lost. */
import { describe, expect, it } from "vitest";
import type { JournalEntry } from "../../../../host/plotter/plotter-port.js";
import type { VirtualGrbl } from "../../../../src/drivers/grbl/virtual/virtual-grbl.js";
import type { VirtualGrblOptions } from "../../../../src/drivers/grbl/virtual/virtual-settings.js";
import { compareDrawn } from "../../../support/drawings/drawn-truth.js";
import { FAULT_DRAWING } from "../../../support/plots/faulty-plots.js";
import { newPlotter } from "../../../support/plots/grbl-plotter.js";
import { LocalPlanner } from "../../../support/plots/local-planner.js";

const ERRORS = [
  1, 2, 3, 4, 5, 7, 8, 9, 10, 11, 12, 15, 16, 20, 21, 22, 23, 24, 25, 26, 28, 31, 32, 33, 34, 35, 36,
] as const;
const ALARMS = [1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 14] as const;
const MOST_MM = 0.05;

/** A plot with a fault, resumed as by a person, who brings the carriage home if its position is lost. */
async function plotWith(options: VirtualGrblOptions, fault: (board: VirtualGrbl) => void) {
  const { world, board, driver, begin, within } = await newPlotter(options);
  const journal: JournalEntry[] = [];
  const record = (entry: JournalEntry): void => void journal.push(entry);
  const run = await begin(new LocalPlanner(FAULT_DRAWING), { journal: { record } });
  await world.advance(3.3);
  fault(board);
  const message = await within(run.finished);
  expect(board.state()).toMatchObject({ state: "Idle", penUp: true, lostCount: 0 });
  const { state } = driver;
  expect(state).toMatchObject({ connection: "idle", activity: "none", penUp: true });
  if (state.xMm === null) board.pushHome();
  const { place: from, received } = journal.at(-1)!;
  const rest = await begin(new LocalPlanner(FAULT_DRAWING), { from, received, held: false });
  expect(await within(rest.finished)).toEqual({ kind: "done" });
  return { message, isHomeKnown: state.xMm !== null, ...compareDrawn(FAULT_DRAWING, board.drawn()) };
}

describe("a plot in which the Grbl", () => {
  it.each(ERRORS)("refuses a line with error:%i says why, and is resumed without a gap", async (code) => {
    const { message, isHomeKnown, gapMm } = await plotWith({ refusal: code }, (board) =>
      board.spoil("refused"),
    );
    expect(message).toMatch(
      new RegExp(`^board-error: The Grbl refused \\S+ with error:${code} \\([a-zG].{8,}\\)\\. `),
    );
    expect(isHomeKnown).toBe(true);
    expect(gapMm).toBeLessThan(MOST_MM);
  });

  it.each(ALARMS)("stops with ALARM:%i says why, and is resumed without a gap", async (code) => {
    const { message, isHomeKnown, gapMm } = await plotWith({}, (board) => board.stopWith(code));
    expect(message).toMatch(
      new RegExp(
        `^board-error: The Grbl has stopped with ALARM:${code} \\([a-zG].{8,}\\)\\. Check the carriage's position: `,
      ),
    );
    expect(isHomeKnown).toBe(false);
    expect(gapMm).toBeLessThan(MOST_MM);
  });

  it("refuses a line with a number of its own is quoted without a reason", async () => {
    const { message } = await plotWith({ refusal: 79 }, (board) => board.spoil("refused"));
    expect(message).toMatch(/^board-error: The Grbl refused \S+ with error:79\. If that happens again, /);
  });
});
