/**
 * One plot on a carriage: plan, stream, and what the user asks of it on the way.
 *
 *              ┌────────────── resume: plan what is left ───────────────┐
 *   plan ──> streaming ──pause──> comes to rest, pen up ──> held ───────┘
 *               │  └──cancel──> comes to rest, pen up ──> walks home ──> cancelled
 *               └──> done
 */
import {
  PlotwrightError,
  stateAt,
  strokeCount,
  type MotionState,
  type Place,
  type Streamer,
  type StreamReport,
  type Trajectory,
} from "../../src/index.js";
import type { PlotSettings } from "../../src/schema/index.js";
import type { Carriage } from "./carriage.js";
import { isPenUpBefore, machineOf, nextPlace, nextRestIndex, PlaceTimes } from "./plan-places.js";
import type { PlannedPlot, PlotOutcome, PlotPlanner, PlotProgress, PlotRun } from "./types.js";

/** Between two reports of progress, seconds of ours. */
const PROGRESS_S = 0.06;

type Wish = "run" | "hold" | "cancel";

export class CarriageRun implements PlotRun {
  readonly finished: Promise<PlotOutcome>;

  private wish: Wish = "run";
  private held = false;
  private playing: { readonly streamer: Streamer; readonly plot: PlannedPlot } | null = null;
  private wakeWisher: (() => void) | null = null;
  private readonly heldListeners: ((held: boolean) => void)[] = [];
  private readonly progressListeners: ((progress: PlotProgress) => void)[] = [];
  /** Called when a pause, resume or cancel has taken effect, or the run has ended. */
  private waiters: { until: () => boolean; resolve: () => void; reject: (error: Error) => void }[] = [];
  private ended: Error | true | null = null;

  private first: { readonly trajectory: Trajectory; readonly times: PlaceTimes } | null = null;
  private elapsedBeforeS = 0;
  private readonly motion: MotionState = {
    x: 0,
    y: 0,
    vx: 0,
    vy: 0,
    ax: 0,
    ay: 0,
    penUp: true,
    stroke: -1,
    alongMm: 0,
  };
  private progress: PlotProgress | null = null;

  constructor(
    private readonly carriage: Carriage,
    private readonly planner: PlotPlanner,
    private readonly settings: PlotSettings,
  ) {
    this.finished = this.run().then(
      (outcome) => {
        this.end(true);
        return outcome;
      },
      (error: unknown) => {
        this.end(error instanceof Error ? error : new Error(String(error)));
        throw error;
      },
    );
    // Whoever started the run listens to `finished`; a run whose starter has gone must not end the process.
    this.finished.catch(() => undefined);
  }

  onProgress(listener: (progress: PlotProgress) => void): void {
    this.progressListeners.push(listener);
    if (this.progress) listener(this.progress);
  }

  onHeld(listener: (held: boolean) => void): void {
    this.heldListeners.push(listener);
  }

  pause(): Promise<void> {
    if (this.wish === "run") this.ask("hold");
    return this.until(() => this.held || this.wish === "cancel");
  }

  resume(): Promise<void> {
    if (this.wish === "hold") this.ask("run");
    return this.until(() => !this.held);
  }

  cancel(): Promise<void> {
    this.ask("cancel");
    return this.until(() => false);
  }

  private ask(wish: Wish): void {
    this.wish = wish;
    this.bringToRest();
    this.wakeWisher?.();
  }

  /** Ends the stream where the pen is next up and the carriage rests. */
  private bringToRest(): void {
    if (this.wish === "run" || !this.playing?.streamer.playing) return;
    const { streamer, plot } = this.playing;
    const index = nextRestIndex(plot, streamer.nextIndex);
    // With nothing left to draw, the way home is quicker than a stop.
    if (index < plot.commands.count && nextPlace(plot.trajectory, plot.commands.planS[index]!)) {
      streamer.cutAt(index);
    }
  }

  private async run(): Promise<PlotOutcome> {
    let from: Place | null = null;
    for (;;) {
      const plot = await this.plan(from);
      if (this.wish === "hold") await this.hold();
      if (this.wish === "cancel") return this.goHome();
      const report = await this.play(plot);
      const planS = plot.commands.planS[report.end.commandIndex + 1]!;
      this.carriage.penUp = isPenUpBefore(plot.trajectory, report.complete ? Infinity : planS);
      if (report.complete) return { kind: "done" };
      from = nextPlace(plot.trajectory, planS);
      if (!from) return this.goHome();
    }
  }

  private async plan(from: Place | null): Promise<PlannedPlot> {
    const machine = machineOf(this.settings);
    const board = await this.carriage.ready(machine, this.settings.pen);
    const place = this.carriage.place(machine)!;
    if (from === null && strokeCount(this.planner.strokes) === 0) {
      throw new PlotwrightError(
        "bad-file",
        "There is nothing to draw: every stroke is hidden, clipped or dropped.",
      );
    }
    const plot = await this.planner.plan({
      from,
      startXMm: place.x,
      startYMm: place.y,
      settings: this.settings,
      firmware: this.carriage.connection.features.version,
      board,
    });
    this.first ??= { trajectory: plot.trajectory, times: new PlaceTimes(plot.trajectory) };
    return plot;
  }

  private async play(plot: PlannedPlot): Promise<StreamReport> {
    if (this.carriage.penUp !== true) await this.carriage.movePen(true, this.settings);
    const streamer = this.carriage.streamer();
    const played = this.carriage.play(streamer, plot);
    this.playing = { streamer, plot };
    this.bringToRest();
    const stopTicking = this.tick();
    try {
      const report = await played;
      this.tellProgress(plot, report.complete ? plot.trajectory.totalS : report.end.planS);
      this.elapsedBeforeS += report.end.planS;
      return report;
    } finally {
      stopTicking();
      this.playing = null;
    }
  }

  private async hold(): Promise<void> {
    this.setHeld(true);
    while (this.wish === "hold") {
      await new Promise<void>((resolve) => {
        this.wakeWisher = resolve;
      });
    }
    this.wakeWisher = null;
    this.setHeld(false);
  }

  private async goHome(): Promise<PlotOutcome> {
    await this.carriage.walk(0, 0, this.settings);
    return { kind: "cancelled" };
  }

  private setHeld(held: boolean): void {
    this.held = held;
    for (const listener of this.heldListeners) listener(held);
    this.settleWaiters();
  }

  private tick(): () => void {
    const clock = this.carriage.connection.boardClock;
    const everyS = PROGRESS_S * this.carriage.connection.speed;
    let cancel = (): void => undefined;
    const next = (): void => {
      if (this.playing) this.tellProgress(this.playing.plot, this.playing.streamer.place().planS);
      cancel = clock.after(everyS, next);
    };
    next();
    return () => cancel();
  }

  private tellProgress(plot: PlannedPlot, planS: number): void {
    const now = stateAt(plot.trajectory, planS, this.motion);
    const elapsedS = this.elapsedBeforeS + planS;
    const remainingS = Math.max(0, plot.trajectory.totalS - planS);
    this.progress = {
      progress: elapsedS + remainingS > 0 ? elapsedS / (elapsedS + remainingS) : 1,
      elapsedS,
      remainingS,
      planS: this.firstPlanS(plot, planS, now),
      xMm: now.x,
      yMm: now.y,
      penUp: now.penUp,
    };
    for (const listener of this.progressListeners) listener(this.progress);
  }

  /** The same place's time in the first plan, which is the one that the page has. */
  private firstPlanS(plot: PlannedPlot, planS: number, now: MotionState): number {
    if (!this.first || plot.trajectory === this.first.trajectory) return planS;
    const timeS = now.stroke >= 0 ? this.first.times.timeOf(now) : null;
    const leftS = plot.trajectory.totalS - planS;
    return timeS ?? Math.max(0, this.first.trajectory.totalS - leftS);
  }

  private until(condition: () => boolean): Promise<void> {
    return new Promise((resolve, reject) => {
      this.waiters.push({ until: condition, resolve, reject });
      this.settleWaiters();
    });
  }

  private end(how: Error | true): void {
    this.ended = how;
    this.settleWaiters();
  }

  private settleWaiters(): void {
    const waiters = this.waiters;
    this.waiters = waiters.filter(({ until, resolve, reject }) => {
      if (this.ended instanceof Error) reject(this.ended);
      else if (this.ended || until()) resolve();
      else return true;
      return false;
    });
  }
}
