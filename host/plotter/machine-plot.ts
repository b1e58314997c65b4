/**
 * One plot on a machine: plans, streams, and handles the user's requests meanwhile.
 *
 *              ┌──────── resume: plan the rest, from the same place ────────────┐
 *   plan ──> streaming ──pause──> slows down along the path, lifts ──> held ────┘
 *    ^          │ │ │  └──emergency──> stops at once, lifts ──> held
 *    │          │ │ └──cancel──> slows down, lifts, goes home ──> cancelled
 *    │          │ └──a pen is due──> lifts, goes home ──> held
 *    └──────────┘                                          done when nothing is left
 *
 * A drawing with pen changes is planned and streamed in parts, each from one change to the next.
 */
import { PlotwrightError, type StrokePosition, type StrokeSet } from "../../src/index.js";
import {
  MIN_RUN,
  movedPosition,
  pointAt,
  type Machine,
  type Playback,
  machineOf,
  penOfStroke,
  strokeCount,
} from "../../src/internal.js";
import type { PlotSettings, PlotWait } from "../../src/schema/index.js";
import { resumePosition, PROGRESS_S } from "./resume-position.js";
import { PenStops } from "./pen-stops.js";
import { PlotPlans } from "./plot-plans.js";
import { PlotReports } from "./plot-reports.js";
import { LiveFeed } from "./live-feed.js";
import type { LiveStrokes } from "./live-strokes.js";
import { LiveSettings } from "./live-settings.js";
import type { PlannedPlot, PlotPlanner } from "../planning/planning.js";
import type { RunningPlot, PlotChange, PlotOutcome, PlotStart, ReportedProgress } from "./plotter-port.js";
import { Waiters } from "./waiters.js";

/** Min time to plan a change, after the commands already sent, in real seconds; more if planning took longer before. */
const CHANGE_LEAD_S = 0.15;
const CHANGE_TRIES = 4;

/** The state that the user asked for. */
type RequestedState = "run" | "hold" | "cancel";
type HeldListener = (held: boolean, wait?: PlotWait | null) => void;

export class MachinePlot implements RunningPlot {
  readonly finished: Promise<PlotOutcome>;
  /** While held, the place from which the plot resumes; before that, the place where it starts. */
  holdPlace: StrokePosition | null;

  private requested: RequestedState = "run";
  private held = false;
  /** What the plot waits for, if it was not held by the user. */
  private wait: PlotWait | null = null;
  private readonly stream: Playback;
  private readonly settings: LiveSettings;
  private readonly reports: PlotReports;
  private readonly stops: PenStops;
  /** Null: the drawing is complete. */
  private readonly feed: LiveFeed | null;
  private readonly plans: PlotPlans;
  private failure: PlotwrightError | null = null;
  private changing: Promise<void> | null = null;
  /** The user's moves while it is held; nothing else may move until they have finished. */
  private moving: Promise<void> = Promise.resolve();
  private wakeHold: (() => void) | null = null;
  /** The carriage stays where it is until the next request: after an emergency stop, or when a held plot is left. */
  private holdsPosition = false;
  private readonly heldListeners: HeldListener[] = [];
  private readonly waiters = new Waiters();
  private readonly start: PlotStart;

  constructor(
    private readonly machine: Machine,
    private readonly planner: PlotPlanner,
    settings: PlotSettings,
    start: PlotStart = {},
  ) {
    this.start = start;
    this.settings = new LiveSettings(settings);
    this.stops = new PenStops(this.strokes, settings, start.from ?? null);
    const { live } = start;
    const run = newRun(machine);
    this.stream = machine.startPlayback({
      run,
      get strokes() {
        return planner.strokes;
      },
      grows: live !== undefined,
      settings: () => this.settings.current,
      events: {
        progressed: (progress) => this.reports.progressed(progress),
        ended: (place) => this.reports.streamEnded(place),
      },
    });
    if (live && !this.stream.growth) throw notLive(machineOf(settings).name);
    this.feed = live ? new LiveFeed(live, machine, this.stream, this.settings, () => this.holdPlace) : null;
    this.reports = new PlotReports(machine, this.stream, this.settings, {
      ...(live ? inWhole(live, start) : start),
      run,
    });
    const { from = null } = start;
    const { stream, stops, feed } = this;
    this.plans = new PlotPlans({
      machine,
      planner,
      stream,
      settings: this.settings,
      stops,
      feed,
      start: from,
    });
    this.holdPlace =
      from && resumePosition(machine, this.strokes, settings, this.stops.strokes, { ...start, from });
    if (start.held ?? this.holdPlace !== null) this.requested = "hold";
    this.finished = this.run();
    // Callers await `finished`. If none does, its rejection must not end the process, so it is handled here.
    void this.finished.then(
      () => this.waiters.end(true),
      (error: unknown) => this.waiters.end(error instanceof Error ? error : new Error(String(error))),
    );
  }

  get isHeld(): boolean {
    return this.held;
  }

  private get strokes(): StrokeSet {
    return this.planner.strokes;
  }

  onProgress(listener: (report: ReportedProgress) => void): void {
    this.reports.onProgress(listener);
  }

  /** If the plot is held already, the listener learns it now. */
  onHeld(listener: HeldListener): void {
    this.heldListeners.push(listener);
    if (this.held) listener(true, this.wait);
  }

  pause(): Promise<void> {
    if (this.requested === "run") this.request("hold");
    return this.waiters.until(() => this.held || this.requested === "cancel");
  }

  resume(): Promise<void> {
    if (this.requested === "hold") this.request("run");
    return this.waiters.until(() => !this.held);
  }

  cancel(): Promise<void> {
    this.request("cancel");
    this.plans.cancel();
    return this.waiters.until(() => false);
  }

  leave(): Promise<void> {
    const holds = this.requested === "hold" || this.holdsPosition;
    const ended = this.cancel();
    this.holdsPosition = holds;
    return ended;
  }

  async interrupt(): Promise<void> {
    const held = this.pause();
    this.plans.cancel();
    await held;
    await this.leave();
  }

  emergencyStop(): Promise<void> {
    if (this.requested === "run") this.requested = "hold";
    this.holdsPosition = true;
    if (this.stream.playing) {
      this.stream.stopAtOnce();
      // The board no longer draws everything that it had received.
      this.reports.writeJournal(this.stream.progress.place);
    } else this.machine.stopAtOnce();
    return this.waiters.until(() => this.held || this.requested === "cancel");
  }

  /** The board no longer follows commands: nothing more is sent, and `finished` rejects. */
  fail(error: PlotwrightError): void {
    this.failure ??= error;
    this.stream.fail(error);
    this.wakeAll();
  }

  async change(change: PlotChange): Promise<void> {
    this.settings.change(change);
    // The pen that stands on the paper follows a change of its height.
    if (change.pen && this.held && this.machine.penUp === false) await this.movePenAtHold(false);
    // Changes run one after the other; the last one plans with all requested changes.
    const before = this.changing ?? Promise.resolve();
    this.changing = before.catch(() => undefined).then(() => this.changeInMotion());
    await this.changing;
  }

  moveHoldPlace(by: {
    readonly strokes?: number | undefined;
    readonly mm?: number | undefined;
  }): StrokePosition {
    const { stroke, alongMm } = this.placeAfter(by);
    this.holdPlace = { stroke, alongMm };
    this.stops.moved(this.holdPlace);
    const wait = this.stops.due(this.holdPlace);
    const moved = this.stream.progress.movedTo(this.holdPlace, this.reports.initialProgress());
    if (moved) this.reports.progressed(moved);
    if (wait?.layerName !== this.wait?.layerName) this.setHeld(true, wait);
    this.reports.writeJournal(this.holdPlace);
    return this.holdPlace;
  }

  placeAfter(by: { readonly strokes?: number | undefined; readonly mm?: number | undefined }) {
    const place = movedPosition(this.strokes, this.heldPlace(), by);
    return { ...place, ...pointAt(this.strokes, place) };
  }

  async checkHoldPlace(): Promise<void> {
    const { x, y } = pointAt(this.strokes, this.heldPlace());
    await this.moveAtHold(() => this.machine.moveTo(x, y, this.settings.current));
  }

  async movePenAtHold(up: boolean): Promise<void> {
    const { stroke } = this.heldPlace();
    await this.moveAtHold(() => {
      const { current } = this.settings;
      const { upPct, downPct } = penOfStroke(current, this.strokes, stroke);
      return this.machine.movePen(up, current, up ? upPct : downPct);
    });
  }

  /** One move after the other. None begins after an emergency stop that came in between. */
  private async moveAtHold(move: () => Promise<void>): Promise<void> {
    const { stopSignal } = this.machine;
    const moved = this.moving.then(async () => {
      await this.heightIsAgain();
      stopSignal.throwIfAborted();
      return move();
    });
    this.moving = moved.catch((error: unknown) => {
      // The plot cannot resume from a lost position.
      if (!this.machine.state && error instanceof PlotwrightError) this.fail(error);
    });
    await moved;
  }

  private heldPlace(): StrokePosition {
    if (!this.held || !this.holdPlace) {
      throw new PlotwrightError("conflict", "The plot is not held: pause it first.");
    }
    return this.holdPlace;
  }

  private request(state: RequestedState): void {
    this.requested = state;
    this.holdsPosition = false;
    if (state !== "run") this.stream.slowToRest();
    this.wakeAll();
  }

  private wakeAll(): void {
    this.wakeHold?.();
    this.feed?.interrupt();
  }

  private async run(): Promise<PlotOutcome> {
    if (!this.feed && strokeCount(this.strokes) === 0) {
      throw new PlotwrightError(
        "bad-file",
        "There is nothing to draw: every stroke is hidden, clipped or dropped.",
      );
    }
    if (this.requested === "run") await this.heightIsAgain();
    await this.liftPenIfDown();
    // Found on the machine, and no longer so once something moves it.
    if (this.holdPlace) this.reports.writeJournal(this.holdPlace);
    for (;;) {
      if (this.requested === "run" && this.stops.due(this.holdPlace)) this.requested = "hold";
      if (this.requested === "hold") await this.hold();
      if (this.requested === "cancel") return this.goHome();
      if (this.feed) {
        await this.feed.untilMore(this.holdPlace, () => this.requested !== "run" || this.failure !== null);
        if (this.failure) throw this.failure;
        if (this.requested !== "run") continue;
        this.holdPlace = this.feed.forget(this.holdPlace);
      }
      const until = this.stops.nextAfter(this.holdPlace);
      const { changeCount } = this.settings;
      const plot = await this.plans
        .fromRest(this.holdPlace, () => this.requested === "run")
        .catch((error: unknown) => {
          if (this.requested !== "run") return null;
          throw error;
        });
      if (!plot) continue;
      // Lift before the check: a request during the lift must be seen before anything moves.
      if (this.machine.penUp !== true && !this.feed) await this.machine.movePen(true, this.settings.current);
      if (this.requested !== "run" || this.settings.changeCount !== changeCount) continue;
      const ended = await this.play(plot);
      const next = this.stream.stopped?.place ?? (until === null ? null : { stroke: until, alongMm: 0 });
      if (next) this.holdPlace = next;
      else if (ended && !this.feed?.isOver) this.holdPlace = ended;
      else if (this.stream.stopped) return this.finishStoppedReturn();
      else return { kind: "done" };
    }
  }

  /** Returns where a live drawing goes on after the plan; null for another drawing. */
  private async play(plot: PlannedPlot): Promise<StrokePosition | null> {
    this.feed?.take(plot);
    try {
      await this.stream.play(plot, this.plans.afterPartS, () => this.streamBegun());
    } catch (error) {
      this.feed?.ended(true);
      throw error;
    }
    return this.feed?.ended(this.stream.stopped !== null) ?? null;
  }

  /** Lifts a pen that an interrupted plot may have left on the paper. */
  private async liftPenIfDown(): Promise<void> {
    if (!this.start.from) return;
    // Plan now, while the user checks pen and paper.
    if (!this.feed) this.plans.timesOfWhole().catch(() => undefined);
    if (this.machine.state && this.machine.penUp !== true) {
      await this.machine.movePen(true, this.settings.current);
    }
  }

  /** Before a continued plot moves anything, the user has been told to bring its pen to a known height. */
  private async heightIsAgain(): Promise<void> {
    if (this.start.from) await this.machine.height?.isAsSwitchedOn();
  }

  /** Plans the rest with the new settings, and switches to it at a place that was not yet sent to the board. */
  private async changeInMotion(): Promise<void> {
    const { speed, clock } = this.machine;
    let tries = 0;
    while (this.requested === "run" && tries < CHANGE_TRIES) {
      const { playing } = this.stream;
      const over = this.stream.placeAhead(CHANGE_LEAD_S * speed + 1.5 * this.plans.planningS * 2 ** tries);
      if (over) {
        tries++;
        const plot = await this.plans.from(over.from, over.x, over.y, over.board);
        if (this.requested !== "run" || this.stream.playing !== playing) return;
        if (over.switchTo(plot, this.plans.afterPartS)) return this.feed?.take(plot);
      } else if (!this.stream.isSwitching) return;
      else await new Promise<void>((resolve) => void clock.after(PROGRESS_S * speed, resolve));
    }
  }

  private async hold(): Promise<void> {
    this.setHeld(true, this.stops.due(this.holdPlace));
    if (this.holdPlace) this.reports.writeJournal(this.holdPlace);
    this.holdPlace ??= { stroke: 0, alongMm: 0 };
    while (this.requested === "hold" && !this.failure) {
      await new Promise<void>((resolve) => {
        this.wakeHold = resolve;
      });
    }
    this.wakeHold = null;
    await this.untilMoved();
    if (this.failure) throw this.failure;
    if (this.requested === "run") await this.heightIsAgain();
    // A new pen may stand on the paper.
    if (this.machine.penUp === false) await this.machine.movePen(true, this.settings.current);
    if (this.requested === "run") this.stops.answer(this.holdPlace);
    this.setHeld(false, null);
  }

  private async untilMoved(): Promise<void> {
    let last: Promise<void>;
    do {
      last = this.moving;
      await last;
    } while (last !== this.moving);
  }

  /** Handles a stop after everything was drawn, on the way home. */
  private async finishStoppedReturn(): Promise<PlotOutcome> {
    const { kind } = await this.goHome();
    return { kind: this.requested === "cancel" ? kind : "done" };
  }

  private async goHome(): Promise<PlotOutcome> {
    if (this.failure) throw this.failure;
    if (this.holdsPosition) return { kind: "cancelled" };
    try {
      await this.machine.moveTo(0, 0, this.settings.current);
    } catch (error) {
      // After an emergency stop, and if home is lost, the carriage stays where it is.
      if (!(error instanceof PlotwrightError)) throw error;
      const isHomeLost = error.code === "board-error" && !this.machine.state;
      if (error.code !== "conflict" && !isHomeLost) throw error;
    }
    return { kind: "cancelled" };
  }

  private setHeld(held: boolean, wait: PlotWait | null): void {
    this.held = held;
    this.wait = wait;
    for (const listener of this.heldListeners) listener(held, wait);
    this.waiters.check();
  }

  private streamBegun(): void {
    // A request that came before the stream existed.
    if (this.requested !== "run") this.stream.slowToRest();
    this.reports.streamBegun();
  }
}

/** The journal's places are in the whole drawing. */
const inWhole = (live: LiveStrokes, { journal, noted }: PlotStart): Pick<PlotStart, "journal" | "noted"> => ({
  noted,
  journal: journal && {
    record: ({ place, received, ...entry }) =>
      journal.record({
        ...entry,
        place: live.wholePlace(place),
        received: received && live.wholePlace(received),
      }),
  },
});

/** A number that most probably no other run has, also none of another computer. */
function newRun({ foundMidPlot }: Pick<Machine, "foundMidPlot">): number {
  let run: number;
  // A machine that keeps only a part of the number must tell it from that of the plot in which it was left.
  do run = MIN_RUN + Math.floor(Math.random() * MIN_RUN);
  while (foundMidPlot?.isOfRun(run));
  return run;
}

const notLive = (name: string): PlotwrightError =>
  new PlotwrightError(
    "bad-setting",
    `${name} can't draw live yet: only plotters with an EiBotBoard can. Plot finished drawings on it instead.`,
  );
