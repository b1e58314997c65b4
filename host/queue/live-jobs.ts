/**
 * Live drawings as jobs. A live job is on its plotter from the start, and its drawing is stored while it grows. At the end
 * it is a job like others, whose drawing can be plotted again; so it is after a crash, with what was received.
 *
 * If the sender is lost, what was received is the drawing. If all of it is drawn, the job ends. Otherwise it is paused, so
 * that a user decides: resume to draw the rest, or cancel.
 */
import { PlotwrightError } from "../../src/index.js";
import { firmwareFor, machineOf } from "../../src/internal.js";
import {
  DEFAULT_PLOT_SETTINGS,
  ENDED_STATES,
  type Job,
  type LiveBegin,
  type PlotSettings,
} from "../../src/schema/index.js";
import { emptyDrawing, LiveRecord } from "./live-record.js";
import { LiveStrokes } from "../plotter/live-strokes.js";
import type { JobList } from "./job-list.js";
import { mustFit, type SettingsOfJobs } from "./job-settings.js";
import { queuedJob } from "./job-states.js";
import type { QueueParts } from "./queue-parts.js";
import type { RunningPlots } from "./running-plots.js";

const SENDER_SILENT = "The sender of this live drawing does not answer. It goes on when it does.";
const SENDER_LOST =
  "The sender of this live drawing was lost, and the pen was lifted. Resume draws what was received, cancel leaves it out.";

/** A live drawing that has begun. */
export interface LiveJob {
  readonly job: Job;
  readonly strokes: LiveStrokes;
  /** Resolves with the job when it is on the plotter no more. */
  readonly ended: Promise<Job>;
  readonly isPaused: boolean;
  /** Pauses the job while the sender does not answer; false, called whenever it answers: goes on, unless a user has paused or stopped it. */
  hold(isSilent: boolean): void;
  /** Nothing more is received. */
  senderLost(): void;
}

export class LiveJobs {
  /** What is being stored or measured. */
  private readonly finishing = new Set<Promise<unknown>>();

  constructor(
    private readonly parts: QueueParts,
    private readonly jobs: JobList,
    private readonly settings: SettingsOfJobs,
    private readonly plots: RunningPlots,
  ) {
    // Those that were drawn when the program was killed.
    for (const { id, state, stats } of jobs.list()) {
      if (state === "interrupted" && stats === null) this.finish(this.measure(id));
    }
  }

  /** Throws `busy` while the plotter is plotting, and `no-board` if it is not connected. */
  async begin(
    plotterId: string,
    { name = "Live drawing", settings: given, liftAfterMs }: LiveBegin,
  ): Promise<LiveJob> {
    // Shortly after the start, the program is still looking for boards.
    await this.parts.plotters.get(plotterId)?.settled();
    this.plots.freePlotter({ plotterId });
    const { settings: whole, note } = this.settings.with(plotterId, given);
    const settings = asReceived(whole);
    mustFit(settings);
    const machine = machineOf(settings);
    const strokes = new LiveStrokes(machine, liftAfterMs);
    const file = await this.parts.files.grow(emptyDrawing(machine));
    const warnings = note === null ? [] : [note];
    const wanted = { plotterId, name, settings, stats: null, warnings };
    let id: string;
    try {
      // Another job may have begun meanwhile.
      this.plots.freePlotter({ plotterId });
      id = this.jobs.insert([queuedJob(wanted, this.parts.nowIso())], { id: file.id, bytes: 0 }).id;
    } catch (error) {
      await file.close();
      await this.parts.files.remove(file.id);
      throw error;
    }
    const record = new LiveRecord(file, machine, (error) => {
      const fault = error instanceof Error ? error.message : String(error);
      this.parts.log?.(`a live drawing can't be stored any more: ${fault}`);
      this.jobs.note(id, `The drawing ends here, because it can't be stored any more: ${fault}`);
      if (!strokes.isEnded) strokes.end();
    });
    strokes.record = record;
    const running = this.plots.startLive(id, strokes);
    const ended = running.finished.then(() => this.jobs.get(id));
    const stored = ended.then(() => record.close());
    this.finish(stored.then(() => this.measure(id)));
    const isPaused = (): boolean => this.jobs.get(id).state === "paused";
    return {
      job: running.job,
      strokes,
      ended,
      get isPaused() {
        return isPaused();
      },
      hold: (isSilent) => this.hold(id, isSilent, running.pauseWords === SENDER_SILENT),
      senderLost: () => this.senderLost(id, strokes),
    };
  }

  /** Resolves when everything is stored. */
  async close(): Promise<void> {
    await Promise.all(this.finishing);
  }

  /** `isHeld`: it was paused by this, and no user has stopped or resumed it since. */
  private hold(id: string, isSilent: boolean, isHeld: boolean): void {
    const { state } = this.jobs.get(id);
    if (isSilent && state === "plotting" && !isHeld) this.plots.pause(id, SENDER_SILENT);
    else if (!isSilent && state === "paused" && isHeld) this.plots.resume(id);
  }

  private senderLost(id: string, strokes: LiveStrokes): void {
    if (strokes.isEnded || strokes.hasFailed || ENDED_STATES.includes(this.jobs.get(id).state)) return;
    strokes.end();
    if (strokes.isAllDrawn) return;
    if (this.jobs.get(id).state === "plotting") this.plots.pause(id, SENDER_LOST);
    else this.jobs.note(id, SENDER_LOST);
  }

  /** The figures of the drawing, as of any job. */
  private async measure(id: string): Promise<void> {
    const { plotterId, settings } = this.jobs.get(id);
    const firmware = this.parts.plotters.get(plotterId)?.snapshot().firmware ?? null;
    const drawing = this.parts.store.drawingOf(id);
    const measured = await this.parts.planning.measure(
      drawing,
      settings,
      firmwareFor(machineOf(settings), firmware),
    );
    if (!this.jobs.has(id)) return;
    const job = this.jobs.get(id);
    this.jobs.save({ ...job, stats: measured.stats, warnings: [...job.warnings, ...measured.warnings] });
  }

  /** A drawing without strokes can't be measured. */
  private finish(work: Promise<void>): void {
    const done = work.catch((error: unknown) => {
      if (error instanceof PlotwrightError && error.code === "bad-file") return;
      this.parts.log?.(`a live drawing could not be finished: ${(error as Error).message}`);
    });
    this.finishing.add(done);
    void done.then(() => this.finishing.delete(done));
  }
}

/** Settings with which the stored drawing has the strokes as they were received, in their order and place. */
const asReceived = (settings: PlotSettings): PlotSettings => {
  const { paper, landscape } = settings.prepare;
  const { prepare } = DEFAULT_PLOT_SETTINGS;
  return {
    ...settings,
    prepare: {
      ...{ ...prepare, paper, landscape, margins: null, marginMm: 0, fit: false, rotateDeg: 0 },
      ...{ outside: "allow", joinMm: 0, order: "none" },
    },
  };
};
