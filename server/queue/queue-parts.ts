/** What the queue is made of, given in so that tests can lead each part. */
import type { Job, JobStats, PlotSettings, ServerEvent } from "../../src/schema/index.js";
import type { Asker } from "../planning/lane.js";
import type { PlotPlanner } from "../plotter/types.js";
import type { DrawingFiles, StoredDrawing } from "./drawing-files.js";
import type { PlotterPort } from "./plotter-port.js";
import type { Store, WatchedFile } from "./store.js";

export interface Planning {
  /** firmware: of the board that is to plot it; null: not known. */
  measure(
    drawing: string,
    settings: PlotSettings,
    firmware: string | null,
    asker?: Asker,
  ): Promise<{ readonly stats: JobStats; readonly warnings: readonly string[] }>;
  open(drawing: string, settings: PlotSettings, signal: AbortSignal): Promise<PlotPlanner>;
}

export interface Claims {
  /** Null: it is this server's, which is known to all from now on. Else why it must not begin; never rejects. */
  claim(jobId: string): Promise<string | null>;
  /** It has not begun after all; never rejects. */
  release(jobId: string): Promise<void>;
}

export interface QueueParts {
  readonly store: Store;
  readonly files: DrawingFiles;
  readonly planning: Planning;
  /** By id, the first one first; may gain and lose plotters while the queue runs. */
  readonly plotters: ReadonlyMap<string, PlotterPort>;
  readonly announce: (event: ServerEvent) => void;
  readonly nowIso: () => string;
  /** What can't be told otherwise, such as a disk that is full in mid-plot. */
  readonly log?: ((line: string) => void) | undefined;
  /** Writes what follows from a job's change, in the same transaction. */
  readonly withChange?: ((before: Job | null, after: Job) => void) | undefined;
  /** For jobs that servers share: makes sure that no other one plots it; absent where none is shared. */
  readonly claims?: Claims | undefined;
  /** After the change has been announced. */
  readonly afterChange?: (() => void) | undefined;
}

export interface NewQueueJob {
  readonly name: string;
  readonly settings: PlotSettings;
  readonly drawing: StoredDrawing;
  readonly plotterId?: string | undefined;
  /** Where it comes from: seen to as soon as the job is there. */
  readonly watched?: WatchedFile | undefined;
  /** Its id in the shared queue, kept in the same step. */
  readonly sharedId?: string | undefined;
}
