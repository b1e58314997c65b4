/** A plotter that is stored: a connection with an id, a name and a machine. */
import type { Springs } from "../../src/internal.js";
import type { Plotter, PlotSettings } from "../../src/schema/index.js";
import { PlotterConnection } from "./plotter-connection.js";
import type { PlotterOptions } from "./plotter-state.js";
import type { ManagedPlotter } from "./plotter-port.js";
import type { PlotterRow } from "../storage.js";

/** Id of the first plotter. It is stored with every job, so it must never change. */
export const FIRST_PLOTTER = "main";

interface NamedPlotterOptions extends Pick<PlotterOptions, "clock" | "devices" | "otherBoards"> {
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
  plotter.onChange(() => {
    const { name, connection, message, device } = plotter.snapshot();
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

/** The connection itself, with what is stored about the plotter. */
export class NamedPlotter extends PlotterConnection implements ManagedPlotter {
  readonly id: string;
  private name: string | null;
  private machineId: string | null;

  constructor({ id, name, machine }: Omit<PlotterRow, "device">, options: PlotterOptions) {
    super(options);
    this.id = id;
    this.name = name;
    this.machineId = machine;
  }

  snapshot(): Plotter {
    const name = this.name ?? (this.state.kind === "virtual" ? "Virtual plotter" : "Plotter");
    return { id: this.id, name, machine: this.machineId, ...this.state };
  }

  rename(name: string): void {
    this.name = name;
    this.announce();
  }

  useMachine(machine: string | null, settings: PlotSettings): void {
    this.use(settings);
    this.machineId = machine;
    this.announce();
  }
}
