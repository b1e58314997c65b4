/** The plotters of one server, as the queue and the routes see them. */
import { PlotwrightError } from "../src/index.js";
import type { Plotter, PlotSettings } from "../src/schema/index.js";
import { PlotterDriver, type PlotterOptions } from "./plotter/plotter.js";
import type { LivePlotRun, PlotPlanner, PlotStart } from "./plotter/types.js";
import type { PlotterPort } from "./queue/plotter-port.js";

export interface DeviceChoice {
  /** Serial path, "virtual", or nothing: the first EiBotBoard, else the virtual board. */
  readonly device?: string | undefined;
  readonly virtualSpeed?: number | undefined;
}

/** Kept with every job, so it must never change. */
const FIRST_PLOTTER = "main";

/** Connects in the background: a server without its board still shows the queue and says what is wrong. */
export function openPlotters(
  choice: DeviceChoice,
  log: (line: string) => void,
): ReadonlyMap<string, PlotterPort> {
  const plotter = new DrivenPlotter(FIRST_PLOTTER, choice);
  let last: string | null = null;
  plotter.onChange(({ connection, message, device }) => {
    const line = `${device ?? "plotter"}: ${connection}${message === null ? "" : `. ${message}`}`;
    if (connection === "busy" || connection === "connecting" || line === last) return;
    last = line;
    log(line);
  });
  void plotter.start();
  return new Map([[plotter.id, plotter]]);
}

/** One plotter, connected, for a command; throws `no-board` when it can't be. */
export async function openPlotter(choice: DeviceChoice): Promise<PlotterPort> {
  const plotter = new DrivenPlotter(FIRST_PLOTTER, choice);
  await plotter.start();
  const { connection, message } = plotter.snapshot();
  if (connection === "idle") return plotter;
  await plotter.close();
  throw new PlotwrightError("no-board", message ?? "The plotter can't be reached.");
}

class DrivenPlotter implements PlotterPort {
  readonly id: string;
  readonly #driver: PlotterDriver;

  constructor(id: string, choice: DeviceChoice) {
    this.id = id;
    const options: PlotterOptions = { device: choice.device ?? "auto", virtualSpeed: choice.virtualSpeed };
    this.#driver = new PlotterDriver(options);
  }

  start(): Promise<void> {
    return this.#driver.start();
  }

  snapshot(): Plotter {
    const { state } = this.#driver;
    return { id: this.id, name: state.kind === "virtual" ? "Virtual plotter" : "Plotter", machine: null, ...state };
  }

  onChange(listener: (plotter: Plotter) => void): void {
    this.#driver.onChange(() => listener(this.snapshot()));
  }

  plot(planner: PlotPlanner, settings: PlotSettings, start?: PlotStart): Promise<LivePlotRun> {
    return this.#driver.plot(planner, settings, start);
  }

  pen(up: boolean, heightPct?: number): Promise<void> {
    return this.#driver.pen({ up, heightPct });
  }

  motorsOff(): Promise<void> {
    return this.#driver.motorsOff();
  }

  log(): string {
    return this.#driver.log();
  }

  home(): Promise<void> {
    return this.#driver.home();
  }

  close(): Promise<void> {
    return this.#driver.close();
  }
}
