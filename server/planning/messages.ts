/** Messages between the planner (main thread) and its worker. Large arrays are transferred, not copied. */
import { PlotwrightError, type ErrorCode, type MachineProfile, type StrokeSet } from "../../src/index.js";
import type { JobStats, PlotSettings } from "../../src/schema/index.js";
import type { PlanRequest, PlannedPlot } from "../../host/planning/plot-planner.js";

/** Passed to the worker when it starts. It prepares the drawing at once and answers "ready". */
export interface WorkerInput {
  /** The drawing's file. The worker reads it, so that its text never passes through the main thread. */
  readonly path: string;
  readonly settings: PlotSettings;
  readonly machine: MachineProfile;
  /** Names of the layers to draw; default: all. */
  readonly only?: readonly string[] | undefined;
}

export type ToWorker =
  | { readonly type: "plan"; readonly id: number; readonly request: PlanRequest }
  /** `firmware` of the board that will plot it; null: unknown. */
  | { readonly type: "measure"; readonly id: number; readonly firmware: string | null };

export type FromWorker =
  /** The file has been read. */
  | { readonly type: "imported" }
  | { readonly type: "ready"; readonly strokes: StrokeSet; readonly warnings: readonly string[] }
  | { readonly type: "planned"; readonly id: number; readonly plot: PlannedPlot }
  | {
      readonly type: "measured";
      readonly id: number;
      readonly stats: JobStats;
      readonly warnings: readonly string[];
    }
  /** `id` null: the drawing itself could not be prepared. */
  | ({ readonly type: "failed"; readonly id: number | null } & Fault);

/** An error as sent between threads. */
export interface Fault {
  readonly code: ErrorCode;
  readonly message: string;
}

export function faultOf(error: unknown): Fault {
  if (error instanceof PlotwrightError) return { code: error.code, message: error.message };
  return { code: "internal", message: error instanceof Error ? error.message : String(error) };
}
