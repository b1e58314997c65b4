/**
 * What is being plotted: one run for each plotter, side by side. Carries what the runs report into the jobs,
 * and what is asked of a job that is on a plotter to its run.
 */
import { z } from "zod";
import { PlotwrightError, type ErrorCode, type Place } from "../../src/index.js";
import {
  ENDED_STATES,
  type Job,
  type JobChange,
  type JobPlace,
  type MovePlace,
  type PlotWait,
} from "../../src/schema/index.js";
import type { JournalEntry, PlotProgress } from "../plotter/types.js";
import { isDiskFault } from "./disk-fault.js";
import type { JobBook } from "./job-book.js";
import { applyJobEvent } from "./job-machine.js";
import type { PlotterPort } from "./plotter-port.js";
import type { QueueParts } from "./queue-parts.js";
import { MovingTimer } from "./queued-job.js";
import { Runner, type RunEnd } from "./runner.js";

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

interface Running {
  readonly jobId: string;
  readonly runner: Runner;
  readonly timer: MovingTimer;
}

export class PlotRuns {
  readonly #parts: QueueParts;
  readonly #book: JobBook;
  readonly #done: (job: Job) => void;
  /** By plotter. */
  readonly #running = new Map<string, Running>();
  #closing = false;
  #lastTrouble: string | null = null;

  /** A job that was plotting when the server ended becomes interrupted. `done` hears of each plot that ended well. */
  constructor(parts: QueueParts, book: JobBook, done: (job: Job) => void) {
    this.#parts = parts;
    this.#book = book;
    this.#done = done;
    for (const { id, state } of book.list()) {
      if (state === "plotting" || state === "paused") this.#interrupt(id, SERVER_STOPPED);
    }
  }

  isBusy(plotterId: string): boolean {
    return this.#running.has(plotterId);
  }

  get isClosing(): boolean {
    return this.#closing;
  }

  /** Throws what `start` would. */
  mustBeStartable(id: string): void {
    this.#freePlotter(id);
    applyJobEvent(this.#book.get(id), { type: "start" }, this.#parts.nowIso());
  }

  /** Throws `busy` while its plotter plots another job. */
  start(id: string): Job {
    const plotter = this.#freePlotter(id);
    // Of an earlier plot, which was interrupted and queued again.
    this.#parts.store.clearJournal(id);
    const started = this.#book.apply(id, { type: "start" });
    this.#begin(plotter, started);
    return started;
  }

  /** Takes an interrupted job up at its place, held: nothing moves until it is resumed. */
  recover(id: string): Job {
    const plotter = this.#freePlotter(id);
    const { place: from } = this.#book.get(id);
    const job = this.#book.apply(id, { type: "recover" }, { place: from ?? { strokeIndex: 0, alongMm: 0 } });
    this.#begin(plotter, job).hold(this.#parts.nowIso());
    const isLost = plotter.snapshot().xMm === null;
    const place = isLost
      ? "The board has lost its place: push the carriage to home by hand before you go on. The line may overlap a little there."
      : "The board still knows its place. Check it with the pen up, then go on.";
    return this.#book.note(id, job.wait === null ? place : `${penWords(job.wait)} ${place}`);
  }

  /** Heights and speeds while it plots or is held. */
  async change(id: string, change: JobChange): Promise<Job> {
    await this.#runnerOf(id, ["plotting", "paused"], "changed").change(change);
    const job = this.#book.get(id);
    const { pen = job.settings.pen, motion = job.settings.motion, speedPct = job.speedPct } = change;
    return this.#book.save({ ...job, settings: { ...job.settings, pen, motion }, speedPct });
  }

  /** Stops without slowing down; the job is held then. */
  async emergencyStop(id: string): Promise<Job> {
    await this.#runnerOf(id, ["plotting", "paused"], "stopped").live.emergencyStop();
    return this.#book.get(id);
  }

  /** Moves the place from which a held job goes on. */
  movePlace(id: string, by: MovePlace): Job {
    const place = this.#runnerOf(id, ["paused"], "moved along").live.moveHoldPlace(by);
    return this.#book.save({ ...this.#book.get(id), place: jobPlace(place) });
  }

  /** Walks to the place of a held job with the pen up. */
  async checkPlace(id: string): Promise<Job> {
    await this.#runnerOf(id, ["paused"], "checked").live.checkHoldPlace();
    return this.#book.get(id);
  }

  pause(id: string): Job {
    this.#runnerOf(id, ["plotting"], "paused").pause();
    return this.#book.note(id, "Pausing: the pen finishes what it is drawing, then lifts.");
  }

  resume(id: string): Job {
    this.#runnerOf(id, ["paused"], "resumed").resume();
    return this.#book.note(id, "Going on.");
  }

  cancel(id: string): Job {
    const running = this.#running.get(this.#book.get(id).plotterId);
    if (running?.jobId !== id) return this.#book.apply(id, { type: "cancel" });
    running.runner.cancel();
    return this.#book.note(id, "Cancelling: the pen lifts and goes home.");
  }

  /** Stops what is plotting (the pen lifts and goes home) and waits for it; the jobs are interrupted then. */
  async close(): Promise<void> {
    this.#closing = true;
    const running = [...this.#running.values()];
    for (const { runner } of running) runner.cancel();
    await Promise.all(running.map(({ runner }) => runner.finished));
    this.#book.close();
  }

  #begin(plotter: PlotterPort, job: Job): MovingTimer {
    const drawing = this.#parts.store.drawingOf(job.id);
    const from = job.place === null ? null : { stroke: job.place.strokeIndex, alongMm: job.place.alongMm };
    const entry = this.#journal(job.id);
    const isOfEntry = entry?.place.stroke === from?.stroke && entry?.place.alongMm === from?.alongMm;
    const runner = new Runner(
      {
        plotter,
        settings: job.settings,
        open: (signal) => this.#parts.planning.open(drawing, job.settings, signal),
        from,
        sent: isOfEntry ? entry?.sent : undefined,
        speedPct: job.speedPct,
      },
      {
        journal: (entry) => this.#safely(job.id, () => this.#saveJournal(job.id, entry)),
        progress: (progress) => this.#progress(job.id, plotter.id, progress),
        held: (held, wait) => this.#safely(job.id, () => this.#held(job.id, held, wait)),
        refused: (message) => this.#safely(job.id, () => void this.#book.note(job.id, message)),
        ended: (end) => this.#safely(job.id, () => this.#ended(job.id, plotter.id, end)),
      },
    );
    const timer = new MovingTimer(this.#parts.nowIso());
    this.#running.set(plotter.id, { jobId: job.id, runner, timer });
    return timer;
  }

  /** With the progress at that place, which is in memory only and gone after a kill. */
  #saveJournal(id: string, entry: JournalEntry): void {
    const { progress, elapsedS, remainingS } = this.#book.get(id);
    this.#parts.store.saveJournal(id, { ...entry, progress, elapsedS, remainingS });
  }

  /** A disk that is full must not stop the pen in mid-stroke, nor end the server: it may have room again soon. */
  #safely(jobId: string, write: () => void): void {
    try {
      write();
      this.#lastTrouble = null;
    } catch (error) {
      const trouble = error instanceof Error ? error.message : String(error);
      if (trouble !== this.#lastTrouble) this.#parts.log?.(`a plot can't be written down: ${trouble}`);
      this.#lastTrouble = trouble;
      if (isDiskFault(error)) this.#book.diskIsFull(jobId);
    }
  }

  #progress(jobId: string, plotterId: string, progress: PlotProgress): void {
    const { progress: part, elapsedS, remainingS, planS, xMm, yMm, penUp } = progress;
    // The way home of a cancelled plot is no progress of the drawing.
    if (this.#running.get(plotterId)?.runner.isCancelling !== true) {
      this.#book.progressed(jobId, { progress: part, elapsedS, remainingS });
    }
    this.#parts.announce({
      type: "progress",
      jobId,
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

  /** A wait that came before (of an interrupted job) stands until it is answered. */
  #held(id: string, held: boolean, wait: PlotWait | null): void {
    const job = this.#book.get(id);
    const running = this.#running.get(job.plotterId);
    if (held && job.state === "plotting") {
      running?.timer.hold(this.#parts.nowIso());
      const waitsFor = wait ?? job.wait;
      const message = waitsFor === null ? null : penWords(waitsFor);
      this.#book.apply(id, { type: "hold" }, { place: this.#holdPlace(running), wait: waitsFor, message });
    } else if (held && job.state === "paused") {
      // Taken up: only now the board has said where it came to.
      const place = this.#holdPlace(running);
      const isNewWait = wait !== null && wait.layerName !== job.wait?.layerName;
      this.#book.save({ ...job, place, ...(isNewWait ? { wait, message: penWords(wait) } : {}) });
    } else if (!held && job.state === "paused") {
      running?.timer.release(this.#parts.nowIso());
      this.#book.apply(id, { type: "release" }, { place: null });
    }
  }

  #ended(id: string, plotterId: string, end: RunEnd): void {
    const timer = this.#running.get(plotterId)?.timer;
    this.#running.delete(plotterId);
    const { store, nowIso } = this.#parts;
    // What is on paper already must not be lost, whatever went wrong.
    if (end.kind === "failed" && (canGoOn(end.error) || store.journal(id) !== undefined)) {
      this.#interrupt(id, end.error.message);
    } else if (end.kind === "failed") {
      this.#book.apply(id, { type: "fail", message: end.error.message });
    } else if (end.kind === "cancelled" && this.#closing) this.#interrupt(id, SERVER_STOPPED);
    else if (end.kind === "cancelled") this.#book.apply(id, { type: "cancel" });
    else {
      // A hold that was never released before the end needs its step between.
      if (this.#book.get(id).state === "paused") this.#book.apply(id, { type: "release" });
      this.#book.apply(id, { type: "finish" }, { plottedS: timer?.movedS(nowIso()) ?? null });
    }
    const job = this.#book.get(id);
    this.#book.announceOrder();
    if (ENDED_STATES.includes(job.state)) store.clearJournal(id);
    if (job.state === "done") this.#done(job);
  }

  /** The place is the journal's; without one nothing was drawn, and the job begins at the beginning. */
  #interrupt(id: string, message: string): void {
    const entry = this.#journal(id);
    const { place } = this.#book.get(id);
    const progress = journalProgressSchema.safeParse(this.#parts.store.journal(id));
    this.#book.apply(
      id,
      { type: "interrupt", message, place: entry ? jobPlace(entry.place) : place },
      progress.success ? progress.data : {},
    );
  }

  #journal(id: string): z.infer<typeof journalSchema> | null {
    return journalSchema.safeParse(this.#parts.store.journal(id)).data ?? null;
  }

  #holdPlace(running: Running | undefined): JobPlace | null {
    const place = running?.runner.live.holdPlace ?? null;
    return place === null ? null : jobPlace(place);
  }

  #runnerOf(id: string, states: readonly Job["state"][], verb: string): Runner {
    const job = this.#book.get(id);
    const running = this.#running.get(job.plotterId);
    if (running?.jobId !== id || !states.includes(job.state)) {
      throw new PlotwrightError("conflict", `"${job.name}" is ${job.state}, so it can't be ${verb} now.`);
    }
    return running.runner;
  }

  /** The job's plotter, when it is there and has no other job. */
  #freePlotter(id: string): PlotterPort {
    if (this.#closing) throw new PlotwrightError("conflict", "The server is stopping.");
    const plotter = plotterOf(this.#parts, this.#book.get(id).plotterId);
    const other = this.#running.get(plotter.id);
    if (other !== undefined && other.jobId !== id) {
      throw new PlotwrightError(
        "busy",
        `"${this.#book.get(other.jobId).name}" is on the plotter. Wait for it to end, or cancel it.`,
      );
    }
    mustBeThere(plotter);
    return plotter;
  }
}

/** Throws `not-found`. */
export function plotterOf({ plotters }: Pick<QueueParts, "plotters">, id: string): PlotterPort {
  const plotter = plotters.get(id);
  if (plotter === undefined) throw new PlotwrightError("not-found", `There is no plotter ${id}.`);
  return plotter;
}

function penWords({ penName, layerName }: PlotWait): string {
  return penName === null ? `Put in the pen for "${layerName}".` : `Put in "${penName}" for "${layerName}".`;
}

const jobPlace = ({ stroke, alongMm }: Place): JobPlace => ({ strokeIndex: stroke, alongMm });

const canGoOn = (error: Error): boolean =>
  error instanceof PlotwrightError && INTERRUPTIONS.includes(error.code);

/** What Store.journal gives back: written by this program, but perhaps by another version of it. */
const placeSchema = z.object({ stroke: z.int().min(0), alongMm: z.number().min(0) });
const journalSchema = z.object({ place: placeSchema, sent: placeSchema.optional() });
const journalProgressSchema = z.object({
  progress: z.number().min(0).max(1),
  elapsedS: z.number().min(0),
  remainingS: z.number().min(0).nullable(),
});

function mustBeThere(plotter: PlotterPort): void {
  const { connection, message, name } = plotter.snapshot();
  if (connection === "idle") return;
  if (connection === "busy") throw new PlotwrightError("busy", `${name} is busy. Wait for it to finish.`);
  throw new PlotwrightError("no-board", message ?? `${name} is not connected. Plug it in and switch it on.`);
}
