/** A plotter and a planner without hardware or threads, led by the test. */
import type { PlotterPort } from "../../../server/queue/plotter-port.js";
import type { Planning } from "../../../server/queue/job-queue.js";
import type { PlotOutcome, PlotPlanner, PlotProgress, PlotRun } from "../../../server/plotter/types.js";
import type { Plotter } from "../../../src/schema/index.js";
import { STATS } from "./jobs.js";

export class LedRun implements PlotRun {
  readonly finished: Promise<PlotOutcome>;
  end!: (outcome: PlotOutcome) => void;
  fail!: (error: Error) => void;
  progress: (progress: PlotProgress) => void = () => undefined;
  held: (held: boolean) => void = () => undefined;
  readonly asked: string[] = [];

  constructor() {
    this.finished = new Promise((resolve, reject) => {
      this.end = resolve;
      this.fail = reject;
    });
  }

  onProgress(listener: (progress: PlotProgress) => void): void {
    this.progress = listener;
  }

  onHeld(listener: (held: boolean) => void): void {
    this.held = listener;
  }

  pause(): Promise<void> {
    this.asked.push("pause");
    this.held(true);
    return Promise.resolve();
  }

  resume(): Promise<void> {
    this.asked.push("resume");
    this.held(false);
    return Promise.resolve();
  }

  cancel(): Promise<void> {
    this.asked.push("cancel");
    this.end({ kind: "cancelled" });
    return Promise.resolve();
  }
}

export class LedPlotter implements PlotterPort {
  readonly id: string;
  readonly runs: LedRun[] = [];
  connection: Plotter["connection"] = "idle";
  readonly asked: string[] = [];
  #onRun: (() => void)[] = [];

  constructor(id = "virtual") {
    this.id = id;
  }

  snapshot(): Plotter {
    return {
      id: this.id,
      name: "Virtual plotter",
      kind: "virtual",
      device: null,
      connection: this.connection,
      firmware: "2.8.1",
      message: null,
      penUp: true,
      motorsOn: false,
      xMm: 0,
      yMm: 0,
    };
  }

  onChange(): void {}

  plot(): PlotRun {
    const run = new LedRun();
    this.runs.push(run);
    this.#onRun.splice(0).forEach((tell) => tell());
    return run;
  }

  /** The run that has begun, or that begins next. */
  async nextRun(): Promise<LedRun> {
    const count = this.runs.length;
    if (count === 0) await new Promise<void>((resolve) => this.#onRun.push(resolve));
    return this.runs.shift()!;
  }

  pen(up: boolean): Promise<void> {
    this.asked.push(up ? "up" : "down");
    return Promise.resolve();
  }

  motorsOff(): Promise<void> {
    this.asked.push("motors off");
    return Promise.resolve();
  }

  home(): Promise<void> {
    this.asked.push("home");
    return Promise.resolve();
  }

  close(): Promise<void> {
    return Promise.resolve();
  }
}

export const NO_PLANNER: PlotPlanner = {
  strokes: { xy: new Float64Array(), offsets: new Uint32Array(1), layer: new Uint16Array(), layers: [] },
  plan: () => Promise.reject(new Error("the led plotter plans nothing")),
  close: () => Promise.resolve(),
};

export const LED_PLANNING: Planning = {
  measure: () => Promise.resolve({ stats: STATS, warnings: [] }),
  open: () => Promise.resolve(NO_PLANNER),
};
