/** The pen does not stay on the paper longer than the connection is lost, and the user learns where it was. */
import { describe, expect, it } from "vitest";
import type { JournalEntry } from "../../host/plotter/types.js";
import { PlotterDriver } from "../../server/plotter/node-plotter.js";
import { DEFAULT_PLOT_SETTINGS } from "../../src/schema/index.js";
import { LocalPlanner, strokesOf } from "../support/local-planner.js";
import { ManualClock } from "../support/manual-clock.js";
import { virtualBoardOf } from "../support/virtual-board-of.js";

const LINE = strokesOf([10, 10, 200, 10]);

/** A plot in the middle of its only stroke. */
async function drawing(firmware: string) {
  const world = new ManualClock();
  const driver = new PlotterDriver({ device: "virtual", clock: world, firmware });
  await world.run(driver.start());
  const journal: JournalEntry[] = [];
  const run = await world.run(
    driver.plot(new LocalPlanner(LINE), DEFAULT_PLOT_SETTINGS, {
      journal: { record: (entry) => journal.push(entry) },
    }),
  );
  const ended = run.finished.catch(() => undefined);
  const board = virtualBoardOf(driver);
  await world.advance(3);
  expect(board.state().penUp).toBe(false);
  return { world, driver, board, ended };
}

const commands = (log: string): string[] => [...log.matchAll(/> (.*)/g)].map(([, line]) => line);

describe.each(["2.8.1", "3.0.3"])("on firmware %s", (firmware) => {
  it("a pen that a lost connection left on the paper is lifted first, and the message says where and how long it rested", async () => {
    const { world, driver, board, ended } = await drawing(firmware);
    board.unplug();
    await world.run(ended);
    await world.advance(1.9);
    const { xMm, penUp } = board.state();
    expect(penUp).toBe(false);
    while (driver.state.connection !== "idle") await world.advance(0.05);
    expect(board.state().penUp).toBe(true);
    expect(driver.state.message).toBe(
      `The pen rested on the paper for 2 s at x ${xMm.toFixed(1)} mm, y 10.0 mm from home, while the board was not connected. ` +
        "It is lifted now: look for a blot there before you resume.",
    );
    // Only what identifies the board and asks for its pen comes before.
    const lines = commands(driver.log());
    const before = lines.slice(0, lines.indexOf("SP,1,400"));
    expect(before.filter((line) => !/^(V|CU,10?,[01]|QT|QM|QP)$/.test(line))).toEqual([]);
  });

  it("a pen that was up when the connection was lost is not mentioned", async () => {
    const { world, driver, board, ended } = await drawing(firmware);
    while (!board.state().penUp) await world.advance(0.05);
    board.unplug();
    await world.run(ended);
    while (driver.state.connection !== "idle") await world.advance(0.1);
    expect(driver.state.message).not.toContain("rested");
  });
});

it("a program that ends lifts the pen with the first commands that it writes, without waiting for a reply", async () => {
  const { driver, board } = await drawing("3.0.3");
  void driver.close();
  // Only promises settle here; the clock stands still.
  for (let i = 0; i < 4; i++) await Promise.resolve();
  const lines = commands(driver.log());
  const firstStop = lines.indexOf("ES");
  expect(lines.slice(firstStop, firstStop + 2)).toEqual(["ES", "SP,1,0"]);
  expect(board.state().penUp).toBe(true);
});
