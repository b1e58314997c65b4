/** A plotter as the queue, the routes and the command line use it. */
import type { CommandAnswer, HandMove, Plotter, PlotSettings } from "../../src/schema/index.js";
import type { PlotPlanner } from "../planning/plot-planner.js";
import type { LivePlotRun, PlotStart } from "./types.js";

interface PenMove {
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
  plot(planner: PlotPlanner, settings: PlotSettings, start?: PlotStart): Promise<LivePlotRun> | LivePlotRun;
  /** With the machine and heights of `settings`; default: those of the last job or move. */
  pen(request: PenMove, settings?: PlotSettings): Promise<void>;
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
  rename(name: string): void;
  /** Sets the model, with the plotter's settings; null: not set. The board stays connected and home stays the same. */
  useMachine(machine: string | null, settings: PlotSettings): void;
}
