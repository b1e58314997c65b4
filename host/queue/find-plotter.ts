/** Finds the plotter of a request. */
import { PlotwrightError } from "../../src/index.js";
import type { PlotterPort } from "../plotter/plotter-port.js";

type Plotters = ReadonlyMap<string, PlotterPort>;

/** Throws `not-found`. */
export function findPlotter(plotters: Plotters, id: string): PlotterPort {
  const plotter = plotters.get(id);
  if (plotter === undefined) throw new PlotwrightError("not-found", `There is no plotter ${id}.`);
  return plotter;
}

/** Throws `not-found`, or `busy` while it is plotting a job. */
export function findFreePlotter(
  plotters: Plotters,
  queue: { isPlotterBusy(id: string): boolean },
  id: string,
): PlotterPort {
  const plotter = findPlotter(plotters, id);
  if (queue.isPlotterBusy(id)) {
    throw new PlotwrightError("busy", "A job is on the plotter. Cancel it first, or wait until it ends.");
  }
  return plotter;
}
