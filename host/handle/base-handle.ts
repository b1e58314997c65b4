/** What both handles share: one plot at a time, the requests to it, and the listeners of the state. */
import { PlotwrightError, type Line } from "../../src/index.js";
import { CurrentPlot, notPlotting } from "./current-plot.js";
import { ProgramsLive, type BegunLive } from "./programs-live.js";
import type {
  HandleState,
  LiveDrawing,
  LiveOptions,
  PlotOptions,
  PlotResult,
  PlotterHandle,
} from "./plotter-handle.js";

export abstract class BaseHandle implements PlotterHandle {
  private readonly listeners = new Set<(state: HandleState) => void>();
  private current: CurrentPlot | null = null;

  abstract get state(): HandleState;
  abstract pen(where: "up" | "down" | number): Promise<void>;
  abstract moveTo(xMm: number, yMm: number): Promise<void>;
  abstract home(): Promise<void>;
  abstract close(): Promise<void>;
  /** Draws it, and tells `plot` how far it is. */
  protected abstract draw(
    drawing: string | readonly Line[],
    options: PlotOptions,
    plot: CurrentPlot,
  ): Promise<PlotResult>;
  /** Begins a live drawing, and tells `plot` how far it is. `ended` settles when the plotter has drawn it. */
  protected abstract beginLive(options: LiveOptions, plot: CurrentPlot): Promise<BegunLive>;
  /** Forgets what `state` says about the plot. */
  protected abstract plotEnded(): void;

  onChange(listener: (state: HandleState) => void): () => void {
    // Each call is ended by its own function, also if the same listener is added twice.
    const own = (state: HandleState): void => listener(state);
    this.listeners.add(own);
    return () => void this.listeners.delete(own);
  }

  async plot(drawing: string | readonly Line[], options: PlotOptions = {}): Promise<PlotResult> {
    return this.follow(options, (current) => this.draw(drawing, options, current));
  }

  async live(options: LiveOptions = {}): Promise<LiveDrawing> {
    return new Promise((resolve, reject) => {
      const ended = this.follow(options, async (current) => {
        const begun = await this.beginLive(options, current);
        resolve(new ProgramsLive(begun.strokes, () => ended));
        return begun.ended;
      });
      // Whoever waits for `end` gets the error; before the drawing has begun, whoever called `live`.
      ended.catch(reject);
    });
  }

  private async follow(
    options: PlotOptions,
    draw: (current: CurrentPlot) => Promise<PlotResult>,
  ): Promise<PlotResult> {
    if (this.current) {
      throw new PlotwrightError("busy", "This program is plotting already: wait until it ends.");
    }
    const current = (this.current = new CurrentPlot(options));
    try {
      return await current.follow(() => draw(current));
    } finally {
      this.current = null;
      this.plotEnded();
      this.announce();
    }
  }

  async pause(): Promise<void> {
    await this.plotting().pause();
  }

  async resume(): Promise<void> {
    await this.plotting().resume();
  }

  async stop(): Promise<void> {
    await this.plotting().stop();
  }

  /** A listener that throws is called no more. Its error stops the plot; without one it is an uncaught error of the program. */
  protected announce(): void {
    const { state, current } = this;
    for (const listener of this.listeners) {
      try {
        listener(state);
      } catch (error) {
        this.listeners.delete(listener);
        if (current !== null) current.fail(error);
        else
          queueMicrotask(() => {
            throw error;
          });
      }
    }
  }

  private plotting(): CurrentPlot {
    if (this.current === null) throw notPlotting();
    return this.current;
  }
}
