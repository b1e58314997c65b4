/** The queue: all operations on jobs, for all plotters. Every change is on disk before it is announced. */
import { PlotwrightError } from "../../src/index.js";
import {
  machineOf,
  firmwareFor,
  isPlannedAlike,
  isSameJson,
  motionForSprings,
  needsNewPaper,
} from "../../src/internal.js";
import {
  ENDED_STATES,
  queueSettingsSchema,
  type HandMoveRequest,
  type HistoryRequest,
  type Job,
  type JobChange,
  type JobPage,
  type JobPatch,
  type PlotSettings,
  type QueueSettings,
  type Submitter,
} from "../../src/schema/index.js";
import type { Requester } from "../planning/lane.js";
import { expectedS, timeRatio } from "./expected-time.js";
import type { SettingsOfPlotter } from "../plotter/settings-of-plotter.js";
import { findPlotter } from "./find-plotter.js";
import { JobList } from "./job-list.js";
import { mustFit, SettingsOfJobs } from "./job-settings.js";
import { LiveJobs } from "./live-jobs.js";
import { applyJobEvent, isOnPlotter, queuedJob } from "./job-states.js";
import { NEW_PAPER, sheetsOf } from "./job-words.js";
import { RunningPlots } from "./running-plots.js";
import type { NewQueueJob, QueueParts } from "./queue-parts.js";

/** On its plotter, with its settings. */
type PlacedJob = Pick<Job, "plotterId" | "settings">;

/** Waiting jobs of one device or key that may only submit jobs. */
const MAX_SUBMITTED = 20;

export class JobQueue {
  /** The jobs that are on a plotter: pause, resume, cancel and the like. */
  readonly plots: RunningPlots;
  readonly live: LiveJobs;
  private readonly jobs: JobList;
  private readonly jobSettings: SettingsOfJobs;
  /** Starts in progress, by job id. */
  private readonly beginning = new Map<string, Promise<Job | string>>();

  /** Loads the stored jobs; a job that was plotting when the server ended becomes interrupted. */
  constructor(private readonly parts: QueueParts) {
    this.jobs = new JobList(parts);
    this.jobSettings = new SettingsOfJobs(parts, this.jobs);
    this.plots = new RunningPlots(parts, this.jobs, this.jobSettings, (job) => this.done(job));
    this.live = new LiveJobs(parts, this.jobs, this.jobSettings, this.plots);
  }

  /** Queue order first, then history, newest first. */
  list(): Job[] {
    return this.jobs.list();
  }

  /** The whole queue, and the newest 50 jobs of the history: of all, or of one submitter. */
  recent(submitterId?: string): JobPage {
    return this.jobs.recent(submitterId);
  }

  /** The next 50 jobs of the history. Throws `not-found` if there is no job `after`. */
  older(wanted: HistoryRequest, submitterId?: string): JobPage {
    return this.jobs.older(wanted, submitterId);
  }

  /** Throws `not-found`. To a submitter, the jobs of others do not exist. */
  get(id: string, submitterId?: string): Job {
    return this.jobs.getFor(id, submitterId);
  }

  /** The settings of one plotter; default: the first one. */
  settings(plotterId = this.firstPlotter()): QueueSettings {
    const stored = queueSettingsSchema.safeParse(this.parts.store.setting(settingOf(plotterId)));
    return stored.success ? stored.data : { runOn: false };
  }

  /** The settings from which jobs and manual moves of a plotter start. */
  settingsOf(plotterId: string): SettingsOfPlotter {
    return this.jobSettings.of(plotterId);
  }

  /** The settings of a manual move: the plotter's, with what the caller gives. Throws `bad-setting`. */
  handSettings(plotterId: string, { settings, profile }: HandMoveRequest = {}): PlotSettings {
    const whole = this.jobSettings.with(plotterId, settings).settings;
    if (profile === undefined) return whole;
    const motion = motionForSprings(whole.motion, machineOf(whole).springs ?? null, profile.springs ?? null);
    return { ...whole, machine: profile.id, customMachine: profile, motion };
  }

  allSettings(): Record<string, QueueSettings> {
    return Object.fromEntries([...this.parts.plotters.keys()].map((id) => [id, this.settings(id)]));
  }

  saveSettings(settings: QueueSettings, plotterId = this.firstPlotter()): QueueSettings {
    findPlotter(this.parts.plotters, plotterId);
    this.parts.store.saveSetting(settingOf(plotterId), settings);
    if (plotterId === this.firstPlotter()) this.parts.announce({ type: "queue", queue: settings });
    this.parts.announce({ type: "queues", queues: this.allSettings() });
    return settings;
  }

  /** Adds a queued copy with the same drawing and settings: directly after a queued job, otherwise last. */
  duplicate(id: string): Job {
    const job = this.get(id);
    this.mustHaveRoom(job.submittedBy, 1);
    const waiting = this.jobs.order().filter((queuedId) => this.get(queuedId).state === "queued");
    const beforeId = job.state === "queued" ? (waiting[waiting.indexOf(id) + 1] ?? null) : null;
    const copy = this.newJob({ ...job, plotterId: this.existingPlotter(job) });
    return this.jobs.insert([copy], { id: this.parts.store.drawingOf(id), bytes: 0 }, { beforeId });
  }

  /**
   * Plans the drawing to check that it can be plotted, then appends it. Returns the first job if it adds several. If
   * planning throws, the drawing is removed.
   */
  async add(wanted: NewQueueJob, requester: Requester = {}): Promise<Job> {
    try {
      return await this.addJob(wanted, requester);
    } catch (error) {
      await this.discard(wanted.drawing.id);
      throw error;
    }
  }

  private async addJob(wanted: NewQueueJob, requester: Requester): Promise<Job> {
    const { drawing, from, submittedBy, plotterId = this.firstPlotter(), copies = 1 } = wanted;
    findPlotter(this.parts.plotters, plotterId);
    this.mustHaveRoom(submittedBy, copies);
    const { settings, note } =
      wanted.sharedId === undefined
        ? this.jobSettings.with(plotterId, wanted.settings)
        : this.jobSettings.withForeign(plotterId, wanted.settings);
    mustFit(settings);
    const jobs: Job[] = [];
    const sheets = sheetsOf(wanted.name, settings);
    let fault: unknown = null;
    for (const sheet of sheets) {
      try {
        const job = await this.measured({ ...wanted, ...sheet, plotterId }, note, requester);
        jobs.push({ ...job, place: from ?? null });
      } catch (error) {
        // A part of the drawing without lines needs no sheet.
        const isBlank = error instanceof PlotwrightError && error.code === "bad-file";
        if (!isBlank || sheets.length === 1) throw error;
        fault = error;
      }
    }
    if (jobs.length === 0) throw fault;
    if (from && sheets.length > 1) {
      throw new PlotwrightError(
        "bad-setting",
        `The drawing is on ${sheets.length} sheets, so it can only start at the beginning. Choose one sheet ("tile" in the settings).`,
      );
    }
    // The plotter may have been removed meanwhile.
    findPlotter(this.parts.plotters, plotterId);
    this.mustHaveRoom(submittedBy, copies * jobs.length);
    return this.jobs.insert(jobs, drawing, { ...wanted, copies });
  }

  /** A new job, once its drawing is planned. */
  private async measured(
    { name, settings, drawing, from, submittedBy, plotterId }: PlacedJob & NewQueueJob,
    note: string | null,
    requester: Requester,
  ): Promise<Job> {
    const firmware = this.firmwareOf(plotterId, settings);
    const { stats, warnings } = await this.parts.planning.measure(drawing.id, settings, firmware, requester);
    if (from && from.strokeIndex >= stats.strokeCount) {
      throw new PlotwrightError(
        "bad-setting",
        `The drawing has ${stats.strokeCount} strokes, so it can't start at number ${from.strokeIndex + 1}.`,
      );
    }
    return this.newJob({ plotterId, name, settings, stats, warnings: noted(note, warnings), submittedBy });
  }

  /**
   * The name can change at any time; settings and plotter only while queued. Throws if the settings can't be
   * planned, and `conflict` if settings or plotter were changed meanwhile.
   */
  async patch(id: string, patch: JobPatch, requester: Requester = {}): Promise<Job> {
    const { name, settings, plotterId } = patch;
    if (plotterId !== undefined) this.jobs.mustBeQueued(id, "Its plotter");
    if (settings !== undefined) this.jobs.mustBeQueued(id, "Its settings");
    if (plotterId !== undefined) findPlotter(this.parts.plotters, plotterId);
    const planned = await this.remeasured(id, patch, requester);
    // The plotter may have been removed meanwhile.
    if (plotterId !== undefined) findPlotter(this.parts.plotters, plotterId);
    const job = {
      ...this.get(id),
      ...planned,
      ...(name === undefined ? {} : { name }),
      ...(plotterId === undefined ? {} : { plotterId }),
    };
    return this.jobs.save(job.state === "queued" ? { ...job, expectedS: this.expectedS(job) } : job);
  }

  /** The figures of a job after its settings or plotter change; empty if they stay the same. */
  private async remeasured(id: string, patch: JobPatch, requester: Requester): Promise<Partial<Job>> {
    const { settings, plotterId } = patch;
    if (settings === undefined && plotterId === undefined) return {};
    const job = this.get(id);
    const { settings: wanted, note } = this.jobSettings.changed(job, patch);
    mustFit(wanted);
    if (settings !== undefined) mustKeepStrokes(job, wanted);
    const firmware = this.firmwareOf(plotterId ?? job.plotterId, wanted);
    const before = this.firmwareOf(job.plotterId, wanted);
    if (isSameJson(job.settings, wanted) && isPlannedAlike(machineOf(wanted), wanted.pen, firmware, before)) {
      return {};
    }
    const drawing = this.parts.store.drawingOf(id);
    const { stats, warnings } = await this.parts.planning.measure(drawing, wanted, firmware, requester);
    mustBeSame(job, this.jobs.mustBeQueued(id, settings === undefined ? "Its plotter" : "Its settings"));
    return { settings: wanted, stats, warnings: noted(note, warnings), remainingS: stats.durationS };
  }

  /** The firmware of the plotter's board; null if it is unknown, or if the settings' machine has another controller. */
  private firmwareOf(plotterId: string, settings: PlotSettings): string | null {
    return firmwareFor(machineOf(settings), this.parts.plotters.get(plotterId)?.snapshot().firmware ?? null);
  }

  move(id: string, beforeId: string | null): void {
    this.jobs.mustBeQueued(id, "Its place");
    this.parts.store.moveJob(id, beforeId);
    this.jobs.announceOrder();
  }

  /** Puts an ended job at the end of the queue again, with the same settings. */
  requeue(id: string): Job {
    const job = this.get(id);
    const { stats } = job;
    const plotterId = this.existingPlotter(job);
    // Check first: a job that is already queued must not lose its place in the queue.
    applyJobEvent(job, { type: "requeue" }, this.parts.nowIso());
    this.mustHaveRoom(job.submittedBy, 1);
    this.parts.store.moveJob(id, null);
    return this.jobs.apply(
      id,
      { type: "requeue" },
      {
        plotterId,
        remainingS: stats?.durationS ?? null,
        expectedS: this.expectedS({ plotterId, stats }),
      },
    );
  }

  async remove(id: string): Promise<void> {
    const job = this.get(id);
    if (isOnPlotter(job)) {
      throw new PlotwrightError("conflict", `"${job.name}" is ${job.state}. Cancel it before removing it.`);
    }
    const unused = this.jobs.remove(id);
    this.parts.onRemoved?.(id);
    if (unused !== null) await this.discard(unused);
  }

  /** Not an error: the job is gone or was not added, and the next start clears away a file that is left. */
  private async discard(drawingId: string): Promise<void> {
    try {
      await this.parts.files.remove(drawingId);
    } catch (error) {
      this.parts.log?.(`the drawing ${drawingId} could not be removed: ${(error as Error).message}`);
    }
  }

  /** Id of the job's stored drawing. */
  drawingOf(id: string): string {
    return this.parts.store.drawingOf(id);
  }

  /** Whether the job is on a plotter now; false for an unknown id. */
  isRunning(id: string): boolean {
    return this.jobs.has(id) && isOnPlotter(this.get(id));
  }

  /** Number of a plotter's jobs that have not ended. */
  liveJobCount(plotterId: string): number {
    return this.list().filter((job) => job.plotterId === plotterId && !ENDED_STATES.includes(job.state))
      .length;
  }

  isPlotterBusy(plotterId: string): boolean {
    return this.plots.isBusy(plotterId);
  }

  /** Whether a waiting job starts when its plotter is free, without anybody who changes the paper. */
  startsByItself({ plotterId, settings }: Pick<Job, "plotterId" | "settings">): boolean {
    if (!this.settings(plotterId).runOn) return false;
    const last = this.list().find(
      (job) => job.plotterId === plotterId && ENDED_STATES.includes(job.state) && job.startedAt !== null,
    );
    return last === undefined || !needsNewPaper(last.settings.prepare, settings.prepare);
  }

  /**
   * A job of the shared queue starts only once it is certain that no other server has it. Rejects with `busy`
   * while its plotter is plotting another job, and with `conflict` when another server has or may have the
   * job.
   */
  async start(id: string): Promise<Job> {
    const started = await this.begin(id);
    if (typeof started === "string") throw new PlotwrightError("conflict", started);
    return started;
  }

  /**
   * Resolves when it is known whether the job's plotter is connected, which takes a moment after the server
   * starts.
   */
  async plotterSettled(id: string): Promise<void> {
    await findPlotter(this.parts.plotters, this.get(id).plotterId).settled();
  }

  async change(id: string, change: JobChange): Promise<Job> {
    mustFit(change);
    return this.plots.change(id, change);
  }

  /** Stops all plots (the pen lifts and goes home) and waits for them; their jobs become interrupted. */
  async close(): Promise<void> {
    await this.plots.stop();
    await this.live.close();
    this.jobs.close();
  }

  /** Returns the job, or why it must not start here. Two calls at the same time share one start. */
  private begin(id: string): Promise<Job | string> {
    const running = this.beginning.get(id);
    if (running !== undefined) return running;
    const begun = this.claimAndStart(id).finally(() => this.beginning.delete(id));
    this.beginning.set(id, begun);
    return begun;
  }

  private async claimAndStart(id: string): Promise<Job | string> {
    const { claims } = this.parts;
    if (claims === undefined) return this.plots.start(id);
    this.plots.mustBeStartable(id);
    const refusal = await claims.claim(id);
    if (refusal !== null) return refusal;
    try {
      return this.plots.start(id);
    } catch (error) {
      // During the claim the plotter may have become busy, or the job may have been removed.
      await claims.release(id);
      throw error;
    }
  }

  private done(job: Job): void {
    const { plotterId } = job;
    this.jobs.updateExpected(plotterId, timeRatio(this.list(), plotterId));
    if (!this.settings(plotterId).runOn || this.plots.isClosing) return;
    // A full disk stores neither the start nor the message why the job did not start. That must not end the server.
    this.startNext(plotterId).catch((error: unknown) => {
      this.parts.log?.(
        `the next job can't be started: ${error instanceof Error ? error.message : String(error)}`,
      );
    });
  }

  /**
   * Starts the next queued job of a plotter whose queue runs automatically. A job that another server may have is
   * skipped, and the next one starts.
   */
  private async startNext(plotterId: string): Promise<void> {
    const waiting = this.list().filter((job) => job.plotterId === plotterId && job.state === "queued");
    for (const next of waiting) {
      const { id } = next;
      if (!this.startsByItself(next)) return this.note(id, NEW_PAPER);
      try {
        const begun = await this.begin(id);
        if (typeof begun !== "string") return;
        this.note(id, begun);
      } catch (error) {
        this.note(id, error instanceof Error ? error.message : String(error));
        return;
      }
    }
  }

  /** Does nothing if the job was removed meanwhile or the server is closing. */
  private note(id: string, message: string): void {
    if (!this.plots.isClosing && this.jobs.has(id)) this.jobs.note(id, message);
  }

  /** Throws `conflict`: nobody who may only submit jobs fills the queue, or the disk. */
  private mustHaveRoom(submitter: Submitter | undefined, moreCount = 1): void {
    if (submitter === undefined) return;
    const waiting = this.list().filter(
      ({ state, submittedBy }) => state === "queued" && submittedBy?.id === submitter.id,
    );
    if (waiting.length + moreCount <= MAX_SUBMITTED) return;
    throw new PlotwrightError(
      "conflict",
      `${waiting.length} jobs of ${submitter.name} are waiting, and there may be ${MAX_SUBMITTED}. Remove some, or wait until they are plotted.`,
    );
  }

  private newJob(
    from: Pick<Job, "plotterId" | "name" | "settings" | "stats" | "warnings" | "submittedBy">,
  ): Job {
    return { ...queuedJob(from, this.parts.nowIso()), expectedS: this.expectedS(from) };
  }

  private expectedS({ plotterId, stats }: Pick<Job, "plotterId" | "stats">): number | null {
    return expectedS(stats, timeRatio(this.list(), plotterId));
  }

  /** The job's plotter, or the first one if that plotter was removed. */
  private existingPlotter({ plotterId }: Job): string {
    return this.parts.plotters.has(plotterId) ? plotterId : this.firstPlotter();
  }

  /** Id of the plotter for jobs that name none. */
  firstPlotter(): string {
    const first = [...this.parts.plotters.keys()][0];
    if (first === undefined) throw new PlotwrightError("no-board", "There is no plotter.");
    return first;
  }
}

const noted = (note: string | null, warnings: readonly string[]): string[] =>
  note === null ? [...warnings] : [note, ...warnings];

const settingOf = (plotterId: string): string => `queue:${plotterId}`;

/** A job stores its first stroke by number. With other preparation settings the number would mean another stroke. */
function mustKeepStrokes(job: Job, settings: PlotSettings): void {
  if (job.place === null || isSameJson(job.settings.prepare, settings.prepare)) return;
  throw new PlotwrightError(
    "conflict",
    `"${job.name}" starts at stroke ${job.place.strokeIndex + 1}, so its layout can't be changed. Add a new job instead.`,
  );
}

/**
 * Throws `conflict` if settings or plotter changed while the job was measured. The figures would be wrong, and an older
 * change would replace a newer one.
 */
function mustBeSame(before: Job, now: Job): void {
  if (before.settings === now.settings && before.plotterId === now.plotterId) return;
  throw new PlotwrightError(
    "conflict",
    `"${now.name}" was changed meanwhile, so this change was not made. Check the job, then try again.`,
  );
}
