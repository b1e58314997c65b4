/** The parts the queue depends on, injected so that tests can control each of them. */
import type { Job, JobStats, PlotSettings, ServerEvent } from "../../src/schema/index.js";
import type { Requester } from "../planning/lane.js";
import type { PlotPlanner } from "../plotter/types.js";
import type { DrawingFiles, StoredDrawing } from "./drawing-files.js";
import type { PlotterPort } from "./plotter-port.js";
import type { Store, WatchedFile } from "./store.js";

export interface Planning {
  /** `firmware` of the board that will plot it; null: unknown. */
  measure(
    drawing: string,
    settings: PlotSettings,
    firmware: string | null,
    requester?: Requester,
  ): Promise<{ readonly stats: JobStats; readonly warnings: readonly string[] }>;
  open(drawing: string, settings: PlotSettings, signal: AbortSignal): Promise<PlotPlanner>;
}

export interface Claims {
  /**
   * Null: the job is now this server's, and all servers know it. Otherwise why it must not start. Never
   * rejects.
   */
  claim(jobId: string): Promise<string | null>;
  /** Gives up a claim on a job that did not start. Never rejects. */
  release(jobId: string): Promise<void>;
}

export interface QueueParts {
  readonly store: Store;
  readonly files: DrawingFiles;
  readonly planning: Planning;
  /** By id, in order; plotters may be added and removed while the queue runs. */
  readonly plotters: ReadonlyMap<string, PlotterPort>;
  readonly announce: (event: ServerEvent) => void;
  readonly nowIso: () => string;
  /** Logs problems that can't be reported otherwise, such as a full disk during a plot. */
  readonly log?: ((line: string) => void) | undefined;
  /** Writes whatever else a job's change requires, in the same transaction. */
  readonly withChange?: ((before: Job | null, after: Job) => void) | undefined;
  /** With a shared queue: ensures that no other server plots the same job. */
  readonly claims?: Claims | undefined;
  /** Called after the change has been announced. */
  readonly afterChange?: (() => void) | undefined;
}

export interface NewQueueJob {
  readonly name: string;
  readonly settings: PlotSettings;
  readonly drawing: StoredDrawing;
  readonly plotterId?: string | undefined;
  /** The watched file it comes from; marked as handled in the same transaction. */
  readonly watched?: WatchedFile | undefined;
  /** Its id in the shared queue; stored in the same transaction. */
  readonly sharedId?: string | undefined;
}
