/** A plotter that this program connects to: real, or the virtual one. */
import { importDrawing, PlotwrightError, type Clock, type Line } from "../../src/index.js";
import { controllerOf, machineOf, prepareJob } from "../../src/internal.js";
import {
  DEFAULT_PLOT_SETTINGS,
  givenSettingsSchema,
  machineProfileSchema,
  type GivenSettings,
  type PlotSettings,
  type PlotWait,
} from "../../src/schema/index.js";
import { parseWith } from "../parse-with.js";
import type { PlotPlanner } from "../planning/planning.js";
import { planAndCompile } from "../planning/stages.js";
import type { Devices } from "../plotter/devices.js";
import { FIRST_PLOTTER, NamedPlotter } from "../plotter/named-plotter.js";
import type { PlotProgress, PlotterPort, RunningPlot } from "../plotter/plotter-port.js";
import {
  settingsOfPlotter,
  settingsWith,
  type SettingsOfPlotter,
  type WithMachine,
} from "../plotter/settings-of-plotter.js";
import { livePlanner, LiveStrokes } from "../plotter/live-strokes.js";
import { BaseHandle } from "./base-handle.js";
import { type CurrentPlot, stopped } from "./current-plot.js";
import type { BegunLive } from "./programs-live.js";
import {
  fileOf,
  givenOf,
  liftAfterMsOf,
  penTarget,
  positionOf,
  type HandleState,
  type LiveOptions,
  type PlotOptions,
  type PlotResult,
  type PlotterHandle,
} from "./plotter-handle.js";

/** What the host program has: the clock, and the serial ports. */
export interface ClockAndPorts {
  readonly clock: Clock;
  readonly devices: Devices;
}

export interface PortChoice {
  /** "auto", "virtual", or the path of a serial port. Default "auto". */
  readonly device?: string | undefined;
  readonly virtualSpeed?: number | undefined;
}

/**
 * Connects to one plotter. Throws `no-board` if that fails, `bad-setting` for an unknown machine. It never falls back to
 * the virtual board: a program that silently draws nothing would look as if it had worked.
 */
export async function connectPlotter(
  { device = "auto", virtualSpeed }: PortChoice,
  settings: PlotSettings,
  parts: ClockAndPorts,
): Promise<PlotterPort> {
  // Throws for an unknown machine, which the plotter would report as a board that can't be reached.
  const machine = machineOf(settings);
  const plotter = new NamedPlotter(
    { id: FIRST_PLOTTER, name: null, machine: null },
    { device, virtualSpeed, virtualIfNone: false, settings, ...parts },
  );
  await plotter.start();
  const { connection, message } = plotter.snapshot();
  if (connection === "idle") return plotter;
  await plotter.close();
  if (connection === "absent" && device === "auto" && controllerOf(machine).usbIds.length > 0) {
    throw new PlotwrightError("no-board", NOT_PLUGGED_IN);
  }
  throw new PlotwrightError("no-board", message ?? "The plotter can't be reached.");
}

export const NOT_PLUGGED_IN = "No plotter is plugged in: check its USB cable and its power.";

/** As `connectPlotter`, as a handle. `given`: what every plot and move starts from. */
export async function openOwnPlotter(
  connection: PortChoice,
  given: GivenSettings,
  parts: ClockAndPorts,
): Promise<PlotterHandle> {
  const checked = parseWith(givenSettingsSchema, given);
  const customMachine = checked.customMachine ? machineProfileSchema.parse(checked.customMachine) : null;
  const withMachine = (settings: PlotSettings): PlotSettings => ({ ...settings, customMachine });
  const { machine = customMachine?.id ?? DEFAULT_PLOT_SETTINGS.machine } = checked;
  const model = settingsOfPlotter({ machine, own: undefined, last: undefined }, withMachine);
  const { settings } = settingsWith(model, { ...checked, machine }, withMachine);
  const plotter = await connectPlotter(connection, settings, parts);
  return new OwnHandle(plotter, { ...model, settings }, withMachine);
}

class OwnHandle extends BaseHandle {
  private progress: PlotProgress | null = null;
  private wait: PlotWait | null = null;

  constructor(
    private readonly plotter: PlotterPort,
    private readonly base: SettingsOfPlotter,
    private readonly withMachine: WithMachine,
  ) {
    super();
    plotter.onChange(() => this.announce());
  }

  get state(): HandleState {
    const { kind, connection, activity, firmware, message, penUp, xMm, yMm } = this.plotter.snapshot();
    const { progress, wait } = this;
    return { kind, connection, activity, firmware, message, penUp, xMm, yMm, plot: progress, wait };
  }

  protected async draw(
    drawing: string | readonly Line[],
    options: PlotOptions,
    current: CurrentPlot,
  ): Promise<PlotResult> {
    const { name = "drawing" } = options;
    const { settings, note } = settingsWith(this.base, givenOf(options), this.withMachine);
    const machine = machineOf(settings);
    const imported = await importDrawing(name, fileOf(drawing, settings));
    const { prepared, warnings } = prepareJob(imported, settings, machine);
    current.throwIfStopped();
    const planner: PlotPlanner = {
      strokes: prepared.strokes,
      plan: (request) => Promise.resolve(planAndCompile(prepared, request, machine)),
      close: () => Promise.resolve(),
    };
    const run = await this.plotter.plot(planner, settings);
    return this.ended(run, current, note === null ? warnings : [...warnings, note]);
  }

  protected async beginLive(options: LiveOptions, current: CurrentPlot): Promise<BegunLive> {
    const { settings, note } = settingsWith(this.base, givenOf(options), this.withMachine);
    const strokes = new LiveStrokes(machineOf(settings), liftAfterMsOf(options));
    current.throwIfStopped();
    const run = await this.plotter.plot(livePlanner(strokes), settings, { live: strokes });
    const ended = this.ended(run, current, note === null ? [] : [note]);
    ended.catch((error: unknown) => strokes.fail(error instanceof Error ? error : new Error(String(error))));
    return { strokes, ended };
  }

  /** Follows a plot to its end. */
  private async ended(
    run: RunningPlot,
    current: CurrentPlot,
    warnings: readonly string[],
  ): Promise<PlotResult> {
    run.onProgress((progress) => {
      this.progress = progress;
      current.tellProgress(progress);
      this.announce();
    });
    run.onHeld((_isHeld, wait = null) => {
      this.wait = wait;
      this.announce();
      if (wait !== null) void current.changePen(wait);
    });
    current.begin(run);
    const { kind } = await run.finished;
    if (kind === "cancelled") throw stopped();
    return { plottedS: this.progress?.elapsedS ?? 0, warnings };
  }

  protected plotEnded(): void {
    this.progress = this.wait = null;
  }

  async pen(where: "up" | "down" | number): Promise<void> {
    await this.plotter.pen(penTarget(where), this.base.settings);
  }

  async moveTo(xMm: number, yMm: number): Promise<void> {
    await this.plotter.move({ kind: "move-to", ...positionOf(xMm, yMm) }, this.base.settings);
  }

  async home(): Promise<void> {
    await this.plotter.move({ kind: "home" }, this.base.settings);
  }

  async close(): Promise<void> {
    await this.plotter.close();
  }
}
