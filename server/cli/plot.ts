/**
 * `plotwright plot FILE.svg`: plots without a server. The first Ctrl-C holds (Enter goes on), a second one
 * cancels: the pen lifts and the carriage goes home. Without a keyboard to go on with, the first one cancels.
 */
import { SingleBar } from "cli-progress";
import { resolve } from "node:path";
import { PlotwrightError, importDrawing, machineOf } from "../../src/index.js";
import type { PlotSettings } from "../../src/schema/index.js";
import { WorkerPlanner } from "../planning/planner.js";
import type { PlotProgress, PlotRun } from "../plotter/types.js";
import type { CliIo } from "./io.js";
import { withOnlyLayers } from "./layers.js";
import { withPlotter, type DeviceOptions } from "./machine-commands.js";
import { minutes, readDrawing } from "./plan.js";

export interface PlotCommandOptions extends DeviceOptions {
  readonly only?: readonly string[];
}

/** Returns the exit code: 0, or 5 when it was cancelled. Failures are thrown. */
export async function runPlot(
  file: string,
  base: PlotSettings,
  options: PlotCommandOptions,
  io: CliIo,
): Promise<number> {
  const text = readDrawing(file);
  const settings =
    options.only === undefined ? base : withOnlyLayers(importDrawing(file, text), base, options.only);
  const stop = new AbortController();
  const forget = io.onInterrupt(() => stop.abort());
  try {
    const planner = await WorkerPlanner.open(
      { path: resolve(file), settings, machine: machineOf(settings) },
      stop.signal,
    );
    try {
      planner.warnings.forEach((warning) => io.err(`note: ${warning}\n`));
      return await withPlotter(options, settings, async (plotter) => {
        forget();
        const code = await watch(await plotter.plot(planner, settings), io);
        await plotter.motorsOff();
        return code;
      });
    } finally {
      await planner.close();
    }
  } catch (error) {
    if (error instanceof PlotwrightError && error.code === "cancelled" && stop.signal.aborted) {
      return cancelled(io);
    }
    throw error;
  } finally {
    forget();
  }
}

async function watch(run: PlotRun, io: CliIo): Promise<number> {
  const bar = io.isTerminal ? progressBar() : null;
  const control = new Control(run, io);
  const forget = [io.onInterrupt((isFinal) => control.interrupt(isFinal)), io.onLine(() => control.goOn())];
  run.onProgress((progress) => bar?.update(progress.progress * 100, timesOf(progress)));
  try {
    const outcome = await Promise.race([run.finished, control.failed]);
    if (outcome.kind === "cancelled") return cancelled(io);
    bar?.update(100);
    return 0;
  } finally {
    bar?.stop();
    forget.forEach((stop) => stop());
  }
}

/** What the user's keys mean, by what went before. */
class Control {
  readonly #run: PlotRun;
  readonly #io: CliIo;
  #held = false;
  #cancelling = false;
  /** Rejects when a request can't be carried out. */
  readonly failed: Promise<never>;
  #fail: (error: unknown) => void = () => undefined;

  constructor(run: PlotRun, io: CliIo) {
    this.#run = run;
    this.#io = io;
    this.failed = new Promise((_resolve, reject) => (this.#fail = reject));
    this.failed.catch(() => undefined);
  }

  interrupt(isFinal: boolean): void {
    if (this.#cancelling) return;
    if (this.#held || isFinal || !this.#io.hasKeyboard) {
      this.#cancelling = true;
      this.#io.err("\nCancelling: the pen lifts and goes home.\n");
      this.#run.cancel().catch(this.#fail);
    } else {
      this.#held = true;
      this.#io.err("\nHolding. Enter goes on, Ctrl-C again cancels.\n");
      this.#run.pause().catch(this.#fail);
    }
  }

  goOn(): void {
    if (!this.#held || this.#cancelling) return;
    this.#held = false;
    this.#run.resume().catch(this.#fail);
  }
}

function cancelled(io: CliIo): number {
  io.err("plotwright: the plot was cancelled.\n");
  return 5;
}

function progressBar(): SingleBar {
  const bar = new SingleBar({
    format: "{bar} {percentage} %  {elapsed} so far, {left} left",
    barCompleteChar: "█",
    barIncompleteChar: "░",
    hideCursor: true,
  });
  bar.start(100, 0, { elapsed: "00:00:00", left: "…" });
  return bar;
}

const timesOf = (progress: PlotProgress): { elapsed: string; left: string } => ({
  elapsed: minutes(progress.elapsedS),
  left: minutes(progress.remainingS),
});
