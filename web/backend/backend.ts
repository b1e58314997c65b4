/**
 * The interface through which the page reaches jobs and plotters. `server/` implements it with plotwright's server,
 * `browser/` with a worker of the page. A failed request rejects with a BackendFault.
 */
import type { MachineProfile } from "../../src/index.js";
import type {
  AccessEntry,
  CommandAnswer,
  Device,
  HandMove,
  HandMoveRequest,
  HistoryRequest,
  Job,
  JobChange,
  JobPage,
  JobPatch,
  Me,
  MovePlace,
  NewJob,
  NewKey,
  NewPlotter,
  NewSharedJob,
  NewWebhook,
  Operator,
  Pairing,
  PenRequest,
  Plotter,
  PlotterPatch,
  PlotterSettings,
  QueueSettings,
  ServerEvent,
  SharedJob,
  Webhook,
} from "../../src/schema/index.js";
import type { DrawingText } from "../worker/drawing-text.js";

/** An error whose message is written for the user. */
export class BackendFault extends Error {
  override readonly name = "BackendFault";
  readonly code: string;

  constructor(code: string, message: string) {
    super(message);
    this.code = code;
  }
}

export type JobAction =
  "start" | "pause" | "resume" | "cancel" | "requeue" | "emergency-stop" | "recover" | "check-place";

export interface SampleInfo {
  readonly name: string;
  readonly title: string;
}

/** A drawing that the backend stores. */
export interface DrawingSource {
  readonly of: "job" | "sample";
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
  /** The user must first allow the page to use the plotter's port, with `connect`. */
  readonly asksForPort: boolean;
  /** If `asksForPort`: why the page can't use a port in this browser, and what to do; null: it can. */
  readonly whyNoPort: string | null;
}

export interface Backend {
  readonly features: BackendFeatures;

  /** Reports the whole state once, then each change, as long as the page is open. */
  listen(listener: BackendListener): void;

  addJob(job: Omit<NewJob, "drawing">, drawing: DrawingText): Promise<Job>;
  patchJob(id: string, patch: JobPatch): Promise<Job>;
  actOnJob(id: string, action: JobAction): Promise<Job>;
  /** Changes a job that is plotting or paused. */
  changeJob(id: string, change: JobChange): Promise<Job>;
  movePlace(id: string, move: MovePlace): Promise<Job>;
  /** `beforeId` null: to the end. */
  moveJob(id: string, beforeId: string | null): Promise<void>;
  duplicateJob(id: string): Promise<Job>;
  removeJob(id: string): Promise<void>;
  /** A further part of the history. */
  olderJobs(wanted: HistoryRequest): Promise<JobPage>;
  jobDrawing(id: string): Promise<DrawingText>;
  setQueue(plotterId: string, settings: QueueSettings): Promise<QueueSettings>;

  /** This browser's identity and role. */
  me(): Promise<Me>;
  takeOver(): Promise<Operator | null>;
  dismissNotice(id: string): Promise<void>;

  savePlotterSettings(id: string, settings: PlotterSettings): Promise<PlotterSettings>;
  setPlotterMachine(id: string, machine: string): Promise<Plotter>;
  movePen(id: string, request: PenRequest): Promise<Plotter>;
  motorsOff(id: string): Promise<Plotter>;
  moveByHand(id: string, move: HandMove, how: HandMoveRequest): Promise<Plotter>;
  /** A line for the board, as typed. */
  command(id: string, line: string): Promise<CommandAnswer>;
  /** Lets the user choose a port, and connects to it. Needs `features.asksForPort` and a click. */
  connect(id: string): Promise<Plotter>;
  /** The log of commands and replies of the plotter's connection. */
  log(plotterId: string): Promise<string>;

  saveMachine(profile: MachineProfile): Promise<MachineProfile>;
  removeMachine(id: string): Promise<void>;

  samples(): Promise<readonly SampleInfo[]>;
  sample(name: string): Promise<string>;
  /** The SVG of a drawing, for a thumbnail; null if it is not SVG or is larger than `maxBytes`. */
  svgOf(source: DrawingSource, maxBytes: number): Promise<string | null>;

  /** A part that the first view does not need. It is loaded on the first call. */
  studio(): Promise<StudioBackend>;
}

/** Plotters, access, webhooks, and the queue that several servers share. */
export interface StudioBackend {
  devices(): Promise<readonly Device[]>;
  addPlotter(plotter: NewPlotter): Promise<Plotter>;
  patchPlotter(id: string, patch: PlotterPatch): Promise<Plotter>;
  removePlotter(id: string): Promise<void>;

  pairing(): Promise<Pairing>;
  access(): Promise<readonly AccessEntry[]>;
  addKey(key: NewKey): Promise<{ readonly entry: AccessEntry; readonly secret: string }>;
  revoke(id: string): Promise<void>;

  webhooks(): Promise<readonly Webhook[]>;
  addWebhook(webhook: NewWebhook): Promise<{ readonly webhook: Webhook; readonly secret: string }>;
  removeWebhook(id: string): Promise<void>;

  /** Null if there is no shared queue. */
  sharedJobs(): Promise<readonly SharedJob[] | null>;
  shareJob(job: Omit<NewSharedJob, "drawing">, drawing: DrawingText): Promise<void>;
  giveBackShared(id: string): Promise<void>;
  withdrawShared(id: string): Promise<void>;
}
