/**
 * Between the queue (which job, which drawing) and the driver (which board): a job's planner goes in,
 * a run comes out. The driver never plans; the planner (a worker thread) never sees the board.
 */
import type { BoardState, CommandStream, Place, StrokeSet, Trajectory } from "../../src/index.js";
import type { PlotSettings } from "../../src/schema/index.js";

export interface PlannedPlot {
  readonly trajectory: Trajectory;
  readonly commands: CommandStream;
}

export interface PlanRequest {
  /** Where in the drawing to begin; null for its beginning. */
  readonly from: Place | null;
  /** Where the carriage is, mm from home. */
  readonly startXMm: number;
  readonly startYMm: number;
  /** May differ from the job's first ones: changed while held. */
  readonly settings: PlotSettings;
  readonly firmware: string;
  readonly board: BoardState;
}

/** One prepared drawing, living in a worker thread, ready to be planned from any place. */
export interface PlotPlanner {
  readonly strokes: StrokeSet;
  plan(request: PlanRequest): Promise<PlannedPlot>;
  close(): Promise<void>;
}

export interface PlotProgress {
  /** Of the whole plot's time, 0 … 1. */
  readonly progress: number;
  readonly elapsedS: number;
  readonly remainingS: number;
  /** Seconds along the first, whole trajectory. */
  readonly planS: number;
  readonly xMm: number;
  readonly yMm: number;
  readonly penUp: boolean;
}

export type PlotOutcome = { readonly kind: "done" } | { readonly kind: "cancelled" };

/** A plot under way. `finished` rejects with a PlotwrightError when the board fails. */
export interface PlotRun {
  readonly finished: Promise<PlotOutcome>;
  onProgress(listener: (progress: PlotProgress) => void): void;
  onHeld(listener: (held: boolean) => void): void;
  /** Resolves when the pen is up and the carriage rests. */
  pause(): Promise<void>;
  resume(): Promise<void>;
  /** Lifts, goes home; `finished` then resolves with "cancelled". */
  cancel(): Promise<void>;
}
