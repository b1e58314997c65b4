/** What the server needs of a plotter's driver; `server/plotter` is what stands behind it. */
import type { Plotter, PlotSettings } from "../../src/schema/index.js";
import type { LivePlotRun, PlotPlanner, PlotStart } from "../plotter/types.js";

export interface PlotterPort {
  readonly id: string;
  snapshot(): Plotter;
  onChange(listener: (plotter: Plotter) => void): void;
  /** Begins a plot; throws `no-board`, `busy` or `board-error` when it can't. */
  plot(planner: PlotPlanner, settings: PlotSettings, start?: PlotStart): Promise<LivePlotRun> | LivePlotRun;
  pen(up: boolean, heightPct?: number): Promise<void>;
  motorsOff(): Promise<void>;
  /** Commands and replies of the present connection. */
  log(): string;
  /** Lifts the pen and walks home. */
  home(): Promise<void>;
  close(): Promise<void>;
}
