/**
 * How long the motors keep running after an emergency stop: the time in the plotter's state holds at any
 * instant.
 */
import { describe, expect, it } from "vitest";
import { DEFAULT_PLOT_SETTINGS } from "../../../../src/schema/index.js";
import { FAULT_DRAWING } from "../../../support/plots/faulty-plots.js";
import { seeded } from "../../../support/plots/live-plot.js";
import { LocalPlanner } from "../../../support/plots/local-planner.js";
import { virtualBoardOf, virtualPlotter } from "../../../support/plots/virtual-plotter.js";

const LOOK_MS = 2;

/** The longest time that the motors ran after a stop at several instants, and the reported maximum, ms. */
async function stopMs(firmware: string, sendAheadMs: number): Promise<{ mostMs: number; saidMs: number }> {
  const random = seeded(123_456_789);
  let [mostMs, saidMs] = [0, 0];
  for (let i = 0; i < 12; i++) {
    const { world, driver } = await virtualPlotter({ firmware });
    const settings = { ...DEFAULT_PLOT_SETTINGS, sendAheadMs };
    const run = await world.run(driver.plot(new LocalPlanner(FAULT_DRAWING), settings));
    await world.advance(0.6 + 6 * random());
    saidMs = driver.state.emergencyStopMs!;
    const stopped = run.emergencyStop();
    let steps = "";
    for (let ms = 0; ms < 1_000; ms += LOOK_MS) {
      const { steps1, steps2 } = virtualBoardOf(driver).state();
      if (steps !== `${steps1},${steps2}`) mostMs = Math.max(mostMs, ms);
      steps = `${steps1},${steps2}`;
      await world.advance(LOOK_MS / 1_000);
    }
    await world.run(stopped);
    expect(driver.log()).toContain(`takes up to ${saidMs} ms on firmware ${firmware}`);
    await world.run(driver.close());
  }
  return { mostMs, saidMs };
}

describe("an emergency stop", () => {
  it("takes as long as the motion sent ahead on firmware 2.8.1, so less if less is sent ahead", async () => {
    const usual = await stopMs("2.8.1", 300);
    expect(usual.saidMs).toBe(420);
    expect(usual.mostMs).toBeLessThanOrEqual(usual.saidMs);
    expect(usual.mostMs).toBeGreaterThan(200);
    const short = await stopMs("2.8.1", 100);
    expect(short.saidMs).toBe(330);
    expect(short.mostMs).toBeLessThanOrEqual(short.saidMs);
    expect(short.mostMs).toBeLessThan(usual.mostMs - 50);
  });

  it("takes a moment on firmware 3", async () => {
    const { mostMs, saidMs } = await stopMs("3.0.3", 300);
    expect(saidMs).toBe(30);
    expect(mostMs).toBeLessThanOrEqual(saidMs);
  });
});
