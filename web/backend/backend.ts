/**
 * The interface through which the page reaches jobs and plotters: a client of the table of operations, and what is not a
 * single request. `server/` implements it with plotwright's server, `browser/` with a worker of the page. A failed
 * request rejects with a BackendFault.
 */
import { inPageWords } from "../../src/internal.js";
import type {
  Job,
  LiveBegin,
  NewJob,
  OperationClient,
  Plotter,
  ServerEvent,
} from "../../src/schema/index.js";
import type { LiveSender } from "../../host/handle/live-sender.js";
import type { DrawingText } from "./drawing-text.js";

/** An error whose message is written for the user. */
export class BackendFault extends Error {
  override readonly name = "BackendFault";
  readonly code: string;

  constructor(code: string, message: string) {
    super(inPageWords(message));
    this.code = code;
  }
}

type Jobs = OperationClient["jobs"];
/** The operations that change a job and need no further data. */
export type JobAction = Exclude<
  { [Name in keyof Jobs]: Jobs[Name] extends (id: string) => Promise<Job> ? Name : never }[keyof Jobs],
  "get"
>;

/** A drawing that the backend stores. */
export interface DrawingSource {
  readonly of: "job" | "sample" | "library";
  /** In the library, its path. */
  readonly id: string;
}

export interface BackendListener {
  onEvent(event: ServerEvent): void;
  /** Called when the connection is made or lost. Each connection begins with an event "snapshot". */
  onLink(isConnected: boolean): void;
}

/** Optional features. The page shows only those that the backend has. */
interface BackendFeatures {
  /** Other devices, keys, webhooks, several plotters, a shared queue. */
  readonly sharing: boolean;
  /** Drawings kept in folders, apart from the jobs. */
  readonly library: boolean;
  /** The user must first allow the page to use the plotter's port, with `connect`. */
  readonly asksForPort: boolean;
  /** If `asksForPort`: why the page can't use a port in this browser, and what to do; null: it can. */
  readonly whyNoPort: string | null;
}

export interface Backend extends OperationClient {
  readonly features: BackendFeatures;
  /** Reports the whole state once, then each change, as long as the page is open. */
  listen(listener: BackendListener): void;
  /** Lets the user choose a port, and connects to it. Needs `features.asksForPort` and a click. */
  connect(id: string): Promise<Plotter>;
  /**
   * Begins a live drawing, as a job of a plotter: `jobs.pause`, `jobs.cancel` and the like apply to it. Rejects with a
   * BackendFault: the plotter is busy or not connected, or another browser operates.
   */
  live(plotterId: string, wanted: LiveBegin): Promise<LiveSender>;
  /** The file of a drawing, for a thumbnail; null if it is larger than `maxBytes`. */
  fileOf(source: DrawingSource, maxBytes: number): Promise<DrawingText | null>;
}

/** Uploads a drawing, then adds its job. */
export const addJob = async (
  { drawings, jobs }: Pick<Backend, "drawings" | "jobs">,
  job: Omit<NewJob, "drawing" | "drawingId">,
  drawing: DrawingText,
): Promise<Job> => {
  const { id: drawingId } = await drawings.upload(drawing);
  return jobs.add({ ...job, drawingId });
};
