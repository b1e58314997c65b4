/** A plotter that is stored: a plotter driver with an id, a name and a machine. */
import type { Springs } from "../../src/internal.js";
import type { CommandAnswer, HandMove, Plotter, PlotSettings } from "../../src/schema/index.js";
import { PlotterDriver } from "./plotter-driver.js";
import type { PlotterOptions } from "./plotter-state.js";
import type { PlotPlanner } from "../planning/plot-planner.js";
import type { LivePlotRun, PlotStart } from "./types.js";
import type { ManagedPlotter } from "./plotter-port.js";
import type { PlotterRow } from "../storage.js";

/** Id of the first plotter. It is stored with every job, so it must never change. */
export const FIRST_PLOTTER = "main";

interface NamedPlotterOptions extends Pick<PlotterOptions, "clock" | "devices"> {
  readonly virtualSpeed?: number | undefined;
  readonly virtualSprings?: Springs | undefined;
  /** Whether another plotter uses this port. */
  readonly isTaken: (path: string) => boolean;
  /** The plotter's settings, with which it moves before the first job or move. */
  readonly settings: PlotSettings;
  readonly log: (line: string) => void;
}

/**
 * Opens a plotter that connects in the background: a host without a board still shows the queue and the
 * error.
 */
export function openNamedPlotter(row: PlotterRow, options: NamedPlotterOptions): ManagedPlotter {
  const { log, ...parts } = options;
  const plotter = new NamedPlotter(row, { ...parts, device: row.device });
  let last: string | null = null;
  plotter.onChange(({ name, connection, message, device }) => {
    const line = `${name}${device === null ? "" : ` at ${device}`}: ${connection}${message === null ? "" : `. ${message}`}`;
    // It is closed if it is absent without a reason.
    const isClosed = connection === "absent" && message === null;
    if (connection === "busy" || connection === "connecting" || isClosed || line === last) return;
    last = line;
    log(line);
  });
  void plotter.start();
  return plotter;
}

export class NamedPlotter implements ManagedPlotter {
  readonly id: string;
  readonly #driver: PlotterDriver;
  readonly #listeners: ((plotter: Plotter) => void)[] = [];
  #name: string | null;
  #machine: string | null;

  constructor({ id, name, machine }: Omit<PlotterRow, "device">, options: PlotterOptions) {
    this.id = id;
    this.#name = name;
    this.#machine = machine;
    this.#driver = new PlotterDriver(options);
    this.#driver.onChange(() => this.#notify());
  }

  start(): Promise<void> {
    return this.#driver.start();
  }

  snapshot(): Plotter {
    const { state } = this.#driver;
    const name = this.#name ?? (state.kind === "virtual" ? "Virtual plotter" : "Plotter");
    return { id: this.id, name, machine: this.#machine, ...state };
  }

  settled(): Promise<void> {
    return this.#driver.settled();
  }

  rename(name: string): void {
    this.#name = name;
    this.#notify();
  }

  useMachine(machine: string | null, settings: PlotSettings): void {
    this.#driver.use(settings);
    this.#machine = machine;
    this.#notify();
  }

  onChange(listener: (plotter: Plotter) => void): void {
    this.#listeners.push(listener);
  }

  plot(planner: PlotPlanner, settings: PlotSettings, start?: PlotStart): Promise<LivePlotRun> {
    return this.#driver.plot(planner, settings, start);
  }

  pen(up: boolean, heightPct?: number, settings?: PlotSettings): Promise<void> {
    return this.#driver.pen({ up, heightPct }, settings);
  }

  motorsOff(): Promise<void> {
    return this.#driver.motorsOff();
  }

  log(): string {
    return this.#driver.log();
  }

  move(move: HandMove, settings?: PlotSettings): Promise<void> {
    return this.#driver.move(move, settings);
  }

  stopMove(): Promise<void> {
    return this.#driver.stopMove();
  }

  command(line: string): Promise<CommandAnswer> {
    return this.#driver.command(line);
  }

  close(): Promise<void> {
    return this.#driver.close();
  }

  #notify(): void {
    const state = this.snapshot();
    for (const listener of this.#listeners) listener(state);
  }
}
