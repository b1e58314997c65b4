/** The pen does not stay on the paper longer than the connection is lost, and the user learns where it was. */
import { describe, expect, it } from "vitest";
import { DEFAULT_PLOT_SETTINGS } from "../../../../src/schema/index.js";
import { LocalPlanner, strokesOf } from "../../../support/plots/local-planner.js";
import { virtualBoardOf, virtualPlotter } from "../../../support/plots/virtual-plotter.js";

const LINE = strokesOf([10, 10, 200, 10]);

/** A plot in the middle of its only stroke. */
async function drawing(firmware: string, settings = DEFAULT_PLOT_SETTINGS) {
  const { world, driver } = await virtualPlotter({ firmware, settings });
  // A NextDraw would do so before the plot.
  await world.run(driver.home());
  const notes: string[] = [];
  const noted = (message: string): void => void notes.push(message);
  const run = await world.run(driver.plot(new LocalPlanner(LINE), settings, { noted }));
  const ended = run.finished.catch(() => undefined);
  const board = virtualBoardOf(driver);
  await world.advance(3);
  const { upPct, downPct } = settings.pen;
  expect(board.state().penPct).toBeLessThan((upPct + downPct) / 2);
  return { world, driver, board, ended, notes };
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

  it("a computer that stands still for 3 s says where the pen rested, and one that does for 1 s does not", async () => {
    const { world, board, ended, notes } = await drawing(firmware);
    await world.sleep(1);
    await world.advance(0.5);
    expect(notes).toEqual([]);
    await world.sleep(3);
    const xMm = Number(/ for 3 s, .* at x ([\d.]+) mm, y 10\.0 mm from home/.exec(notes[0])![1]);
    expect(Math.abs(xMm - board.state().xMm)).toBeLessThan(1);
    await world.run(ended);
    expect(notes).toHaveLength(1);
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

it("a pen on the second servo output, which the board does not report, is lifted too", async () => {
  const settings = { ...DEFAULT_PLOT_SETTINGS, machine: "nextdraw-8511" };
  const { world, driver, board, ended } = await drawing("3.0.3", settings);
  board.unplug();
  await world.run(ended);
  expect(board.state().penPct).toBe(settings.pen.downPct);
  while (driver.state.connection !== "idle") await world.advance(0.05);
  expect(board.state().penPct).toBe(settings.pen.upPct);
  expect(driver.state.message).toContain("The pen rested on the paper for");
});
