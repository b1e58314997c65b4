/** A plot on a virtual board that a test has made, without a plotter driver around it. */
import { MachinePlot } from "../../../host/plotter/machine-plot.js";
import type { RunningPlot, PlotProgress } from "../../../host/plotter/plotter-port.js";
import { driver as ebbDriver } from "../../../src/drivers/ebb/driver.js";
import type { StrokeSet, Trajectory, VirtualBoard } from "../../../src/index.js";
import type { Machine } from "../../../src/internal.js";
import type { PlotSettings } from "../../../src/schema/index.js";
import { NO_EVENTS } from "../machines/machine.js";
import type { ManualClock } from "../clocks/manual-clock.js";
import { KeepingPlanner } from "../drawings/stop-truth.js";

export interface PlotOnBoard {
  readonly run: RunningPlot;
  readonly machine: Machine;
  readonly trajectory: Trajectory;
  /** All that was reported. */
  readonly reports: PlotProgress[];
}

/** A plot that has just begun: the clock is at the start of its plan. */
export async function plotOnBoard(
  world: ManualClock,
  board: VirtualBoard,
  strokes: StrokeSet,
  settings: PlotSettings,
): Promise<PlotOnBoard> {
  const machine = await world.run(
    ebbDriver.identify(board.transport(), {
      clock: world,
      machineClock: world,
      speed: 1,
      events: NO_EVENTS,
    }),
  );
  await world.run(machine.readKeptState(settings, null));
  const planner = new KeepingPlanner(strokes);
  const run = new MachinePlot(machine, planner, settings);
  const reports: PlotProgress[] = [];
  run.onProgress((progress) => void reports.push(progress));
  while (reports.length === 0) await world.advance(0.001);
  return { run, machine, trajectory: planner.plots[0].trajectory, reports };
}
