/**
 * One plot on a carriage: plan, stream, and what the user asks of it on the way.
 *
 *              ┌──────── resume: plan what is left, from the very place ────────┐
 *   plan ──> streaming ──pause──> slows down along the path, lifts ──> held ────┘
 *               │   │  └──emergency──> ES, counters read back, lifts ──> held
 *               │   └──cancel──> slows down, lifts, walks home ──> cancelled
 *               └──> done
 *
 * What has been written to the board plays out, at most the streamer's window; everything after it is new.
 */
import {
  comeToRest,
  compile,
  machineOf,
  penCommand,
  penMoveOf,
  penOfLayer,
  settingsIdOf,
  withLayerCodes,
  penSetUpCommands,
  PlotwrightError,
  strokeCount,
  type BoardState,
  type CommandStream,
  type PenSettings,
  type Place,
  type Streamer,
} from "../../src/index.js";
import type { PlotSettings } from "../../src/schema/index.js";
import type { Carriage } from "./carriage.js";
import {
  boardStateBefore,
  commandAfter,
  isPenUpBefore,
  movedPlace,
  nearestTime,
  placeAt,
  restingStream,
  pointOfPlace,
  snappedPlace,
  withoutDrop,
} from "./plan-places.js";
import { RunProgress, type Part } from "./run-progress.js";
import { stoppedPlace } from "./stopped-place.js";
import { Waiters } from "./waiters.js";
import type {
  LivePlotRun,
  PlannedPlot,
  PlotChange,
  PlotOutcome,
  PlotPlanner,
  PlotProgress,
  PlotStart,
} from "./types.js";

/** Between two reports of progress, and two journal entries, seconds of ours. */
const PROGRESS_S = 0.06;
const JOURNAL_S = 0.25;
/** Between the last journal entry and the end of what the board had got, at most, seconds of ours. */
const LEFT_S = 1.5;
/** Beyond what is in flight, time for a change to be planned in, seconds of ours; more when planning has taken more. */
const CHANGE_LEAD_S = 0.15;
const CHANGE_TRIES = 4;
/** How far mm along the plan and mm along the drawing may be apart. */
const SNAP_MM = 2;
/** The pen is at a point of the drawing: half a tenth of rounding and a microstep. */
const SAME_POINT_MM = 0.08;

/** A pen that is down already changes its height in this time. */
const RESEAT_MS = 60;

type Wish = "run" | "hold" | "cancel";

export class CarriageRun implements LivePlotRun {
  readonly finished: Promise<PlotOutcome>;
  /** Where the plot goes on from while held, and where it began. */
  holdPlace: Place | null;

  private wish: Wish = "run";
  private held = false;
  private streamer: Streamer | null = null;
  private readonly progress = new RunProgress();
  /** Set when the stream was stopped on purpose: what is still to be drawn then. */
  private stopped: { readonly place: Place | null } | null = null;
  private emergency = false;
  private failure: PlotwrightError | null = null;
  private settings: PlotSettings;
  private speedPct = 100;
  /** The heights that the board moves the pen to. */
  private boardPen: PenSettings;
  private planningS = 0;
  private changing: Promise<void> | null = null;
  private journalDueS = -Infinity;
  private wakeWisher: (() => void) | null = null;
  private cancelPlanning: ((error: PlotwrightError) => void) | null = null;
  private readonly heldListeners: ((held: boolean) => void)[] = [];
  private readonly progressListeners: ((progress: PlotProgress) => void)[] = [];
  private readonly waiters = new Waiters();

  constructor(
    private readonly carriage: Carriage,
    private readonly planner: PlotPlanner,
    settings: PlotSettings,
    private readonly start: PlotStart = {},
  ) {
    this.settings = settings;
    this.boardPen = settings.pen;
    this.holdPlace = start.from ? this.placeLeft(start.from) : null;
    if (start.held ?? this.holdPlace !== null) this.wish = "hold";
    this.finished = this.run().then(
      (outcome) => {
        this.waiters.end(true);
        return outcome;
      },
      (error: unknown) => {
        this.waiters.end(error instanceof Error ? error : new Error(String(error)));
        throw error;
      },
    );
    // Whoever started the run listens to `finished`; a run whose starter has gone must not end the process.
    this.finished.catch(() => undefined);
  }

  get isHeld(): boolean {
    return this.held;
  }

  onProgress(listener: (progress: PlotProgress) => void): void {
    this.progressListeners.push(listener);
    if (this.progress.latest) listener(this.progress.latest);
  }

  onHeld(listener: (held: boolean) => void): void {
    this.heldListeners.push(listener);
  }

  pause(): Promise<void> {
    if (this.wish === "run") this.ask("hold");
    return this.waiters.until(() => this.held || this.wish === "cancel");
  }

  resume(): Promise<void> {
    if (this.wish === "hold") this.ask("run");
    return this.waiters.until(() => !this.held);
  }

  cancel(): Promise<void> {
    this.ask("cancel");
    this.cancelPlanning?.(cancelled());
    return this.waiters.until(() => false);
  }

  emergencyStop(): Promise<void> {
    if (this.wish === "run") this.wish = "hold";
    const { streamer } = this;
    if (streamer?.playing) {
      this.emergency = true;
      this.carriage.connection.session.write([{ line: "ES" }]);
      streamer.abandon(new PlotwrightError("conflict", "The plot was stopped at once."));
    }
    return this.waiters.until(() => this.held || this.wish === "cancel");
  }

  /** The board can no longer do what it is told: nothing more is written, `finished` rejects. */
  fail(error: PlotwrightError): void {
    this.failure ??= error;
    this.carriage.connection.session.write([{ line: "ES" }]);
    this.streamer?.abandon(error);
    this.wakeWisher?.();
  }

  async change(change: PlotChange): Promise<void> {
    const { pen = this.settings.pen, motion = this.settings.motion } = change;
    this.settings = { ...this.settings, pen, motion };
    this.speedPct = change.speedPct ?? this.speedPct;
    // One after the other; the last one plans with everything that was asked for.
    this.changing = (this.changing ?? Promise.resolve()).then(() => this.changeInMotion());
    await this.changing;
  }

  moveHoldPlace(by: { readonly strokes?: number | undefined; readonly mm?: number | undefined }): Place {
    const place = this.heldPlace();
    this.holdPlace = movedPlace(this.planner.strokes, place, by);
    return this.holdPlace;
  }

  async checkHoldPlace(): Promise<void> {
    const { x, y } = pointOfPlace(this.planner.strokes, this.heldPlace());
    await this.carriage.walk(x, y, this.settings);
  }

  /** Where the plot that goes on was broken off, by the board's own counters where it has kept them. */
  private placeLeft(from: Place): Place {
    const { left, connection } = this.carriage;
    const at = this.carriage.place(machineOf(this.settings));
    if (!left || !at) return from;
    const { draw, travel } = this.settings.motion;
    const aheadMm = LEFT_S * connection.speed * Math.max(draw.speedMmPerS, travel.speedMmPerS);
    return stoppedPlace(this.planner.strokes, from, { ...at, up: left.penUp }, aheadMm);
  }

  private heldPlace(): Place {
    if (!this.held || !this.holdPlace) {
      throw new PlotwrightError("conflict", "The plot is not held: pause it first.");
    }
    return this.holdPlace;
  }

  private ask(wish: Wish): void {
    this.wish = wish;
    this.slowToRest();
    this.wakeWisher?.();
  }

  private async run(): Promise<PlotOutcome> {
    if (strokeCount(this.planner.strokes) === 0) {
      throw new PlotwrightError(
        "bad-file",
        "There is nothing to draw: every stroke is hidden, clipped or dropped.",
      );
    }
    // What was broken off may have left the pen on the paper.
    if (this.start.from && this.carriage.boardState && this.carriage.penUp !== true) {
      await this.carriage.movePen(true, this.settings);
    }
    for (;;) {
      if (this.wish === "hold") await this.hold();
      if (this.wish === "cancel") return this.goHome();
      const plot = await this.planFromRest().catch((error: unknown) => {
        if (this.wish === "cancel") return null;
        throw error;
      });
      if (!plot) return this.goHome();
      if (this.wish !== "run") continue;
      this.stopped = null;
      await this.play(plot);
      const stopped = this.stopped as { readonly place: Place | null } | null;
      if (!stopped) return { kind: "done" };
      if (!stopped.place) return this.goHome();
      this.holdPlace = stopped.place;
    }
  }

  private async planFromRest(): Promise<PlannedPlot> {
    const machine = machineOf(this.settings);
    const board = await this.carriage.ready(machine, this.settings.pen);
    const { x, y } = this.carriage.place(machine)!;
    const planning = this.plan(this.holdPlace, x, y, board);
    const cancel = new Promise<never>((_, reject) => {
      this.cancelPlanning = reject;
    });
    try {
      return await Promise.race([planning, cancel]);
    } finally {
      this.cancelPlanning = null;
      planning.catch(() => undefined);
    }
  }

  private async plan(from: Place | null, x: number, y: number, board: BoardState): Promise<PlannedPlot> {
    const clock = this.carriage.connection.boardClock;
    const startS = clock.nowS();
    const start = this.planStart(from, x, y);
    const plot = await this.planner.plan({
      from,
      startXMm: start.x,
      startYMm: start.y,
      settings: this.plannedSettings(),
      firmware: this.carriage.connection.features.version,
      board,
    });
    this.planningS = clock.nowS() - startS;
    return plot;
  }

  private plannedSettings(): PlotSettings {
    const share = this.speedPct / 100;
    const settings = withLayerCodes(this.settings, this.planner.strokes.layers);
    if (share === 1) return settings;
    const { draw, travel, layers = {} } = settings.motion;
    const scaled = <T extends { readonly speedMmPerS?: number | undefined }>(limits: T): T =>
      limits.speedMmPerS === undefined ? limits : { ...limits, speedMmPerS: limits.speedMmPerS * share };
    const scaledLayers = Object.entries(layers).map(([id, limits]) => [id, scaled(limits)] as const);
    return {
      ...settings,
      motion: {
        ...settings.motion,
        draw: scaled(draw),
        travel: scaled(travel),
        layers: Object.fromEntries(scaledLayers),
      },
    };
  }

  private async play(plot: PlannedPlot): Promise<void> {
    if (this.carriage.penUp !== true) await this.carriage.movePen(true, this.settings);
    this.boardPen = this.settings.pen;
    this.progress.add({ ...plot, start: this.carriage.boardState!, afterS: 0 });
    const streamer = this.carriage.streamer();
    const played = this.carriage.play(streamer, plot);
    this.streamer = streamer;
    // A wish from the time before there was a stream.
    this.slowToRest();
    const stopTicking = this.tick();
    try {
      const report = await played;
      const { trajectory } = this.progress.partOf(report.end.stream);
      const planS = report.end.stream.planS[report.end.commandIndex + 1]!;
      // One that was stopped at rest ends in the middle of the plan: its way to rest has no command.
      const isWhole = report.complete && !this.stopped;
      const penUp = isPenUpBefore(trajectory, isWhole ? Infinity : planS);
      this.carriage.penUp = penUp;
      // The board has come to rest, so a lift that had begun is over, whatever rounding says of its last instant.
      this.tell({
        ...this.progress.update({ ...report.end, planS: isWhole ? trajectory.totalS : planS }),
        penUp,
      });
    } catch (error) {
      if (!this.emergency) throw error;
      await this.afterEmergency(streamer);
    } finally {
      stopTicking();
      this.streamer = null;
      this.writeJournal();
    }
    if (this.stopped && this.carriage.penUp !== true) await this.carriage.movePen(true, this.settings);
  }

  /** Cuts the stream where the board has not got it yet, and puts the way to rest in its place. */
  private slowToRest(): void {
    const { streamer } = this;
    if (this.wish === "run" || !streamer?.playing || this.stopped) return;
    const cut = streamer.cut();
    const part = this.progress.partOf(cut.stream);
    const rest = this.restAt(part, cut.commandIndex, true);
    this.stopped = { place: rest.place };
    this.progress.add(rest.part);
    streamer.replace(rest.part.commands);
  }

  /** The way to rest from before a command that is still to be written. */
  private restAt(
    part: Part,
    index: number,
    lifts: boolean,
  ): { part: Part; place: Place | null; state: BoardState } {
    const { commands, trajectory } = part;
    const fromS = commands.planS[index]!;
    const { limits, pen } = this.layerSettings(placeAt(trajectory, fromS));
    const rest = comeToRest(trajectory, fromS, limits, lifts ? pen : null);
    const { trajectory: restTrajectory, planS } = rest;
    const leftS = Math.max(0, trajectory.totalS - planS) + part.afterS;
    const start = boardStateBefore(commands, index, part.start);
    const restCommands = compile(restTrajectory, {
      machine: machineOf(this.settings),
      firmware: this.carriage.connection.features.version,
      pen,
      start,
    });
    const state = boardStateBefore(restCommands, restCommands.count, start);
    return {
      part: { commands: restCommands, trajectory: restTrajectory, start, afterS: leftS },
      place: this.snapped(placeAt(trajectory, planS), restTrajectory.endX, restTrajectory.endY),
      state,
    };
  }

  /** What the layer that is being drawn does differently. */
  private layerSettings(place: Place | null): {
    limits: { drawAccel: number; travelAccel: number };
    pen: PenSettings;
  } {
    const { layer, layers } = this.planner.strokes;
    const { motion, pen } = withLayerCodes(this.settings, layers);
    const drawn = place ? layers[layer[place.stroke]!] : undefined;
    const id = drawn && settingsIdOf(drawn);
    const own = id === undefined ? undefined : motion.layers?.[id];
    const drawAccel = own?.accelMmPerS2 ?? motion.draw.accelMmPerS2;
    return {
      limits: { drawAccel, travelAccel: motion.travel.accelMmPerS2 },
      pen: id === undefined ? pen : penOfLayer(pen, id),
    };
  }

  /** The place of the drawing where the pen stands, when it stands in the middle of a stroke. */
  private snapped(place: Place | null, x: number, y: number): Place | null {
    if (!place || place.alongMm === 0) return place;
    return snappedPlace(this.planner.strokes, place, x, y, SNAP_MM);
  }

  /**
   * Where the plan of what is left shall begin. Within what rounding a corner allows, at the drawing itself and
   * not where the pen stands: the first command brings it there, instead of a travel move with the pen up.
   */
  private planStart(from: Place | null, x: number, y: number): { x: number; y: number } {
    if (!from || from.alongMm === 0) return { x, y };
    const point = pointOfPlace(this.planner.strokes, from);
    return Math.hypot(point.x - x, point.y - y) < SAME_POINT_MM ? point : { x, y };
  }

  /** Plans what is left with the new settings, and goes over to it at a place that the board has not got yet. */
  private async changeInMotion(): Promise<void> {
    for (let attempt = 0; attempt < CHANGE_TRIES; attempt++) {
      const { streamer } = this;
      if (!streamer?.playing || this.wish !== "run") return;
      const { speed } = this.carriage.connection;
      const part = this.progress.partOf(streamer.nextStream);
      const leadS = CHANGE_LEAD_S * speed + 1.5 * this.planningS * 2 ** attempt;
      const index = commandAfter(part.commands, streamer.nextIndex, leadS);
      if (index >= part.commands.count) return;
      const rest = this.restAt(part, index, false);
      if (!rest.place) return;
      const { trajectory } = rest.part;
      const plot = await this.plan(rest.place, trajectory.endX, trajectory.endY, rest.state);
      const isDown = !isPenUpBefore(part.trajectory, part.commands.planS[index]!);
      const commands = isDown ? withoutDrop(plot.commands) : plot.commands;
      if (this.wish !== "run" || this.streamer !== streamer) return;
      if (streamer.nextStream !== part.commands) continue;
      const heights = this.heightsChange(isDown, rest.state, trajectory.totalS);
      if (!streamer.cutAt(index, rest.part.commands, heights, commands)) continue;
      this.boardPen = this.settings.pen;
      const afterS = plot.trajectory.totalS;
      this.progress.add({ ...rest.part, afterS });
      this.progress.add({ commands: heights, trajectory, start: rest.state, afterS });
      this.progress.add({ commands, trajectory: plot.trajectory, start: rest.state, afterS: 0 });
      return;
    }
  }

  /** New heights on the way; where the pen is down at another height than it should be, it moves there. */
  private heightsChange(isDown: boolean, state: BoardState, planS: number): CommandStream {
    const { pen } = this.settings;
    const machine = machineOf(this.settings);
    const lines = penSetUpCommands(machine, pen).map((line) => [line, 0] as [string, number]);
    const byPct = Math.abs(pen.downPct - this.boardPen.downPct);
    if (isDown && byPct > 0) {
      const { heightPct, ratePctPerS } = penMoveOf(pen, false);
      const timeMs = ratePctPerS ? RESEAT_MS + (1_000 * byPct) / ratePctPerS : RESEAT_MS;
      const reseat = { up: false, heightPct, wayPct: byPct, timeMs, ratePctPerS };
      lines.push([penCommand(machine, reseat), timeMs / 1000]);
    }
    return restingStream(lines, state, planS);
  }

  /** The board has dropped its queue: what it has drawn is what its counters say. */
  private async afterEmergency(streamer: Streamer): Promise<void> {
    this.emergency = false;
    const at = streamer.place();
    await this.carriage.findPlace();
    const { trajectory } = this.progress.partOf(at.stream);
    const { x, y } = this.carriage.place(machineOf(this.settings))!;
    const planS = nearestTime(trajectory, at.planS, 1, x, y);
    this.stopped = { place: this.snapped(placeAt(trajectory, planS) ?? this.progress.place, x, y) };
    this.carriage.penUp = null;
  }

  private async hold(): Promise<void> {
    this.setHeld(true);
    while (this.wish === "hold" && !this.failure) {
      await new Promise<void>((resolve) => {
        this.wakeWisher = resolve;
      });
    }
    this.wakeWisher = null;
    if (this.failure) throw this.failure;
    this.setHeld(false);
  }

  private async goHome(): Promise<PlotOutcome> {
    await this.carriage.walk(0, 0, this.settings);
    return { kind: "cancelled" };
  }

  private setHeld(held: boolean): void {
    this.held = held;
    for (const listener of this.heldListeners) listener(held);
    this.waiters.check();
  }

  private tick(): () => void {
    const { boardClock, speed } = this.carriage.connection;
    let cancel = (): void => undefined;
    const next = (): void => {
      if (this.streamer) {
        this.tell(this.progress.update(this.streamer.place()));
        if (boardClock.nowS() >= this.journalDueS) this.writeJournal();
      }
      cancel = boardClock.after(PROGRESS_S * speed, next);
    };
    next();
    return () => cancel();
  }

  private tell(progress: PlotProgress): void {
    for (const listener of this.progressListeners) listener(progress);
  }

  private writeJournal(): void {
    const { latest, place } = this.progress;
    const { boardClock, speed } = this.carriage.connection;
    this.journalDueS = boardClock.nowS() + JOURNAL_S * speed;
    const left = this.stopped?.place ?? place;
    if (!latest || !left) return;
    const { xMm, yMm, penUp, elapsedS } = latest;
    this.start.journal?.record({ place: left, xMm, yMm, penUp, elapsedS });
  }
}

const cancelled = (): PlotwrightError => new PlotwrightError("cancelled", "The plot was cancelled.");
