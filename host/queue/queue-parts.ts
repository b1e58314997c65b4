/** The parts the queue depends on, injected so that tests can control each of them. */
import type {
  GivenSettings,
  Job,
  JobPlace,
  PlotSettings,
  ServerEvent,
  Submitter,
} from "../../src/schema/index.js";
import type { Planning } from "../planning/planning.js";
import type { PlotterPort } from "../plotter/plotter-port.js";
import type { SettingsOfPlotter, WithMachine } from "../plotter/settings-of-plotter.js";
import type { DrawingStore, JobStore, StoredDrawing, WatchedFile } from "../storage.js";

export interface Claims {
  /**
   * Claims a job for this server. Resolves with null when all servers know of the claim, otherwise with the reason why
   * the job must not start. Never rejects.
   */
  claim(jobId: string): Promise<string | null>;
  /** Gives up a claim on a job that did not start. Never rejects. */
  release(jobId: string): Promise<void>;
}

/** Hooks of the plug-ins into changes of jobs. */
export interface JobHooks {
  /** Writes whatever else a job's change requires, in the same transaction. */
  readonly withChange?: ((before: Job | null, after: Job) => void) | undefined;
  /** Called after the change has been announced. */
  readonly afterChange?: (() => void) | undefined;
  /** Called many times a second while a job is plotted. Never throws. */
  readonly onProgress?: ((job: Job) => void) | undefined;
  /** Called after a job was removed. Never throws. */
  readonly onRemoved?: ((jobId: string) => void) | undefined;
  /** With a shared queue: ensures that no other server plots the same job. */
  readonly claims?: Claims | undefined;
}

export interface QueueParts extends JobHooks {
  readonly store: JobStore;
  readonly files: DrawingStore;
  readonly planning: Planning;
  /** By id, in order; plotters may be added and removed while the queue runs. */
  readonly plotters: ReadonlyMap<string, PlotterPort>;
  /** The settings of a plotter; `last`: those of its last job. Default: nothing is set for any plotter. */
  readonly settingsOf?: (plotterId: string, last: PlotSettings | undefined) => SettingsOfPlotter;
  /** Default: there are no custom machines. */
  readonly withMachine?: WithMachine;
  readonly announce: (event: ServerEvent) => void;
  readonly nowIso: () => string;
  /** Why a job that was being plotted when the program ended is interrupted. Default: SERVER_STOPPED. */
  readonly stoppedMessage?: string | undefined;
  /** Logs problems that can't be reported otherwise, such as a full disk during a plot. */
  readonly log?: ((line: string) => void) | undefined;
}

export interface NewQueueJob {
  readonly name: string;
  /** Laid over the settings of the plotter. */
  readonly settings: GivenSettings;
  readonly drawing: StoredDrawing;
  readonly plotterId?: string | undefined;
  /** Where it starts; left out: at the beginning. */
  readonly from?: JobPlace | undefined;
  /** Number of jobs to add; left out: 1. */
  readonly copies?: number | undefined;
  /** Who adds it, if that may only submit jobs. */
  readonly submittedBy?: Submitter | undefined;
  /** The watched file it comes from; marked as handled in the same transaction. */
  readonly watched?: WatchedFile | undefined;
  /** Its id in the shared queue; stored in the same transaction. */
  readonly sharedId?: string | undefined;
}
