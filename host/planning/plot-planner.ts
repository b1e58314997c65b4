/** The planner, as a plotter uses it: a prepared drawing that can be planned from any place. */
import type { Place, StrokeSet } from "../../src/index.js";
import type { MachineState, PlannedPlot } from "../../src/internal.js";
import type { PlotSettings } from "../../src/schema/index.js";

export type { PlannedPlot } from "../../src/internal.js";

export interface PlanRequest {
  /** Where in the drawing to start; null: at its beginning. */
  readonly from: Place | null;
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

/** A prepared drawing in a worker thread. */
export interface PlotPlanner {
  readonly strokes: StrokeSet;
  plan(request: PlanRequest): Promise<PlannedPlot>;
  close(): Promise<void>;
}
