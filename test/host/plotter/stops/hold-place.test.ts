/**
 * The place at which a plot resumes after an emergency stop, on overlapping lines: the step counters cannot
 * tell the sides apart. The reference is the board's own count of ticks.
 */
import { describe, expect, it } from "vitest";
import { stateAt, type Trajectory } from "../../../../src/index.js";
import { MOTION_MODES } from "../../../../src/internal.js";
import { firmwareFeatures } from "../../../../src/drivers/ebb/protocol/firmware.js";
import { seeded, settingsOf } from "../../../support/plots/live-plot.js";
import {
  drawnUntilMm,
  KeepingPlanner,
  mmOf,
  planSAfter,
  ranTicks,
  RETRACED,
} from "../../../support/drawings/stop-truth.js";
import { virtualBoardOf, virtualPlotter } from "../../../support/plots/virtual-plotter.js";

const FIRMWARES = ["2.4.4", "2.5.3", "2.8.1", "3.0.0", "3.0.3"];
/** At a corner rounded by this much, mm along the line are no more accurate than that. */
const { cornerMm: ROUNDED_MM } = settingsOf("blend").motion.draw;
const STOP_COUNT = 4;

/** A random instant, the slowest of several: near the tips, where both sides are closest. */
function instant(trajectory: Trajectory, random: () => number): number {
  const times = Array.from({ length: 4 }, () => 0.95 * trajectory.totalS * random());
  const speed = (tS: number): number => {
    const { stroke, vx, vy } = stateAt(trajectory, tS);
    return stroke < 0 ? Infinity : Math.hypot(vx, vy);
  };
  return times.reduce((best, tS) => (speed(tS) < speed(best) ? tS : best));
}

describe.each(MOTION_MODES)("an emergency stop on overlapping lines, in %s mode", (mode) => {
  it.each(FIRMWARES)("resumes at exactly that place, on firmware %s", async (firmware) => {
    const random = seeded(MOTION_MODES.indexOf(mode) + 10 * FIRMWARES.indexOf(firmware) + 1);
    const withinMm = 0.02 + (mode === "junction" ? 0 : ROUNDED_MM);
    const { hasClear, idleTicksTimed } = firmwareFeatures(firmware);
    for (let i = 0; i < STOP_COUNT; i++) {
      const { world, driver } = await virtualPlotter({ firmware });
      const planner = new KeepingPlanner(RETRACED);
      const run = await world.run(driver.plot(planner, settingsOf(mode)));
      await world.advance(0.1);
      const [plot] = planner.plots;
      await world.advance(instant(plot.trajectory, random));
      await world.run(run.emergencyStop());
      // Reading back the position runs the motors for one tick, which makes no step.
      const ticks = ranTicks(virtualBoardOf(driver)) - (hasClear ? 1 + idleTicksTimed : 0);
      const truthMm = drawnUntilMm(RETRACED, plot, planSAfter(plot.commands, ticks));
      expect(Math.abs(mmOf(RETRACED, run.holdPlace!) - truthMm)).toBeLessThan(withinMm);
      await world.run(Promise.all([run.cancel(), run.finished]));
    }
  });
});
