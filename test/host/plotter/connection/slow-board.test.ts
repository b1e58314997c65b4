/**
 * A virtual board that runs slower than real time: its longer durations are not silence, and not a
 * standstill.
 */
import { describe, expect, it } from "vitest";
import { DEFAULT_PLOT_SETTINGS, type PlotSettings } from "../../../../src/schema/index.js";
import { LocalPlanner, strokesOf } from "../../../support/plots/local-planner.js";
import { virtualPlotter } from "../../../support/plots/virtual-plotter.js";

const { motion } = DEFAULT_PLOT_SETTINGS;
/** Commands of maximum length: one line of 14 s. */
const SLOW: PlotSettings = {
  ...DEFAULT_PLOT_SETTINGS,
  motion: { ...motion, draw: { ...motion.draw, speedMmPerS: 20 } },
  pen: { ...DEFAULT_PLOT_SETTINGS.pen, overlap: "off" },
};
const LINES = strokesOf([10, 10, 290, 10], [290, 60, 250, 100, 290, 150]);

async function slowPlotter(virtualSpeed: number, firmware: string) {
  return virtualPlotter({ firmware, virtualSpeed });
}

describe.each([0.5, 0.02])("a virtual board at %d of real time", (virtualSpeed) => {
  it.each(["2.5.3", "2.8.1", "3.0.3"])("plots long commands to the end, on firmware %s", async (firmware) => {
    const { world, driver, board } = await slowPlotter(virtualSpeed, firmware);
    const run = await world.run(driver.plot(new LocalPlanner(LINES), SLOW));
    expect(await world.run(run.finished)).toEqual({ kind: "done" });
    expect(board.statistics()).toMatchObject({ underrunCount: 0, movesBeforePenArrivedCount: 0 });
    expect(board.state()).toMatchObject({ steps1: 0, steps2: 0, penUp: true });
  });

  it.each(["2.5.3", "2.8.1", "3.0.3"])("can be moved by hand, on firmware %s", async (firmware) => {
    const { world, driver, board } = await slowPlotter(virtualSpeed, firmware);
    await world.run(driver.cyclePen(SLOW));
    await world.run(driver.moveTo(280, 200, SLOW));
    await world.run(driver.move({ kind: "servo", pos: 20_000 }));
    await world.run(driver.pen({ up: true }));
    await world.run(driver.command("SM,4000,3000,0"));
    await world.run(driver.home(SLOW));
    expect(driver.state.connection).toBe("idle");
    expect(driver.state.message).toContain("nothing is drawn");
    expect(board.state().penUp).toBe(true);
  });

  it.each(["2.8.1", "3.0.3"])("is held, resumes, and stops at once, on firmware %s", async (firmware) => {
    const { world, driver, board } = await slowPlotter(virtualSpeed, firmware);
    const run = await world.run(driver.plot(new LocalPlanner(LINES), SLOW));
    const held = (): Promise<void> => new Promise((resolve) => run.onHeld((isHeld) => isHeld && resolve()));
    await world.advance(5 / virtualSpeed);
    const first = held();
    await world.run(run.pause());
    await world.run(first);
    await world.run(run.resume());
    await world.advance(4 / virtualSpeed);
    const second = held();
    await world.run(run.emergencyStop());
    await world.run(second);
    await world.run(run.resume());
    expect(await world.run(run.finished)).toEqual({ kind: "done" });
    expect(board.state()).toMatchObject({ steps1: 0, steps2: 0, penUp: true });
  });

  it("is closed in mid-plot with the pen up", async () => {
    const { world, driver, board } = await slowPlotter(virtualSpeed, "2.8.1");
    const run = await world.run(driver.plot(new LocalPlanner(LINES), SLOW));
    run.finished.catch(() => undefined);
    await world.advance(9 / virtualSpeed);
    expect(board.state().penUp).toBe(false);
    await world.run(driver.close());
    expect(board.state().penUp).toBe(true);
  });
});
