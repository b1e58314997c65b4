/**
 * Between the queue (which job, which drawing) and the driver (which board): a job's planner goes in,
 * a run comes out. The driver never plans; the planner (a worker thread) never sees the board.
 */
import type { MotionSettings, PenSettings, Place, StrokeSet } from "../../src/index.js";
import type { MachineState, PlannedPlot, PlotProgress } from "../../src/internal.js";
import type { PlotSettings, PlotWait } from "../../src/schema/index.js";

export type { PlannedPlot, PlotProgress } from "../../src/internal.js";

export interface PlanRequest {
  /** Where in the drawing to begin; null for its beginning. */
  readonly from: Place | null;
  /** Stroke before which to stop and go home; null for the end of the drawing. */
  readonly until: number | null;
  /** Where the carriage is, mm from home. */
  readonly startXMm: number;
  readonly startYMm: number;
  /** May differ from the job's first ones: changed while held. */
  readonly settings: PlotSettings;
  readonly firmware: string;
  /** How the machine stands there; left out: at home, with its motors just switched on. */
  readonly board?: MachineState | undefined;
}

/** One prepared drawing, living in a worker thread, ready to be planned from any place. */
export interface PlotPlanner {
  readonly strokes: StrokeSet;
  plan(request: PlanRequest): Promise<PlannedPlot>;
  close(): Promise<void>;
}

export type PlotOutcome = { readonly kind: "done" } | { readonly kind: "cancelled" };

/** A plot under way. `finished` rejects with a PlotwrightError when the board fails. */
export interface PlotRun {
  readonly finished: Promise<PlotOutcome>;
  onProgress(listener: (progress: PlotProgress) => void): void;
  /** `wait`: the stop that it has made by itself; none where somebody asked for the hold. */
  onHeld(listener: (held: boolean, wait?: PlotWait | null) => void): void;
  /** Resolves when the pen is up and the carriage rests. */
  pause(): Promise<void>;
  resume(): Promise<void>;
  /** Lifts, goes home; `finished` then resolves with "cancelled". */
  cancel(): Promise<void>;
}

/** What may be changed while a plot runs or is held; what is not named stays. */
export interface PlotChange {
  readonly pen?: PenSettings | undefined;
  readonly motion?: MotionSettings | undefined;
  /** Of the motion's speeds, drawing and travelling; accelerations stay. 100 = as set. */
  readonly speedPct?: number | undefined;
}

/** Everything that can be asked of a plot under way. */
export interface LivePlotRun extends PlotRun {
  /** Stops at once, without slowing down (ES), then reads back where the motors are; the plot is held. */
  emergencyStop(): Promise<void>;
  /** Takes effect within a second while running, at the hold point while held, by planning only what is left. */
  change(change: PlotChange): Promise<void>;
  /** While held: where the plot goes on from. */
  readonly holdPlace: Place | null;
  /** While held: moves the hold point along the drawing, forward or back; mm run on into the next stroke. */
  moveHoldPlace(by: { readonly strokes?: number | undefined; readonly mm?: number | undefined }): Place;
  /** While held: walks to the hold point with the pen up, to look whether it is the right one. */
  checkHoldPlace(): Promise<void>;
}

/** Where a plot has come to, kept on disk by whoever gives a journal in: enough to go on after a crash. */
export interface JournalEntry {
  /** The first place not drawn yet, at most half a second old. */
  readonly place: Place;
  /** While it draws: the first place that the board has not been given yet. It will draw up to there by itself. */
  readonly sent?: Place | undefined;
  readonly xMm: number;
  readonly yMm: number;
  readonly penUp: boolean;
  readonly elapsedS: number;
}

export interface PlotJournal {
  record(entry: JournalEntry): void;
}

export interface PlotStart {
  /** Where in the drawing to begin: after a crash, the journal's place. Default: its beginning. */
  readonly from?: Place | null | undefined;
  /** The same entry's `sent`. */
  readonly sent?: Place | undefined;
  /** Begins held, with nothing moved: default where `from` is given, so that the user has the word. */
  readonly held?: boolean | undefined;
  readonly journal?: PlotJournal | undefined;
}
