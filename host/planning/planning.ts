/** The planner, as the queue uses it. Drawings are given by the id of a stored drawing. */
import type { JobStats, PlotSettings } from "../../src/schema/index.js";
import type { Requester } from "./lane.js";
import type { PlotPlanner } from "./plot-planner.js";

export interface Measured {
  readonly stats: JobStats;
  readonly warnings: readonly string[];
}

export interface Planning {
  /** `firmware` of the board that will plot it; null: unknown. */
  measure(
    drawing: string,
    settings: PlotSettings,
    firmware: string | null,
    requester?: Requester,
  ): Promise<Measured>;
  open(drawing: string, settings: PlotSettings, signal: AbortSignal): Promise<PlotPlanner>;
}
