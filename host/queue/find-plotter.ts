/** Finds the plotter of a request, and checks that it is free for it. */
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

/** Throws `busy` or `no-board` unless the plotter is connected and idle. */
export function mustBeIdle(plotter: PlotterPort): void {
  const { connection, message, name } = plotter.snapshot();
  if (connection === "idle") return;
  if (connection === "busy") throw new PlotwrightError("busy", `${name} is busy. Wait for it to finish.`);
  throw new PlotwrightError("no-board", message ?? `${name} is not connected. Plug it in and switch it on.`);
}
