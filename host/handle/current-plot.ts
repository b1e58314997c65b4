/** The plot that a program has started with a handle: from the call of `plot` on, also while it is read, sent and planned. */
import { PlotwrightError } from "../../src/index.js";
import type { PlotWait } from "../../src/schema/index.js";
import type { PlotAmount, PlotOptions, PlotResult } from "./plotter-handle.js";

/** A plot that has begun, as a handle controls it. */
export interface BegunPlot {
  pause(): Promise<void>;
  resume(): Promise<void>;
  /** Asks the plotter to stop. */
  cancel(): Promise<void>;
}

export class CurrentPlot {
  private begun: BegunPlot | null = null;
  private isStopped = false;
  private failure: { readonly error: unknown } | null = null;
  private hasEnded = false;
  private readonly waiters = new Set<() => void>();

  constructor(private readonly options: PlotOptions) {
    options.signal?.addEventListener("abort", this.onAbort);
    if (options.signal?.aborted === true) this.isStopped = true;
  }

  /** The plot from its begin to its end. An error of the program's own callbacks counts more than how the plot ended. */
  async follow(draw: () => Promise<PlotResult>): Promise<PlotResult> {
    let result: PlotResult;
    try {
      result = await draw();
    } catch (error) {
      throw this.failure === null ? error : this.failure.error;
    } finally {
      this.hasEnded = true;
      this.options.signal?.removeEventListener("abort", this.onAbort);
      this.wake();
    }
    if (this.failure !== null) throw this.failure.error;
    return result;
  }

  /** Throws if the plot was stopped before it has begun. */
  throwIfStopped(): void {
    if (this.isStopped) throw stopped();
  }

  begin(plot: BegunPlot): void {
    this.begun = plot;
    this.wake();
    if (this.isStopped) void plot.cancel().catch(() => undefined);
  }

  async pause(): Promise<void> {
    await (await this.untilBegun()).pause();
  }

  async resume(): Promise<void> {
    await (await this.untilBegun()).resume();
  }

  /** Resolves when the plot has ended. */
  async stop(): Promise<void> {
    this.isStopped = true;
    await this.begun?.cancel();
    await this.until(() => this.hasEnded);
  }

  /** Stops the plot, which then rejects with `error`. */
  fail(error: unknown): void {
    this.failure ??= { error };
    void this.stop().catch(() => undefined);
  }

  tellProgress(amount: PlotAmount): void {
    if (this.failure !== null) return;
    try {
      this.options.onProgress?.(amount);
    } catch (error) {
      this.fail(error);
    }
  }

  /** Resumes when the program says that the pen is changed. */
  async changePen(wait: PlotWait): Promise<void> {
    if (this.options.onPenChange === undefined) return;
    try {
      await this.options.onPenChange(wait);
      if (!this.isStopped && !this.hasEnded) await this.resume();
    } catch (error) {
      this.fail(error);
    }
  }

  private async untilBegun(): Promise<BegunPlot> {
    await this.until(() => this.begun !== null || this.hasEnded);
    if (this.begun === null || this.hasEnded) throw notPlotting();
    return this.begun;
  }

  private async until(isTrue: () => boolean): Promise<void> {
    while (!isTrue()) await new Promise<void>((resolve) => void this.waiters.add(resolve));
  }

  private wake(): void {
    for (const resolve of this.waiters) resolve();
    this.waiters.clear();
  }

  private readonly onAbort = (): void => void this.stop().catch(() => undefined);
}

export const stopped = (): PlotwrightError => new PlotwrightError("cancelled", "The plot was stopped.");

export const notPlotting = (): PlotwrightError =>
  new PlotwrightError("conflict", "This program is not plotting: start a plot first.");

export const closed = (): PlotwrightError =>
  new PlotwrightError("disconnected", "This plotter was closed: open it again with openPlotter.");
