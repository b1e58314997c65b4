/** What the server needs of a plotter's driver; `server/plotter` is what stands behind it. */
import type { CommandAnswer, Plotter, PlotSettings } from "../../src/schema/index.js";
import type { HandMove } from "../plotter/hand-moves.js";
import type { LivePlotRun, PlotPlanner, PlotStart } from "../plotter/types.js";

export interface PlotterPort {
  readonly id: string;
  snapshot(): Plotter;
  /** Resolves when it is known whether its board is there: at once, but while it is connecting. */
  settled(): Promise<void>;
  onChange(listener: (plotter: Plotter) => void): void;
  /** Begins a plot; throws `no-board`, `busy` or `board-error` when it can't. */
  plot(planner: PlotPlanner, settings: PlotSettings, start?: PlotStart): Promise<LivePlotRun> | LivePlotRun;
  pen(up: boolean, heightPct?: number): Promise<void>;
  motorsOff(): Promise<void>;
  /** A move by hand with the machine, speeds and heights of `settings`; left out: of the last job or move. */
  move(move: HandMove, settings?: PlotSettings): Promise<void>;
  /** One line to the board, with all that it answers. */
  command(line: string): Promise<CommandAnswer>;
  /** Commands and replies of the present connection. */
  log(): string;
  close(): Promise<void>;
}

/** A plotter that the server keeps under a name of the user's. */
export interface ManagedPlotter extends PlotterPort {
  rename(name: string): void;
  /** Another machine for moves by hand; null: the usual one. It stays connected, and home where it is. */
  useMachine(machine: string | null): void;
}
