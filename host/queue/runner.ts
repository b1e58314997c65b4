/**
 * One plot on one plotter: opens the job's planner, passes it to the driver, and reports events and the
 * outcome. The queue decides about the job from these reports.
 */
import { PlotwrightError, type Place } from "../../src/index.js";
import type { BoardId, PlotSettings, PlotWait } from "../../src/schema/index.js";
import type { PlotPlanner } from "../planning/plot-planner.js";
import type { JournalEntry, LivePlotRun, PlotOutcome, PlotProgress } from "../plotter/types.js";
import type { PlotterPort } from "../plotter/plotter-port.js";

export type RunEnd = PlotOutcome | { readonly kind: "failed"; readonly error: Error };

export interface RunReports {
  progress(progress: PlotProgress): void;
  journal(entry: JournalEntry): void;
  /** `wait`: what it waits for, if it was not held by the user. */
  held(held: boolean, wait: PlotWait | null): void;
  /** A request (pause, resume) that could not be carried out; the plot itself continues. */
  refused(message: string): void;
  /** Something that may be seen on the paper; the plot continues. */
  noted(message: string): void;
  ended(end: RunEnd): void;
}

export interface RunPlan {
  readonly plotter: PlotterPort;
  readonly settings: PlotSettings;
  readonly open: (signal: AbortSignal) => Promise<PlotPlanner>;
  /**
   * Where to start; null: at the beginning of the drawing. A run that starts in the middle is held at first.
   */
  readonly from: Place | null;
  /** The end of what the board had received when that place was stored; undefined if it had drawn nothing more. */
  readonly received: Place | undefined;
  /** The board that drew it up to there. */
  readonly board: BoardId | undefined;
  /** Percent of the speeds in the settings, as it was before an interruption. */
  readonly speedPct: number;
}

export class Runner {
  readonly #plan: RunPlan;
  readonly #reports: RunReports;
  /** Aborted when the plot is cancelled or left. */
  readonly #abort = new AbortController();
  #isLeft = false;
  #run: LivePlotRun | null = null;
  #pauseWanted: boolean;
  /** Settles after `ended` has been reported; never rejects. */
  readonly finished: Promise<void>;

  constructor(plan: RunPlan, reports: RunReports) {
    this.#plan = plan;
    this.#reports = reports;
    this.#pauseWanted = plan.from !== null;
    this.finished = this.#go();
  }

  pause(): void {
    this.#pauseWanted = true;
    if (this.#run !== null) this.#ask(this.#hold(this.#run));
  }

  resume(): void {
    this.#pauseWanted = false;
    if (this.#run !== null) this.#ask(this.#resume(this.#run));
  }

  cancel(): void {
    this.#abort.abort();
    if (this.#run !== null) this.#ask(this.#run.cancel());
  }

  /** Ends the plot because the server stops. A cancelled one is already about to end. */
  leave(): void {
    if (this.isCancelling) return;
    this.#isLeft = true;
    this.#abort.abort();
    if (this.#run !== null) this.#ask(this.#run.leave());
  }

  /** Stops without slowing down. While the plot is still being planned nothing moves, and it is paused. */
  async emergencyStop(): Promise<void> {
    if (this.#run === null) this.pause();
    else await this.#run.emergencyStop();
  }

  /** The running plot, for all other requests; throws `conflict` while it is still being planned. */
  get live(): LivePlotRun {
    if (this.#run !== null) return this.#run;
    throw new PlotwrightError("conflict", "The plot is still being planned: try again in a moment.");
  }

  get isLeft(): boolean {
    return this.#isLeft;
  }

  get isCancelling(): boolean {
    return this.#abort.signal.aborted;
  }

  /**
   * A run that starts in the middle is held before its listeners are added, so the hold is reported here.
   */
  async #hold(run: LivePlotRun): Promise<void> {
    await run.pause();
    if (!this.isCancelling && this.#pauseWanted) this.#reports.held(true, null);
  }

  /** A run that is resumed before it was held does not report a change, so the release is reported here. */
  async #resume(run: LivePlotRun): Promise<void> {
    await run.resume();
    if (!this.#pauseWanted) this.#reports.held(false, null);
  }

  async #go(): Promise<void> {
    const end = await this.#plot().catch((error: unknown): RunEnd => {
      const wanted = this.isCancelling && error instanceof PlotwrightError && error.code === "cancelled";
      return wanted
        ? { kind: "cancelled" }
        : { kind: "failed", error: error instanceof Error ? error : new Error(String(error)) };
    });
    this.#run = null;
    this.#reports.ended(end);
  }

  async #plot(): Promise<PlotOutcome> {
    const { plotter, settings, open, from, received, board, speedPct } = this.#plan;
    // An interrupted plot may have left the pen on the paper. So its planner is opened even after a cancel: cancelling
    // the run then lifts the pen.
    const planner = await open(from === null ? this.#abort.signal : new AbortController().signal);
    try {
      const noted = (message: string): void => this.#reports.noted(message);
      const journal = { record: (entry: JournalEntry) => this.#reports.journal(entry) };
      const run = await plotter.plot(planner, settings, { from, received, board, journal, noted });
      this.#run = run;
      run.onProgress((progress) => this.#reports.progress(progress));
      run.onHeld((held, wait = null) => this.#reports.held(held, wait));
      // Requests that came before the run existed.
      if (this.isCancelling) this.#ask(this.#isLeft ? run.leave() : run.cancel());
      else if (this.#pauseWanted) this.#ask(this.#hold(run));
      else if (from !== null) this.#ask(this.#resume(run));
      if (speedPct !== 100) this.#ask(run.change({ speedPct }));
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
