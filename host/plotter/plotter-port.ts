/**
 * A plotter and a running plot, as the queue, the routes and the command line use them.
 *
 * The queue knows jobs and drawings, the plotter knows the board. The plotter is given a planner and returns a run. It never
 * plans; the planner (a worker thread) never accesses the board.
 */
import type {
  CommandAnswer,
  HandMove,
  Plotter,
  PlotSettings,
  BoardId,
  PlotWait,
} from "../../src/schema/index.js";
import type { LiveStrokes } from "./live-strokes.js";
import type { PlotPlanner } from "../planning/planning.js";
import type { MotionSettings, PenSettings, StrokePosition } from "../../src/index.js";
import type { PenMoment, PlotProgress } from "../../src/internal.js";

interface PenTarget {
  readonly up: boolean;
  /** Default: the height in the settings. */
  readonly heightPct?: number | undefined;
}

export interface PlotterPort {
  readonly id: string;
  snapshot(): Plotter;
  /** Resolves when it is known whether the board is connected: immediately, unless it is still connecting. */
  settled(): Promise<void>;
  /** Called after each change of `snapshot`. */
  onChange(listener: () => void): void;
  /** Starts a plot; throws `no-board`, `busy` or `board-error` if it can't. */
  plot(planner: PlotPlanner, settings: PlotSettings, start?: PlotStart): Promise<RunningPlot> | RunningPlot;
  /** With the machine and heights of `settings`; default: those of the last job or move. */
  pen(request: PenTarget, settings?: PlotSettings): Promise<void>;
  motorsOff(): Promise<void>;
  /**
   * A manual move with the machine, speeds and heights of `settings`; default: those of the last job or move.
   */
  move(move: HandMove, settings?: PlotSettings): Promise<void>;
  /** Stops a manual move at once, which then rejects with `conflict`. Resolves when the pen is up. */
  stopMove(): Promise<void>;
  /** Sends one line to the board; returns the complete answer. */
  command(line: string): Promise<CommandAnswer>;
  /** Commands and replies of the current connection. */
  log(): string;
  close(): Promise<void>;
}

/** A plotter that is stored by the server and that the user can rename. */
export interface ManagedPlotter extends PlotterPort {
  /** Connects now: it is not connected yet, or has lost its board. Resolves when it is known whether that works. */
  start(): Promise<void>;
  rename(name: string): void;
  /** Sets the model, with the plotter's settings; null: not set. The board stays connected and home stays the same. */
  useMachine(machine: string | null, settings: PlotSettings): void;
}

export type { PlotProgress } from "../../src/internal.js";

/** The progress of a plot, and where the pen goes next, so that a page can show it moving between two reports. */
export interface ReportedProgress extends PlotProgress {
  /** This computer's time, ms from an arbitrary start. */
  readonly atMs: number;
  /** The pen every `AHEAD_STEP_MS` from then, as far as motion is sent that only a stop can change. */
  readonly ahead: readonly PenMoment[];
}

export type PlotOutcome = { readonly kind: "done" } | { readonly kind: "cancelled" };

/** A running plot. `finished` rejects with a PlotwrightError when the board fails. */
export interface PlotControl {
  readonly finished: Promise<PlotOutcome>;
  onProgress(listener: (report: ReportedProgress) => void): void;
  /** `wait`: what the plot waits for if it stopped by itself; none if the hold was requested. */
  onHeld(listener: (held: boolean, wait?: PlotWait | null) => void): void;
  /** Resolves when the pen is up and the carriage has stopped. */
  pause(): Promise<void>;
  resume(): Promise<void>;
  /** Lifts the pen and goes home; `finished` then resolves with "cancelled". */
  cancel(): Promise<void>;
  /**
   * Ends the plot where it is, so that it can be resumed later: slows down, lifts the pen, and writes the place to the
   * journal. Nothing else moves, and no planning is waited for. `finished` then resolves with "cancelled".
   */
  interrupt(): Promise<void>;
}

/** Changes to a plot that is running or held; omitted fields stay the same. */
export interface PlotChange {
  readonly pen?: PenSettings | undefined;
  readonly motion?: MotionSettings | undefined;
  /** Percent of the drawing and travel speeds in the settings; accelerations stay the same. */
  readonly speedPct?: number | undefined;
}

/** All operations on a running plot. */
export interface RunningPlot extends PlotControl {
  /** Ends the plot because the server stops. Like `cancel`, but nothing moves if the plot is held or was stopped at once. */
  leave(): Promise<void>;
  /** Stops at once, without slowing down (ES), then reads back the motor positions; the plot is then held. */
  emergencyStop(): Promise<void>;
  /**
   * Re-plans the rest of the drawing. Takes effect within a second while running, at the hold point while
   * held.
   */
  change(change: PlotChange): Promise<void>;
  /** While held: the place from which the plot will resume. */
  readonly holdPlace: StrokePosition | null;
  /**
   * While held: moves the hold point along the drawing, forward or back; mm may continue into the next
   * stroke.
   */
  moveHoldPlace(by: {
    readonly strokes?: number | undefined;
    readonly mm?: number | undefined;
  }): StrokePosition;
  /** While held: where such a move would lead, and the point of the drawing there, mm. */
  placeAfter(by: {
    readonly strokes?: number | undefined;
    readonly mm?: number | undefined;
  }): StrokePosition & { readonly x: number; readonly y: number };
  /** While held: moves to the hold point with the pen up, so that the user can check it. */
  checkHoldPlace(): Promise<void>;
  /** While held: lifts the pen, or lowers it to the height of the layer that comes next. It is lifted before anything moves. */
  movePenAtHold(up: boolean): Promise<void>;
}

/**
 * The progress of a plot, which the owner of the journal stores, so that the plot can continue after a crash.
 */
export interface JournalEntry {
  /** The first place not yet drawn, at most half a second old. */
  readonly place: StrokePosition;
  /**
   * The end of what the board had received, and draws even if this program ends. Undefined if the plot is at rest, or is
   * still on its way to `place`: it had then received nothing that draws after `place`.
   */
  readonly received?: StrokePosition | undefined;
  /** How much more motion may have been sent until the next entry (`sentAheadS`), in the machine's seconds. */
  readonly aheadS?: number | undefined;
  /** The run of the plot that wrote this: a machine found in the middle of another run says nothing about the place. */
  readonly run?: number | undefined;
  /** Where the carriage was then. */
  readonly xMm: number;
  readonly yMm: number;
  readonly penUp: boolean;
  readonly elapsedS: number;
  /** The board that draws; the plotter adds it. The position of any other board says nothing about this plot. */
  readonly board?: BoardId | undefined;
}

interface PlotJournal {
  record(entry: JournalEntry): void;
}

/** What a journal entry says beside its place, for a plot that starts there. By default nothing was drawn after the place. */
export type StoppedAt = {
  readonly [Key in "received" | "aheadS" | "run" | "xMm" | "yMm" | "board"]?: JournalEntry[Key] | undefined;
};

export interface PlotStart extends StoppedAt {
  /** The drawing is drawn while these strokes are still being added; the planner is `livePlanner` of them. */
  readonly live?: LiveStrokes | undefined;
  /** Where in the drawing to start; after a crash, the journal's place. Default: the beginning. */
  readonly from?: StrokePosition | null | undefined;
  /** Start held, without moving. Default true if `from` is set, so that the user decides when to continue. */
  readonly held?: boolean | undefined;
  readonly journal?: PlotJournal | undefined;
  /** Called with words for the user about something that may be seen on the paper; the plot continues. */
  readonly noted?: ((message: string) => void) | undefined;
}
