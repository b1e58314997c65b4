/** Messages between the planner and its worker thread. Large arrays are transferred, not copied. */
import { PlotwrightError, type ErrorCode, type StrokeSet } from "../../src/index.js";
import type { DrawnSize } from "../../src/internal.js";
import type { Measured, PlanRequest, PlannedPlot } from "./planning.js";

/** A drawing that is prepared for planning. */
export interface ReadyDrawing {
  readonly strokes: StrokeSet;
  /** The drawing's size on the paper. */
  readonly size: DrawnSize;
  /** Warnings, for example about features of the file that are not drawn. */
  readonly warnings: readonly string[];
}

export type ToWorker =
  | { readonly type: "plan"; readonly id: number; readonly request: PlanRequest }
  /** `firmware` of the board that will plot it; null: unknown. */
  | { readonly type: "measure"; readonly id: number; readonly firmware: string | null };

export type FromWorker =
  /** The file has been read. */
  | { readonly type: "imported" }
  | ({ readonly type: "ready" } & ReadyDrawing)
  | { readonly type: "planned"; readonly id: number; readonly plot: PlannedPlot }
  | ({ readonly type: "measured"; readonly id: number } & Measured)
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
