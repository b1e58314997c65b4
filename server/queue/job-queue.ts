/**
 * The queue: what may be done with jobs, in the order store -> announce. Nothing is announced that is not
 * on disk, so a kill at any instant leaves every browser's last picture true or behind, never ahead.
 *
 * Progress is the exception: it is announced as it comes and written only with the next change of state.
 */
import { z } from "zod";
import { PlotwrightError, type ErrorCode, type Place } from "../../src/index.js";
import {
  ENDED_STATES,
  queueSettingsSchema,
  type Job,
  type JobChange,
  type JobPatch,
  type JobPlace,
  type JobStats,
  type MovePlace,
  type PlotSettings,
  type QueueSettings,
  type ServerEvent,
} from "../../src/schema/index.js";
import type { PlotPlanner, PlotProgress } from "../plotter/types.js";
import type { DrawingFiles, StoredDrawing } from "./drawing-files.js";
import { applyJobEvent, type JobEvent } from "./job-machine.js";
import type { PlotterPort } from "./plotter-port.js";
import { MovingTimer, queuedJob } from "./queued-job.js";
import { Runner, type RunEnd } from "./runner.js";
import type { Store } from "./store.js";

export const SERVER_STOPPED =
  "The server stopped while this was plotting. Check pen and paper, then go on from where it was.";

/** The board's faults, after which a plot can go on from where it was; others would only come again. */
const INTERRUPTIONS: readonly ErrorCode[] = [
  "no-board",
  "disconnected",
  "board-error",
  "board-timeout",
  "busy",
  "not-allowed",
];

export interface Planning {
  measure(
    drawing: string,
    settings: PlotSettings,
    signal?: AbortSignal,
  ): Promise<{ readonly stats: JobStats; readonly warnings: readonly string[] }>;
  open(drawing: string, settings: PlotSettings, signal: AbortSignal): Promise<PlotPlanner>;
}

export interface QueueParts {
  readonly store: Store;
  readonly files: DrawingFiles;
  readonly planning: Planning;
  readonly plotters: ReadonlyMap<string, PlotterPort>;
  readonly announce: (event: ServerEvent) => void;
  readonly nowIso: () => string;
}

export interface NewQueueJob {
  readonly name: string;
  readonly settings: PlotSettings;
  readonly drawing: StoredDrawing;
  readonly plotterId?: string | undefined;
}

export class JobQueue {
  readonly #parts: QueueParts;
  readonly #jobs = new Map<string, Job>();
  readonly #runners = new Map<string, { readonly jobId: string; readonly runner: Runner }>();
  readonly #timers = new Map<string, MovingTimer>();
  #closing = false;

  /** Loads what is on disk; a job that was plotting when the server ended becomes interrupted. */
  constructor(parts: QueueParts) {
    this.#parts = parts;
    for (const job of parts.store.jobs()) {
      const wasRunning = job.state === "plotting" || job.state === "paused";
      this.#jobs.set(job.id, job);
      if (wasRunning) this.#interrupt(job.id, SERVER_STOPPED);
    }
  }

  /** Queue order first, then history, newest first. */
  list(): Job[] {
    return this.#order().map((id) => this.get(id));
  }

  /** Throws `not-found`. */
  get(id: string): Job {
    const job = this.#jobs.get(id);
    if (job === undefined) throw new PlotwrightError("not-found", `There is no job ${id}.`);
    return job;
  }

  get settings(): QueueSettings {
    const kept = queueSettingsSchema.safeParse(this.#parts.store.setting(QUEUE_SETTING));
    return kept.success ? kept.data : { runOn: false };
  }

  set settings(settings: QueueSettings) {
    this.#parts.store.saveSetting(QUEUE_SETTING, settings);
  }

  /** A queued copy, with the same drawing and settings: behind a queued job, else last. */
  duplicate(id: string): Job {
    const job = this.get(id);
    const { store } = this.#parts;
    const waiting = this.#order().filter((one) => this.get(one).state === "queued");
    const behind = waiting[waiting.indexOf(id) + 1] ?? null;
    const copy = queuedJob(job, this.#parts.nowIso());
    store.addJob(copy, { id: store.drawingOf(id), bytes: 0 });
    if (job.state === "queued" && behind !== null) store.moveJob(copy.id, behind);
    this.#jobs.set(copy.id, copy);
    this.#announceJob(copy);
    this.#announceOrder();
    return copy;
  }

  /** Plans the drawing to know it can be plotted, then appends it. Throws what planning throws, and
   *  then the drawing is gone. */
  async add(wanted: NewQueueJob, signal?: AbortSignal): Promise<Job> {
    try {
      return await this.#add(wanted, signal);
    } catch (error) {
      await this.#parts.files.remove(wanted.drawing.id);
      throw error;
    }
  }

  async #add(wanted: NewQueueJob, signal?: AbortSignal): Promise<Job> {
    const plotterId = wanted.plotterId ?? this.#firstPlotter();
    this.#plotter(plotterId);
    const { stats, warnings } = await this.#parts.planning.measure(
      wanted.drawing.id,
      wanted.settings,
      signal,
    );
    const { name, settings } = wanted;
    const job = queuedJob(
      { plotterId, name, settings, stats, warnings: [...warnings] },
      this.#parts.nowIso(),
    );
    this.#parts.store.addJob(job, wanted.drawing);
    this.#jobs.set(job.id, job);
    this.#announceJob(job);
    this.#announceOrder();
    return job;
  }

  /** A name at any time; settings only while queued, and only such that can be planned. */
  async patch(id: string, patch: JobPatch): Promise<Job> {
    const { name, settings, plotterId } = patch;
    if (plotterId !== undefined) {
      this.#mustBeQueued(id, "Its plotter");
      this.#plotter(plotterId);
    }
    let planned: Partial<Job> = {};
    if (settings !== undefined) {
      this.#mustBeQueued(id, "Its settings");
      const drawing = this.#parts.store.drawingOf(id);
      const { stats, warnings } = await this.#parts.planning.measure(drawing, settings);
      this.#mustBeQueued(id, "Its settings");
      planned = { settings, stats, warnings: [...warnings], remainingS: stats.durationS };
    }
    return this.#save({
      ...this.get(id),
      ...planned,
      ...(name === undefined ? {} : { name }),
      ...(plotterId === undefined ? {} : { plotterId }),
    });
  }

  move(id: string, beforeId: string | null): void {
    this.#mustBeQueued(id, "Its place");
    this.#parts.store.moveJob(id, beforeId);
    this.#announceOrder();
  }

  /** Throws `busy` while its plotter plots another job. */
  start(id: string): Job {
    const plotter = this.#freePlotter(id);
    const started = this.#apply(id, { type: "start" });
    this.#begin(plotter, started);
    return started;
  }

  /** Takes an interrupted job up at its place, held: nothing moves until it is resumed. */
  recover(id: string): Job {
    const plotter = this.#freePlotter(id);
    const job = this.#apply(id, { type: "recover" });
    this.#begin(plotter, job);
    const isLost = plotter.snapshot().xMm === null;
    return this.#note(
      id,
      isLost
        ? "The board has lost its place: push the carriage to home by hand before you go on."
        : "The board still knows its place. Check it with the pen up, then go on.",
    );
  }

  /** Heights and speeds while it plots or is held. */
  async change(id: string, change: JobChange): Promise<Job> {
    await this.#runnerOf(id, ["plotting", "paused"], "changed").change(change);
    const job = this.get(id);
    const { pen = job.settings.pen, motion = job.settings.motion, speedPct = job.speedPct } = change;
    return this.#save({ ...job, settings: { ...job.settings, pen, motion }, speedPct });
  }

  /** Stops without slowing down; the job is held then. */
  async emergencyStop(id: string): Promise<Job> {
    await this.#runnerOf(id, ["plotting", "paused"], "stopped").live.emergencyStop();
    return this.get(id);
  }

  /** Moves the place from which a held job goes on. */
  movePlace(id: string, by: MovePlace): Job {
    const place = this.#runnerOf(id, ["paused"], "moved along").live.moveHoldPlace(by);
    return this.#save({ ...this.get(id), place: jobPlace(place) });
  }

  /** Walks to the place of a held job with the pen up. */
  async checkPlace(id: string): Promise<Job> {
    await this.#runnerOf(id, ["paused"], "checked").live.checkHoldPlace();
    return this.get(id);
  }

  pause(id: string): Job {
    const runner = this.#runnerOf(id, ["plotting"], "paused");
    runner.pause();
    return this.#note(id, "Pausing: the pen finishes what it is drawing, then lifts.");
  }

  resume(id: string): Job {
    const runner = this.#runnerOf(id, ["paused"], "resumed");
    runner.resume();
    return this.#note(id, "Going on.");
  }

  cancel(id: string): Job {
    const job = this.get(id);
    const running = this.#runners.get(job.plotterId);
    if (running?.jobId !== id) return this.#apply(id, { type: "cancel" });
    running.runner.cancel();
    return this.#note(id, "Cancelling: the pen lifts and goes home.");
  }

  /** An ended job goes to the end of the queue again, with the same settings. */
  requeue(id: string): Job {
    const job = this.#apply(id, { type: "requeue" });
    this.#parts.store.moveJob(id, null);
    this.#announceOrder();
    return this.#save({ ...job, remainingS: job.stats?.durationS ?? null });
  }

  async remove(id: string): Promise<void> {
    const job = this.get(id);
    if (job.state === "plotting" || job.state === "paused") {
      throw new PlotwrightError("conflict", `"${job.name}" is ${job.state}. Cancel it before removing it.`);
    }
    const unused = this.#parts.store.removeJob(id);
    this.#jobs.delete(id);
    this.#parts.announce({ type: "job-removed", id });
    if (unused !== null) await this.#parts.files.remove(unused);
  }

  /** Path of the uploaded file. */
  drawingPath(id: string): string {
    this.get(id);
    return this.#parts.files.path(this.#parts.store.drawingOf(id));
  }

  isPlotterBusy(plotterId: string): boolean {
    return this.#runners.has(plotterId);
  }

  /** Stops what is plotting (the pen lifts and goes home) and waits for it; the jobs are interrupted then. */
  async close(): Promise<void> {
    this.#closing = true;
    const running = [...this.#runners.values()];
    for (const { runner } of running) runner.cancel();
    await Promise.all(running.map(({ runner }) => runner.finished));
  }

  #begin(plotter: PlotterPort, job: Job): void {
    const drawing = this.#parts.store.drawingOf(job.id);
    const runner = new Runner(
      {
        plotter,
        settings: job.settings,
        open: (signal) => this.#parts.planning.open(drawing, job.settings, signal),
        from: job.place === null ? null : { stroke: job.place.strokeIndex, alongMm: job.place.alongMm },
        speedPct: job.speedPct,
      },
      {
        journal: (entry) => this.#parts.store.saveJournal(job.id, entry),
        progress: (progress) => this.#progress(job.id, plotter.id, progress),
        held: (held) => this.#held(job.id, held),
        refused: (message) => void this.#note(job.id, message),
        ended: (end) => this.#ended(job.id, plotter.id, end),
      },
    );
    this.#runners.set(plotter.id, { jobId: job.id, runner });
    this.#timers.set(job.id, new MovingTimer(this.#parts.nowIso()));
  }

  #progress(id: string, plotterId: string, progress: PlotProgress): void {
    const { progress: part, elapsedS, remainingS, planS, xMm, yMm, penUp } = progress;
    // The way home of a cancelled plot is no progress of the drawing.
    if (this.#runners.get(plotterId)?.runner.isCancelling !== true) {
      this.#jobs.set(id, { ...this.get(id), progress: part, elapsedS, remainingS });
    }
    this.#parts.announce({
      type: "progress",
      jobId: id,
      plotterId,
      progress: part,
      elapsedS,
      remainingS,
      planS,
      xMm,
      yMm,
      penUp,
    });
  }

  #held(id: string, held: boolean): void {
    const { state } = this.get(id);
    if (held && state === "plotting") {
      const place = this.#holdPlace(id);
      this.#timers.get(id)?.hold(this.#parts.nowIso());
      this.#save({ ...this.#apply(id, { type: "hold" }), place });
    }
    if (!held && state === "paused") {
      this.#timers.get(id)?.release(this.#parts.nowIso());
      this.#save({ ...this.#apply(id, { type: "release" }), place: null });
    }
  }

  #ended(id: string, plotterId: string, end: RunEnd): void {
    this.#runners.delete(plotterId);
    // A hold that was never released before the end (cancelled while paused) needs no step between.
    const { store } = this.#parts;
    if (end.kind === "failed" && canGoOn(end.error) && store.journal(id) !== undefined) {
      this.#interrupt(id, end.error.message);
    } else if (end.kind === "failed") {
      this.#apply(id, { type: "fail", message: end.error.message });
    } else if (end.kind === "cancelled" && this.#closing) this.#interrupt(id, SERVER_STOPPED);
    else if (end.kind === "cancelled") this.#apply(id, { type: "cancel" });
    else {
      if (this.get(id).state === "paused") this.#apply(id, { type: "release" });
      const plottedS = this.#timers.get(id)?.movedS(this.#parts.nowIso()) ?? null;
      this.#jobs.set(id, { ...this.get(id), plottedS });
      this.#apply(id, { type: "finish" });
    }
    this.#timers.delete(id);
    if (ENDED_STATES.includes(this.get(id).state)) store.clearJournal(id);
    this.#announceOrder();
    if (end.kind === "done" && this.settings.runOn && !this.#closing) this.#startNext(plotterId);
  }

  /** The next job of that plotter, when the operator lets the queue run on. */
  #startNext(plotterId: string): void {
    const next = this.list().find((job) => job.plotterId === plotterId && job.state === "queued");
    if (next === undefined) return;
    try {
      this.start(next.id);
    } catch (error) {
      this.#note(next.id, error instanceof Error ? error.message : String(error));
    }
  }

  /** The place is the journal's; without one nothing was drawn, and the job begins at the beginning. */
  #interrupt(id: string, message: string): void {
    const entry = journalSchema.safeParse(this.#parts.store.journal(id));
    const { place } = this.get(id);
    this.#apply(id, {
      type: "interrupt",
      message,
      place: entry.success ? jobPlace(entry.data.place) : place,
    });
  }

  #holdPlace(id: string): JobPlace | null {
    const running = [...this.#runners.values()].find((one) => one.jobId === id);
    const place = running?.runner.live.holdPlace ?? null;
    return place === null ? null : jobPlace(place);
  }

  #apply(id: string, event: JobEvent): Job {
    const before = this.get(id);
    const after = this.#save(applyJobEvent(before, event, this.#parts.nowIso()));
    if (ENDED_STATES.includes(after.state) !== ENDED_STATES.includes(before.state)) this.#announceOrder();
    return after;
  }

  #note(id: string, message: string): Job {
    const job = this.get(id);
    return ENDED_STATES.includes(job.state) ? job : this.#save({ ...job, message });
  }

  #save(job: Job): Job {
    this.#parts.store.saveJob(job);
    this.#jobs.set(job.id, job);
    this.#announceJob(job);
    return job;
  }

  #announceJob(job: Job): void {
    this.#parts.announce({ type: "job", job });
  }

  #announceOrder(): void {
    this.#parts.announce({ type: "order", ids: this.#order() });
  }

  #order(): string[] {
    return this.#parts.store.order();
  }

  #mustBeQueued(id: string, what: string): void {
    const job = this.get(id);
    if (job.state !== "queued") {
      throw new PlotwrightError(
        "conflict",
        `"${job.name}" is ${job.state}. ${what} can change only while it is queued.`,
      );
    }
  }

  #runnerOf(id: string, states: readonly Job["state"][], verb: string): Runner {
    const job = this.get(id);
    const running = this.#runners.get(job.plotterId);
    if (running?.jobId !== id || !states.includes(job.state)) {
      throw new PlotwrightError("conflict", `"${job.name}" is ${job.state}, so it can't be ${verb} now.`);
    }
    return running.runner;
  }

  /** The job's plotter, when it is there and has no other job. */
  #freePlotter(id: string): PlotterPort {
    const plotter = this.#plotter(this.get(id).plotterId);
    const other = this.#runners.get(plotter.id);
    if (other !== undefined && other.jobId !== id) {
      throw new PlotwrightError(
        "busy",
        `"${this.get(other.jobId).name}" is on the plotter. Wait for it to end, or cancel it.`,
      );
    }
    mustBeThere(plotter);
    return plotter;
  }

  #plotter(id: string): PlotterPort {
    const plotter = this.#parts.plotters.get(id);
    if (plotter === undefined) throw new PlotwrightError("not-found", `There is no plotter ${id}.`);
    return plotter;
  }

  #firstPlotter(): string {
    const first = [...this.#parts.plotters.keys()][0];
    if (first === undefined) throw new PlotwrightError("no-board", "This server has no plotter.");
    return first;
  }
}

const QUEUE_SETTING = "queue";

const jobPlace = ({ stroke, alongMm }: Place): JobPlace => ({ strokeIndex: stroke, alongMm });

const canGoOn = (error: Error): boolean =>
  error instanceof PlotwrightError && INTERRUPTIONS.includes(error.code);

/** What Store.journal gives back: written by this program, but perhaps by another version of it. */
const journalSchema = z.object({
  place: z.object({ stroke: z.int().min(0), alongMm: z.number().min(0) }),
});

function mustBeThere(plotter: PlotterPort): void {
  const { connection, message, name } = plotter.snapshot();
  if (connection === "idle") return;
  if (connection === "busy") throw new PlotwrightError("busy", `${name} is busy. Wait for it to finish.`);
  throw new PlotwrightError("no-board", message ?? `${name} is not connected. Plug it in and switch it on.`);
}
