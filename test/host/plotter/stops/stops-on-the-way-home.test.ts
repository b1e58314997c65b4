/** Emergency stops when everything is drawn, on each controller: nothing is drawn again. */
import { expect, it } from "vitest";
import type { RunningPlot } from "../../../../host/plotter/plotter-port.js";
import type { DrawnPolyline } from "../../../../src/drivers/drawn-polylines.js";
import { machineById } from "../../../../src/index.js";
import { DEFAULT_PLOT_SETTINGS } from "../../../../src/schema/index.js";
import type { ManualClock } from "../../../support/clocks/manual-clock.js";
import { compareDrawn } from "../../../support/drawings/drawn-truth.js";
import { FAULT_DRAWING } from "../../../support/plots/faulty-plots.js";
import { newPlotter, SETTINGS } from "../../../support/plots/grbl-plotter.js";
import { LocalPlanner } from "../../../support/plots/local-planner.js";
import { virtualPlotter } from "../../../support/plots/virtual-plotter.js";

const IDRAW = { ...machineById("idraw-h-a3"), id: SETTINGS.machine };
/** The way home takes longer. */
const HOME_S = 0.6;
const LAST_STROKE = FAULT_DRAWING.offsets.length - 2;

interface Begun {
  readonly world: ManualClock;
  readonly run: RunningPlot;
  drawn(): readonly DrawnPolyline[];
}

async function onEbb(): Promise<Begun> {
  const { world, driver, board } = await virtualPlotter();
  const run = await world.run(driver.plot(new LocalPlanner(FAULT_DRAWING), DEFAULT_PLOT_SETTINGS));
  return { world, run, drawn: () => board.drawn() };
}

async function onGrbl(): Promise<Begun> {
  const { world, board, begin } = await newPlotter({}, IDRAW);
  const settings = { ...SETTINGS, customMachine: IDRAW };
  const run = await begin(new LocalPlanner(FAULT_DRAWING), {}, settings);
  return { world, run, drawn: () => board.drawn() };
}

it.each([
  ["an EiBotBoard", onEbb],
  ["a Grbl", onGrbl],
])("two emergency stops on the way home draw nothing again on %s", async (_, begun) => {
  const { world, run, drawn } = await begun();
  let leftS = Infinity;
  run.onProgress(({ remainingS }) => (leftS = remainingS));
  while (leftS > HOME_S) await world.advance(0.02);
  for (let i = 0; i < 2; i++) {
    await world.advance(0.3 * i);
    await world.run(run.emergencyStop());
    expect(run.holdPlace?.stroke).toBe(LAST_STROKE);
    await world.run(run.resume());
  }
  expect(await world.run(run.finished)).toEqual({ kind: "done" });
  const { gapMm, overlapMm } = compareDrawn(FAULT_DRAWING, drawn());
  expect(gapMm).toBeLessThan(0.05);
  expect(overlapMm).toBeLessThan(0.05);
});
