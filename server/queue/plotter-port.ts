/** What the server needs of a plotter's driver; `server/plotter` is what stands behind it. */
import type { Plotter, PlotSettings } from "../../src/schema/index.js";
import type { PlotPlanner, PlotRun } from "../plotter/types.js";

export interface PlotterPort {
  readonly id: string;
  snapshot(): Plotter;
  onChange(listener: (plotter: Plotter) => void): void;
  /** Begins a plot; throws `no-board`, `busy` or `board-error` when it can't. */
  plot(planner: PlotPlanner, settings: PlotSettings): Promise<PlotRun> | PlotRun;
  pen(up: boolean, heightPct?: number): Promise<void>;
  motorsOff(): Promise<void>;
  /** Lifts the pen and walks home. */
  home(): Promise<void>;
  close(): Promise<void>;
}
