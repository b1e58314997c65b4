/**
 * One plotter's run: opens the job's planner, gives it to the driver, and reports what becomes of it.
 * It decides nothing about jobs; the queue does, from these reports.
 */
import { PlotwrightError } from "../../src/index.js";
import type { PlotSettings } from "../../src/schema/index.js";
import type { PlotOutcome, PlotPlanner, PlotProgress, PlotRun } from "../plotter/types.js";
import type { PlotterPort } from "./plotter-port.js";

export type OpenPlanner = (signal: AbortSignal) => Promise<PlotPlanner>;

export type RunEnd = PlotOutcome | { readonly kind: "failed"; readonly error: Error };

export interface RunReports {
  progress(progress: PlotProgress): void;
  held(held: boolean): void;
  /** A request (pause, resume) that could not be carried out; the plot itself goes on. */
  refused(message: string): void;
  ended(end: RunEnd): void;
}

export class Runner {
  readonly #plotter: PlotterPort;
  readonly #settings: PlotSettings;
  readonly #open: OpenPlanner;
  readonly #reports: RunReports;
  readonly #abort = new AbortController();
  #run: PlotRun | null = null;
  #pauseWanted = false;
  /** Settles after `ended` has been reported; never rejects. */
  readonly finished: Promise<void>;

  constructor(plotter: PlotterPort, settings: PlotSettings, open: OpenPlanner, reports: RunReports) {
    this.#plotter = plotter;
    this.#settings = settings;
    this.#open = open;
    this.#reports = reports;
    this.finished = this.#go();
  }

  pause(): void {
    this.#pauseWanted = true;
    if (this.#run !== null) this.#ask(this.#run.pause());
  }

  resume(): void {
    this.#pauseWanted = false;
    if (this.#run !== null) this.#ask(this.#run.resume());
  }

  cancel(): void {
    this.#abort.abort();
    if (this.#run !== null) this.#ask(this.#run.cancel());
  }

  async #go(): Promise<void> {
    const end = await this.#plot().catch((error: unknown): RunEnd => {
      const wanted =
        this.#abort.signal.aborted && error instanceof PlotwrightError && error.code === "cancelled";
      return wanted
        ? { kind: "cancelled" }
        : { kind: "failed", error: error instanceof Error ? error : new Error(String(error)) };
    });
    this.#reports.ended(end);
  }

  async #plot(): Promise<PlotOutcome> {
    const planner = await this.#open(this.#abort.signal);
    try {
      const run = await this.#plotter.plot(planner, this.#settings);
      this.#run = run;
      run.onProgress((progress) => this.#reports.progress(progress));
      run.onHeld((held) => this.#reports.held(held));
      // Wishes from the time when there was only a planner.
      if (this.#abort.signal.aborted) this.#ask(run.cancel());
      else if (this.#pauseWanted) this.#ask(run.pause());
      return await run.finished;
    } finally {
      await planner.close();
    }
  }

  #ask(request: Promise<void>): void {
    request.catch((error: unknown) => {
      if (this.#run !== null) this.#reports.refused(error instanceof Error ? error.message : String(error));
    });
  }
}
