/**
 * The plots that are running, at most one per plotter. Opens the job's planner, passes it to the plotter, applies the
 * reports of the run to the job, and passes requests for the job to the run.
 */
import { PlotwrightError, type StrokePosition } from "../../src/index.js";
import {
  ENDED_STATES,
  type Job,
  type JobChange,
  type JobPlace,
  type MovePlace,
  type PlaceOnPaper,
  type PlotWait,
} from "../../src/schema/index.js";
import { isOtherBoard } from "../plotter/board-id.js";
import { liveEnded, livePlanner, liveStopped, type LiveStrokes } from "../plotter/live-strokes.js";
import type {
  RunningPlot,
  PlotOutcome,
  ReportedProgress,
  PlotStart,
  PlotterPort,
} from "../plotter/plotter-port.js";
import { isDiskFault } from "../disk-fault.js";
import type { JobList } from "./job-list.js";
import type { SettingsOfJobs } from "./job-settings.js";
import { applyJobEvent, canContinue, isOnPlotter, jobPlace } from "./job-states.js";
import { findPlotter, mustBeIdle } from "./find-plotter.js";
import { PlotJournals } from "./plot-journals.js";
import type { QueueParts } from "./queue-parts.js";
import { MotionTimer } from "./expected-time.js";
import { penWords, recoveredWords, SERVER_STOPPED, stoppedJob } from "./job-words.js";

interface Running {
  readonly job: Job;
  readonly plotter: PlotterPort;
  readonly timer: MotionTimer;
  /** Null: the drawing is complete. */
  readonly live: LiveStrokes | null;
  /** What may be seen on the paper; the job's message has it also at the end. The last ones only. */
  readonly notes: string[];
  /** Aborted when the plot is cancelled or left. */
  readonly abort: AbortController;
  /** Why it is paused or being paused, if no user has asked for it. */
  pauseWords: string | null;
  /** Ended because the program stops. */
  isLeft: boolean;
  isStopped: boolean;
  /** Null while the plot is still being planned. */
  run: RunningPlot | null;
  /** Resolves when `run` exists, or the plot has ended before; `setPlanned` resolves it. */
  readonly planned: Promise<void>;
  readonly setPlanned: () => void;
  /** Whether the run begins held. Once it exists, it knows itself what the user wants. */
  beginsHeld: boolean;
  /** Settles after the end has been applied to the job; never rejects. */
  finished: Promise<void>;
}
const MAX_NOTES = 5;

type PlotEnd = PlotOutcome | { readonly kind: "failed"; readonly error: Error };

export class RunningPlots {
  /** By plotter id. */
  private readonly running = new Map<string, Running>();
  /** No plot begins any more. */
  isClosing = false;
  private lastFault: string | null = null;
  private readonly journals: PlotJournals;

  /** A job that was plotting when the server ended becomes interrupted. `done`: called for each completed plot. */
  constructor(
    private readonly parts: QueueParts,
    private readonly jobs: JobList,
    private readonly settings: SettingsOfJobs,
    private readonly done: (job: Job) => void,
  ) {
    this.journals = new PlotJournals(parts.store, jobs);
    for (const job of jobs.list()) if (isOnPlotter(job)) this.interrupt(job.id, this.stopped);
  }

  private get stopped(): string {
    return this.parts.stoppedMessage ?? SERVER_STOPPED;
  }

  isBusy(plotterId: string): boolean {
    return this.running.has(plotterId);
  }

  /** Throws the errors that `start` would throw. */
  mustBeStartable(id: string): void {
    this.freePlotter(this.jobs.get(id));
    applyJobEvent(this.jobs.get(id), { type: "start" }, this.parts.nowIso());
  }

  /** Throws `busy` while the job's plotter is plotting another job. */
  start(id: string): Job {
    const plotter = this.freePlotter(this.jobs.get(id));
    // The journal of an earlier plot of this job, which was interrupted and queued again.
    this.parts.store.clearJournal(id);
    const started = this.jobs.apply(id, { type: "start" }, this.settings.onPlotter(this.jobs.get(id)));
    this.begin(plotter, started);
    return started;
  }

  /** Starts a job whose strokes are still being received. */
  startLive(id: string, live: LiveStrokes): Readonly<Pick<Running, "job" | "pauseWords" | "finished">> {
    const plotter = this.freePlotter(this.jobs.get(id));
    return this.begin(plotter, this.jobs.apply(id, { type: "start" }), live);
  }

  /** Starts an interrupted or cancelled job at its place, held: nothing moves until it is resumed. */
  recover(id: string): Job {
    const { place: from } = this.jobs.get(id);
    const plotter = this.freePlotter(this.jobs.get(id));
    const { board } = this.journals.of(id) ?? {};
    const found = plotter.snapshot();
    const job = this.jobs.apply(
      id,
      { type: "recover" },
      { ...this.settings.onPlotter(this.jobs.get(id)), place: from ?? { strokeIndex: 0, alongMm: 0 } },
    );
    this.journals.keepPlace({ id, place: from });
    this.begin(plotter, job).timer.hold(this.parts.nowIso());
    const isOther = board !== undefined && isOtherBoard(board, found);
    const position = isOther ? "other" : found.xMm === null ? "lost" : "known";
    return this.jobs.note(id, recoveredWords(job, position, found));
  }

  /** Changes pen heights and speeds of a job that is plotting or held. While it is being planned the run gets them later. */
  async change(id: string, change: JobChange): Promise<Job> {
    const { run } = this.runningOf(id, ["plotting", "paused"], "changed");
    const { pen, motion, speedPct } = change;
    const whole = this.settings.changed(this.jobs.get(id), { settings: { pen, motion } }).settings;
    const now = { ...(pen && { pen: whole.pen }), ...(motion && { motion: whole.motion }) };
    if (run !== null) await run.change({ ...now, speedPct });
    const job = this.jobs.get(id);
    const settings = { ...job.settings, ...now };
    return this.jobs.save({ ...job, settings, speedPct: speedPct ?? job.speedPct });
  }

  /** Stops without slowing down; afterwards the job is held. While it is still being planned nothing moves. */
  async emergencyStop(id: string): Promise<Job> {
    const running = this.runningOf(id, ["plotting", "paused"], "stopped");
    running.pauseWords = null;
    if (running.run === null) {
      running.beginsHeld = true;
      return this.jobs.get(id);
    }
    running.isStopped = true;
    await running.run.emergencyStop();
    const job = this.jobs.get(id);
    // A paused plot was held already.
    if (job.state !== "paused" || job.stopped) return job;
    return this.jobs.save({ ...job, ...stoppedJob(running.plotter.snapshot()) });
  }

  /** Moves the place from which a held job will resume. */
  movePlace(id: string, by: MovePlace): Job {
    const place = this.liveRun(id, "moved along").moveHoldPlace(by);
    return this.jobs.save({ ...this.jobs.get(id), place: jobPlace(place) });
  }

  /** Where such a move would lead. Waits while the plot is still being planned: a page asks as soon as it is paused. */
  async placeAfter(id: string, by: MovePlace): Promise<PlaceOnPaper> {
    await this.runningOf(id, ["paused"], "moved along").planned;
    const { x, y, ...place } = this.liveRun(id, "moved along").placeAfter(by);
    return { ...jobPlace(place), xMm: x, yMm: y };
  }

  /** Travels to the place of a held job with the pen up. */
  async checkPlace(id: string): Promise<Job> {
    await this.liveRun(id, "checked").checkHoldPlace();
    return this.jobs.get(id);
  }

  /** Lifts or lowers the pen of a job that waits for another one, so that this can be set on the paper. */
  async movePen(id: string, up: boolean): Promise<Job> {
    const { name, wait } = this.jobs.get(id);
    if (!wait) throw new PlotwrightError("conflict", `"${name}" does not wait for another pen.`);
    await this.liveRun(id, "given another pen").movePenAtHold(up);
    return this.jobs.get(id);
  }

  /** `why`: what the job says while it is paused, if the user has not asked for it. */
  pause(id: string, why: string | null = null): Job {
    const running = this.runningOf(id, ["plotting"], "paused");
    running.pauseWords = why;
    this.jobs.note(id, why ?? "Pausing: the pen finishes what it is drawing, then lifts.");
    if (running.run === null) running.beginsHeld = true;
    else this.ask(running, running.run.pause());
    return this.jobs.get(id);
  }

  resume(id: string): Job {
    const running = this.runningOf(id, ["paused"], "resumed");
    running.pauseWords = null;
    if (running.run === null) running.beginsHeld = false;
    else this.ask(running, this.resumeRun(running, running.run));
    return this.jobs.note(id, "Resuming.");
  }

  cancel(id: string): Job {
    const running = this.running.get(this.jobs.get(id).plotterId);
    if (running?.job.id !== id) return this.cancelled(id);
    running.pauseWords = null;
    running.abort.abort();
    if (running.run !== null) this.ask(running, running.run.cancel());
    return this.jobs.note(id, "Cancelling: the pen lifts and goes home.");
  }

  /**
   * Stops all plots (the pen lifts and goes home) and waits for them; their jobs become interrupted. A held plot stays
   * where it is: it must not move until the user resumes it.
   */
  async stop(): Promise<void> {
    this.isClosing = true;
    const running = [...this.running.values()];
    for (const one of running) this.leave(one);
    await Promise.all(running.map(({ finished }) => finished));
  }

  private begin(plotter: PlotterPort, job: Job, live: LiveStrokes | null = null): Running {
    let setPlanned = (): void => undefined;
    const planned = new Promise<void>((resolve) => (setPlanned = resolve));
    const running: Running = {
      job,
      plotter,
      planned,
      setPlanned,
      timer: new MotionTimer(this.parts.nowIso(), job.plottedS ?? 0),
      live,
      notes: [],
      abort: new AbortController(),
      pauseWords: null,
      isLeft: false,
      isStopped: false,
      run: null,
      beginsHeld: job.place !== null,
      finished: Promise.resolve(),
    };
    this.running.set(plotter.id, running);
    running.finished = this.follow(running);
    return running;
  }

  /** Plots, and applies the end to the job. */
  private async follow(running: Running): Promise<void> {
    const end = await this.plot(running).catch((error: unknown): PlotEnd => {
      const wanted =
        running.abort.signal.aborted && error instanceof PlotwrightError && error.code === "cancelled";
      return wanted
        ? { kind: "cancelled" }
        : { kind: "failed", error: error instanceof Error ? error : new Error(String(error)) };
    });
    running.run = null;
    running.setPlanned();
    running.live?.fail(end.kind === "failed" ? end.error : end.kind === "done" ? liveEnded() : liveStopped());
    this.safely(running.job.id, () => this.ended(running, end));
  }

  private async plot(running: Running): Promise<PlotOutcome> {
    const { job, plotter, abort, live } = running;
    const { id, settings, place } = job;
    const from = place === null ? null : { stroke: place.strokeIndex, alongMm: place.alongMm };
    // An interrupted plot may have left the pen on the paper. So its planner is opened even after a cancel: cancelling
    // the run then lifts the pen.
    const signal = from === null ? abort.signal : new AbortController().signal;
    const { planning, store } = this.parts;
    const planner = live ? livePlanner(live) : await planning.open(store.drawingOf(id), settings, signal);
    try {
      const held = running.beginsHeld;
      const run = await plotter.plot(planner, settings, { from, held, ...this.startOf(running, from) });
      running.run = run;
      running.setPlanned();
      run.onProgress((progress) => this.progress(id, plotter.id, progress));
      run.onHeld((isHeld, wait = null) => this.safely(id, () => this.held(id, isHeld, wait)));
      // Requests that came before the run existed.
      if (abort.signal.aborted) this.ask(running, running.isLeft ? run.leave() : run.cancel());
      else if (running.beginsHeld && !held) this.ask(running, run.pause());
      else if (!running.beginsHeld && from !== null) this.ask(running, this.resumeRun(running, run));
      const { settings: now, speedPct } = this.jobs.get(id);
      const isChanged = now.pen !== settings.pen || now.motion !== settings.motion || speedPct !== 100;
      if (isChanged) this.ask(running, run.change({ pen: now.pen, motion: now.motion, speedPct }));
      return await run.finished;
    } finally {
      await planner.close();
    }
  }

  /** What the plotter gets besides the place where the run starts. */
  private startOf({ job: { id }, live, notes }: Running, from: StrokePosition | null): PlotStart {
    const entry = this.journals.of(id);
    // `received` belongs to the journal's place. Nothing was drawn after another place, which the user has chosen.
    const isJournalPlace = entry?.place.stroke === from?.stroke && entry?.place.alongMm === from?.alongMm;
    return {
      live: live ?? undefined,
      ...(isJournalPlace ? entry : { board: entry?.board }),
      journal: { record: (written) => this.safely(id, () => this.journals.save(id, written)) },
      noted: (message) => {
        notes.push(message);
        if (notes.length > MAX_NOTES) notes.shift();
        this.safely(id, () => void this.jobs.note(id, message));
      },
    };
  }

  /** A recovered job is paused before its run is held, and the run does not report that it was never held. */
  private async resumeRun({ job, abort }: Running, run: RunningPlot): Promise<void> {
    await run.resume();
    if (!abort.signal.aborted) this.safely(job.id, () => this.held(job.id, false, null));
  }

  /** A cancelled plot is already about to end. */
  private leave(running: Running): void {
    if (running.abort.signal.aborted) return;
    running.isLeft = true;
    running.abort.abort();
    if (running.run !== null) this.ask(running, running.run.leave());
  }

  /** A request that can't be carried out is reported; the plot itself continues. */
  private ask(running: Running, request: Promise<void>): void {
    request.catch((error: unknown) => {
      if (running.run === null) return;
      const message = error instanceof Error ? error.message : String(error);
      this.safely(running.job.id, () => void this.jobs.note(running.job.id, message));
    });
  }

  /** A full disk must neither stop the pen in mid-stroke nor end the server: it may soon have room again. */
  private safely(jobId: string, write: () => void): void {
    try {
      write();
      this.lastFault = null;
    } catch (error) {
      const fault = error instanceof Error ? error.message : String(error);
      if (fault !== this.lastFault) this.parts.log?.(`the state of a plot can't be stored: ${fault}`);
      this.lastFault = fault;
      if (isDiskFault(error)) this.jobs.diskIsFull(jobId);
    }
  }

  private progress(jobId: string, plotterId: string, report: ReportedProgress): void {
    // The travel home of a cancelled plot is not progress of the drawing.
    if (this.running.get(plotterId)?.abort.signal.aborted !== true) {
      const { progress: share, elapsedS, remainingS } = report;
      this.jobs.progressed(jobId, { progress: share, elapsedS, remainingS });
      this.parts.onProgress?.(this.jobs.get(jobId));
    }
    this.parts.announce({ type: "progress", jobId, plotterId, ...report, heldBackMs: 0 });
  }

  /** If an interrupted job waited for a pen, it still waits for that pen until it is resumed. */
  private held(id: string, held: boolean, wait: PlotWait | null): void {
    const job = this.jobs.get(id);
    const running = this.running.get(job.plotterId);
    // Released only to go home: the job keeps its place and the pen that it waits for.
    if (running?.abort.signal.aborted === true) return;
    if (held && job.state === "plotting") {
      running?.timer.hold(this.parts.nowIso());
      const waitsFor = wait ?? job.wait;
      const message = waitsFor === null ? (running?.pauseWords ?? null) : penWords(waitsFor);
      const why = running?.isStopped === true ? stoppedJob(running.plotter.snapshot()) : { message };
      this.jobs.apply(id, { type: "hold" }, { place: this.holdPlace(running), wait: waitsFor, ...why });
    } else if (held && job.state === "paused") {
      // A recovered job: only now has the board reported where it stopped.
      const place = this.holdPlace(running);
      const isNewWait = wait !== null && wait.layerName !== job.wait?.layerName;
      this.jobs.save({ ...job, place, ...(isNewWait ? { wait, message: penWords(wait) } : {}) });
    } else if (!held && job.state === "paused") {
      running?.timer.release(this.parts.nowIso());
      if (running) running.isStopped = false;
      this.journals.keepPlace(job);
      this.jobs.apply(id, { type: "release" }, { place: null });
    }
  }

  private ended(running: Running, end: PlotEnd): void {
    this.running.delete(running.plotter.id);
    const { notes } = running;
    const { id } = running.job;
    const { store, nowIso } = this.parts;
    const plottedS = running.timer.movedS(nowIso());
    // A plot that is partly on paper must stay recoverable, whatever the error.
    if (end.kind === "failed" && (canContinue(end.error) || store.journal(id) !== undefined)) {
      this.interrupt(id, end.error.message, plottedS);
    } else if (end.kind === "failed") {
      this.jobs.apply(id, { type: "fail", message: end.error.message });
    } else if (end.kind === "cancelled" && running.isLeft) this.interrupt(id, this.stopped, plottedS);
    else if (end.kind === "cancelled") this.cancelled(id, plottedS);
    else {
      // A job may end while paused; `finish` is only allowed from `plotting`, so release it first.
      if (this.jobs.get(id).state === "paused") this.jobs.apply(id, { type: "release" });
      this.jobs.apply(id, { type: "finish" }, { plottedS });
    }
    let job = this.jobs.get(id);
    if (notes.length > 0)
      job = this.jobs.save({ ...job, message: [job.message ?? [], notes].flat().join(" ") });
    this.jobs.announceOrder();
    if (ENDED_STATES.includes(job.state)) store.clearJournal(id);
    if (job.state === "done") this.done(job);
  }

  /** `plottedS`: how long it has plotted. After a crash nobody knows, and the planned time of what is drawn counts. */
  private interrupt(id: string, message: string, plottedS?: number): void {
    const progress = this.journals.progressOf(id);
    const place = this.journals.reachedPlace(id);
    const took = plottedS ?? progress?.elapsedS ?? this.jobs.get(id).plottedS;
    const drawn = place === null ? progress : { ...progress, plottedS: took };
    this.jobs.apply(id, { type: "interrupt", message, place }, drawn);
  }

  /** The place stays with the job, so that the user can continue it there. */
  private cancelled(id: string, plottedS = this.jobs.get(id).plottedS): Job {
    const place = this.journals.reachedPlace(id);
    return this.jobs.apply(id, { type: "cancel", place }, place === null ? {} : { plottedS });
  }

  private holdPlace(running: Running | undefined): JobPlace | null {
    const place = running?.run?.holdPlace ?? null;
    return place === null ? null : jobPlace(running?.live?.wholePlace(place) ?? place);
  }

  /** The run of a held job for requests that need one; throws `conflict` while it is still being planned. */
  private liveRun(id: string, verb: string): RunningPlot {
    const { run, live } = this.runningOf(id, ["paused"], verb);
    if (live !== null) {
      throw new PlotwrightError("conflict", `A live drawing can't be ${verb}: resume or cancel it.`);
    }
    if (run !== null) return run;
    throw new PlotwrightError("conflict", "The plot is still being planned: try again in a moment.");
  }

  private runningOf(id: string, states: readonly Job["state"][], verb: string): Running {
    const job = this.jobs.get(id);
    const running = this.running.get(job.plotterId);
    if (running?.job.id !== id || !states.includes(job.state)) {
      throw new PlotwrightError("conflict", `"${job.name}" is ${job.state}, so it can't be ${verb} now.`);
    }
    return running;
  }

  /** The job's plotter; throws unless it is connected and has no other job. */
  freePlotter({ id, plotterId }: Pick<Job, "plotterId"> & Partial<Pick<Job, "id">>): PlotterPort {
    if (this.isClosing)
      throw new PlotwrightError("conflict", "This plotwright is stopping. Start the job when it runs again.");
    const plotter = findPlotter(this.parts.plotters, plotterId);
    const other = this.running.get(plotter.id);
    if (other !== undefined && other.job.id !== id) {
      throw new PlotwrightError(
        "busy",
        `"${this.jobs.get(other.job.id).name}" is being plotted. Wait until it ends, or cancel it.`,
      );
    }
    mustBeIdle(plotter);
    return plotter;
  }
}
