/** A plotter and a planner without hardware or threads, controlled by the test. */
import type {
  ManagedPlotter,
  JournalEntry,
  RunningPlot,
  PlotChange,
  PlotOutcome,
  PlotProgress,
  ReportedProgress,
  PlotStart,
} from "../../../host/plotter/plotter-port.js";
import type { Planning } from "../../../host/planning/planning.js";
import type { PlotPlanner } from "../../../host/planning/planning.js";
import type { StrokePosition } from "../../../src/index.js";
import type { CommandAnswer, HandMove, Plotter, PlotSettings, PlotWait } from "../../../src/schema/index.js";
import { makePlotter, STATS } from "./jobs.js";

export class LedRun implements RunningPlot {
  readonly finished: Promise<PlotOutcome>;
  end!: (outcome: PlotOutcome) => void;
  fail!: (error: Error) => void;
  progress: (progress: PlotProgress) => void = () => undefined;
  held: (held: boolean, wait?: PlotWait | null) => void = () => undefined;
  readonly asked: string[] = [];
  /** What `change` was asked for. */
  readonly changes: PlotChange[] = [];
  holdPlace: StrokePosition | null;

  constructor(readonly start: PlotStart) {
    this.holdPlace = start.from ?? null;
    if (start.held === true) this.asked.push("begin held");
    this.finished = new Promise((resolve, reject) => {
      this.end = resolve;
      this.fail = reject;
    });
  }

  onProgress(listener: (report: ReportedProgress) => void): void {
    this.progress = (progress) => listener({ ...progress, atMs: 0, ahead: [] });
  }

  onHeld(listener: (held: boolean, wait?: PlotWait | null) => void): void {
    this.held = listener;
    if (this.start.held === true) listener(true);
  }

  pause(): Promise<void> {
    this.asked.push("pause");
    this.held(true);
    return Promise.resolve();
  }

  /** The driver records how far the pen has come. */
  record(entry: Partial<JournalEntry>): void {
    const place = { stroke: 0, alongMm: 0 };
    this.start.journal?.record({ place, xMm: 0, yMm: 0, penUp: true, elapsedS: 0, ...entry });
  }

  emergencyStop(): Promise<void> {
    this.asked.push("emergency stop");
    this.held(true);
    return Promise.resolve();
  }

  change(change: PlotChange): Promise<void> {
    this.asked.push(`change ${Object.keys(change).join(" ")}`);
    this.changes.push(change);
    return Promise.resolve();
  }

  moveHoldPlace(by: {
    readonly strokes?: number | undefined;
    readonly mm?: number | undefined;
  }): StrokePosition {
    const { stroke = 0, alongMm = 0 } = this.holdPlace ?? {};
    this.holdPlace = { stroke: stroke + (by.strokes ?? 0), alongMm: alongMm + (by.mm ?? 0) };
    return this.holdPlace;
  }

  placeAfter({
    strokes = 0,
    mm = 0,
  }: {
    readonly strokes?: number | undefined;
    readonly mm?: number | undefined;
  }) {
    const { stroke = 0, alongMm = 0 } = this.holdPlace ?? {};
    return { stroke: stroke + strokes, alongMm: alongMm + mm, x: 10, y: 20 };
  }

  checkHoldPlace(): Promise<void> {
    this.asked.push("check place");
    return Promise.resolve();
  }

  movePenAtHold(up: boolean): Promise<void> {
    this.asked.push(up ? "pen up" : "pen down");
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

  interrupt(): Promise<void> {
    this.asked.push("interrupt");
    this.end({ kind: "cancelled" });
    return Promise.resolve();
  }

  leave(): Promise<void> {
    this.asked.push("leave");
    this.end({ kind: "cancelled" });
    return Promise.resolve();
  }
}

export class LedPlotter implements ManagedPlotter {
  readonly id: string;
  readonly runs: LedRun[] = [];
  connection: Plotter["connection"] = "idle";
  firmware: string | null = "2.8.1";
  xMm: number | null = 0;
  heightUnsure = false;
  readonly asked: string[] = [];
  private onRun: (() => void)[] = [];

  private name: string;

  constructor(id = "virtual", name = "Virtual plotter") {
    this.id = id;
    this.name = name;
  }

  snapshot(): Plotter {
    const { connection, firmware, xMm, heightUnsure } = this;
    return makePlotter(this.id, { name: this.name, connection, firmware, xMm, heightUnsure });
  }

  start(): Promise<void> {
    return Promise.resolve();
  }

  settled(): Promise<void> {
    return Promise.resolve();
  }

  onChange(): void {}

  rename(name: string): void {
    this.name = name;
  }

  useMachine(machine: string | null): void {
    this.asked.push(`machine ${machine ?? "usual"}`);
  }

  plot(_planner: PlotPlanner, _settings: PlotSettings, start: PlotStart = {}): LedRun {
    const run = new LedRun(start);
    this.runs.push(run);
    this.onRun.splice(0).forEach((tell) => tell());
    return run;
  }

  /** The current run, or the next one. */
  async nextRun(): Promise<LedRun> {
    const count = this.runs.length;
    if (count === 0) await new Promise<void>((resolve) => this.onRun.push(resolve));
    return this.runs.shift()!;
  }

  pen({ up }: { readonly up: boolean }): Promise<void> {
    this.asked.push(up ? "up" : "down");
    return Promise.resolve();
  }

  stopMove(): Promise<void> {
    this.asked.push("stop");
    return Promise.resolve();
  }
  motorsOff(): Promise<void> {
    this.asked.push("motors off");
    return Promise.resolve();
  }

  log(): string {
    return "V\nEBB";
  }

  move({ kind }: HandMove): Promise<void> {
    this.asked.push(kind);
    return Promise.resolve();
  }

  command(line: string): Promise<CommandAnswer> {
    this.asked.push(line);
    return Promise.resolve({ replies: ["OK"], refused: false, note: null });
  }

  close(): Promise<void> {
    return Promise.resolve();
  }
}

const NO_PLANNER: PlotPlanner = {
  strokes: { xy: new Float64Array(), offsets: new Uint32Array(1), layer: new Uint16Array(), layers: [] },
  plan: () => Promise.reject(new Error("the led plotter plans nothing")),
  close: () => Promise.resolve(),
};

export const LED_PLANNING: Planning = {
  measure: () => Promise.resolve({ stats: STATS, warnings: [] }),
  open: () => Promise.resolve(NO_PLANNER),
};
