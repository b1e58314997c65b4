/** The planner, as the queue uses it, and a prepared drawing, as a plotter uses it. */
import type { JobStats, PlotSettings } from "../../src/schema/index.js";
import type { Requester } from "./lane.js";
import type { StrokePosition, StrokeSet } from "../../src/index.js";
import type { MachineState, PlannedPlot } from "../../src/internal.js";

export interface Measured {
  readonly stats: JobStats;
  readonly warnings: readonly string[];
}

/** Drawings are given by the id of a stored drawing. */
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

export type { PlannedPlot } from "../../src/internal.js";

export interface PlanRequest {
  /** Where in the drawing to start; null: at its beginning. */
  readonly from: StrokePosition | null;
  /** Stroke before which to stop and go home; null: at the end of the drawing. */
  readonly until: number | null;
  /** Position of the carriage, mm from home. */
  readonly startXMm: number;
  readonly startYMm: number;
  /** May differ from the job's original settings, because they can change while the plot is held. */
  readonly settings: PlotSettings;
  readonly firmware: string;
  /** State of the machine at the start; default: at home, with its motors just switched on. */
  readonly board?: MachineState | undefined;
}

/** A prepared drawing in a worker thread, which can be planned from any place. */
export interface PlotPlanner {
  readonly strokes: StrokeSet;
  plan(request: PlanRequest): Promise<PlannedPlot>;
  close(): Promise<void>;
}
