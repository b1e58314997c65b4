/** A Grbl that is stopped at rest, between plots or in a move by hand: by its door, by a button or by another program. */
import { describe, expect, it } from "vitest";
import type { JournalEntry } from "../../../../host/plotter/plotter-port.js";
import type { VirtualGrbl } from "../../../../src/drivers/grbl/virtual/virtual-grbl.js";
import { compareDrawn } from "../../../support/drawings/drawn-truth.js";
import { GRBL_SERVO } from "../../../support/machines/machine.js";
import { FAULT_DRAWING } from "../../../support/plots/faulty-plots.js";
import { newPlotter, plotterOn, SETTINGS } from "../../../support/plots/grbl-plotter.js";
import { LocalPlanner } from "../../../support/plots/local-planner.js";
import { startAfter } from "../../../support/plots/start-after.js";

const DOOR = /^board-error: The Grbl's safety door is open, and nothing moves until it is closed\./;
/** Longer than it takes until a plotter is connected again, s. */
const AGAIN_S = 8;
const MOST_MM = 0.05;

function expectWhole(board: VirtualGrbl): void {
  const { gapMm, overlapMm } = compareDrawn(FAULT_DRAWING, board.drawn());
  expect(gapMm).toBeLessThan(MOST_MM);
  expect(overlapMm).toBeLessThan(MOST_MM);
}

/** Plots, and pauses in the middle of a stroke. */
async function paused() {
  const plotter = await newPlotter({}, GRBL_SERVO);
  const settings = { ...SETTINGS, customMachine: GRBL_SERVO };
  const journal: JournalEntry[] = [];
  const record = (entry: JournalEntry): void => void journal.push(entry);
  const run = await plotter.begin(new LocalPlanner(FAULT_DRAWING), { journal: { record } }, settings);
  await plotter.world.advance(4);
  await plotter.world.run(run.pause());
  return { ...plotter, settings, journal, run };
}

describe("an open door", () => {
  it("keeps a plot from beginning, and the plotter says so until it is closed", async () => {
    const { world, board, driver, begin, within } = await newPlotter();
    board.setDoor(true);
    const run = await begin(new LocalPlanner(FAULT_DRAWING));
    expect(await within(run.finished)).toMatch(DOOR);
    for (let i = 0; i < 5; i++) {
      await world.advance(3);
      expect(driver.state).toMatchObject({
        connection: "fault",
        message: expect.stringMatching(/door is open/),
      });
    }
    expect(board.state()).toMatchObject({ state: "Door:1", xMm: 0, yMm: 0 });
    board.setDoor(false);
    await world.advance(AGAIN_S);
    expect(driver.state).toMatchObject({ connection: "idle", penUp: true });
    const again = await begin(new LocalPlanner(FAULT_DRAWING));
    expect(await within(again.finished)).toEqual({ kind: "done" });
    expectWhole(board);
  });

  it("during a pause, closed before the plot is resumed, disturbs nothing", async () => {
    const { world, board, run, within } = await paused();
    board.setDoor(true);
    await world.advance(10);
    board.setDoor(false);
    await world.run(run.resume());
    expect(await within(run.finished)).toEqual({ kind: "done" });
    expectWhole(board);
  });

  it("when a plot is resumed interrupts it, and nothing is lost", async () => {
    const { world, board, driver, begin, journal, settings, run, within } = await paused();
    board.setDoor(true);
    void run.resume().catch(() => undefined);
    expect(await within(run.finished)).toMatch(DOOR);
    board.setDoor(false);
    await world.advance(AGAIN_S);
    expect(driver.state).toMatchObject({ connection: "idle", penUp: true });
    const rest = await begin(
      new LocalPlanner(FAULT_DRAWING),
      { ...startAfter(journal.at(-1)), held: false },
      settings,
    );
    expect(await within(rest.finished)).toEqual({ kind: "done" });
    expectWhole(board);
  });

  it("is named to a program that connects, and the pen is lifted when it is closed", async () => {
    const { world, board, kill } = await paused();
    kill();
    board.setDoor(true);
    const { driver } = await plotterOn(board, world, GRBL_SERVO);
    expect(driver.state).toMatchObject({
      connection: "fault",
      message: expect.stringMatching(/door is open/),
    });
    board.setDoor(false);
    await world.advance(AGAIN_S);
    expect(driver.state).toMatchObject({ connection: "idle" });
    expect(board.state()).toMatchObject({ state: "Idle", penUp: true });
  });

  it("at an emergency stop keeps the Grbl locked; when it is closed, the plotter works again", async () => {
    const { world, board, driver, begin, within, mustWork } = await newPlotter();
    const run = await begin(new LocalPlanner(FAULT_DRAWING));
    await world.advance(4);
    board.setDoor(true);
    expect(board.state().state).toBe("Door:2");
    void run.emergencyStop().catch(() => undefined);
    expect(await within(run.finished)).toMatch(/^board-error: .*The Grbl's safety door is open/);
    await world.advance(10);
    expect(driver.state.connection).toBe("fault");
    board.setDoor(false);
    await world.advance(AGAIN_S);
    await mustWork();
  });

  it("stops a move by hand, which says why", async () => {
    const { world, board, driver, within, mustWork } = await newPlotter();
    const move = driver.move({ kind: "move-to", xMm: 200, yMm: 100 });
    await world.advance(1);
    board.setDoor(true);
    expect(await within(move)).toMatch(DOOR);
    board.setDoor(false);
    await world.advance(AGAIN_S);
    expect(driver.state.xMm).toBeCloseTo(board.state().xMm, 2);
    await mustWork();
  });
});

describe("a hold", () => {
  it("stops a move by hand at once, and the next one goes on from there", async () => {
    const { world, board, driver, within, mustWork } = await newPlotter();
    const move = driver.move({ kind: "move-to", xMm: 200, yMm: 100 });
    await world.advance(1);
    board.pressHold();
    expect(await within(move)).toMatch(
      /^conflict: The Grbl was held by a button of the machine.* Move again to go on\./,
    );
    expect(driver.state).toMatchObject({ connection: "idle", penUp: true });
    expect(driver.state.xMm).toBeCloseTo(board.state().xMm, 2);
    await mustWork();
  });

  it.each([
    ["its hold button is pressed", (board: VirtualGrbl) => board.pressHold()],
    ["another program has it check lines", (board: VirtualGrbl) => board.takeFromOther("$C")],
  ])("at rest does not keep a plot from beginning: %s", async (_, fault) => {
    const { world, board, begin, within } = await newPlotter();
    fault(board);
    await world.advance(5);
    const run = await begin(new LocalPlanner(FAULT_DRAWING));
    expect(await within(run.finished)).toEqual({ kind: "done" });
    expectWhole(board);
  });

  it("during a pause does not keep a plot from being resumed", async () => {
    const { world, board, run, within } = await paused();
    board.pressHold();
    await world.advance(5);
    await world.run(run.resume());
    expect(await within(run.finished)).toEqual({ kind: "done" });
    expectWhole(board);
  });
});

it("a Grbl that another program has sent to sleep at rest wakes up for a move, which begins at home", async () => {
  const { world, board, driver, within } = await newPlotter();
  await within(driver.move({ kind: "move-to", xMm: 30, yMm: 20 }));
  board.takeFromOther("$SLP");
  await world.advance(5);
  expect(await within(driver.move({ kind: "move-to", xMm: 5, yMm: 6 }))).toBeUndefined();
  expect(driver.state).toMatchObject({ xMm: 5, yMm: 6 });
  expect(board.state()).toMatchObject({ state: "Idle", xMm: 35, yMm: 26 });
});
