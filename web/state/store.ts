/** The page's whole state, without React: what is on the paper, what the server says, what is looked at. */
import { createStore } from "zustand/vanilla";
import { findMachine, firmwareFor, type Springs } from "../../src/internal.js";
import type {
  Job,
  ListedMachine,
  Me,
  Notice as ServerNotice,
  Operator,
  PlotSettings,
  Plotter,
  PlotterSettings,
  Preset,
  QueueSettings,
} from "../../src/schema/index.js";
import type { Hover } from "../scene/hover.js";
import type { SnapLines } from "../scene/placing.js";
import type { Picture } from "../scene/renderer.js";
import type { SwingPicture } from "../scene/swing-scene.js";
import type { SampleInfo } from "../backend/backend.js";
import type { DrawingText } from "../worker/drawing-text.js";
import type { PlanFault, Planned } from "../worker/protocol.js";
import type { Remembered, ViewSettings } from "./persist.js";

/** The drawing on the paper. */
export interface OpenDrawing {
  readonly key: string;
  readonly name: string;
  readonly text: DrawingText;
  /** The job that it was opened from or sent as, while the settings are still that job's. */
  readonly jobId: string | null;
  /** The job that it was opened from, whatever has become of the settings since. */
  readonly sourceId: string | null;
}

export type ServerLink = "connecting" | "connected" | "lost";

/** The latest live report of a plot. */
interface LivePlot {
  readonly jobId: string;
  readonly plotterId: string;
  readonly planS: number;
  readonly xMm: number;
  readonly yMm: number;
  readonly penUp: boolean;
  readonly penMoving: boolean;
}

export interface Selected {
  readonly of: Planned;
  readonly hover: Hover;
}

export interface Notice {
  readonly id: number;
  readonly kind: "info" | "error";
  readonly text: string;
}

/** The simulated pen on a plan. */
export interface Swing {
  readonly of: Planned;
  /** How it swings. */
  readonly springs: Springs;
  /** The machine was not measured. */
  readonly isAssumed: boolean;
  /** How much of the plot is simulated, 0 … 1. */
  readonly share: number;
  /** Null until all of it is. */
  readonly picture: Picture | null;
  readonly result: Pick<SwingPicture, "error" | "topMm"> | null;
  readonly fault: string | null;
}

/** "prepare": what is to be plotted is laid out; "watch": the plot under way. */
export type PageView = "prepare" | "watch";

/** The plan of the job that Watch shows; not of the drawing that is laid out. */
export interface WatchPlan {
  readonly key: string;
  readonly planned: Planned | null;
  readonly fault: string | null;
}

/** Asked where only the operator may do what was pressed. */
interface TakeOverQuestion {
  readonly operator: string | null;
  answer(takesOver: boolean): void;
}

/** Sheets over the page, one at a time. */
export type DialogName = "keys" | "about" | "machines" | "wizard" | "console" | "studio" | "ringing";

/** What undo brings back. */
export type UndoStep = Pick<PageState, "settings" | "presets">;

export interface PageState {
  readonly settings: PlotSettings;
  readonly undoStack: readonly UndoStep[];
  readonly redoStack: readonly UndoStep[];
  readonly view: ViewSettings;

  readonly pageView: PageView;
  /** Watch shows this job while none has the plotter: the last one that had it. */
  readonly watchedId: string | null;
  readonly watchPlan: WatchPlan | null;
  /** Watch fills the screen. */
  readonly isFullScreen: boolean;
  /** Small jobs that were started beside a drawing, such as marks: Watch does not open for them. */
  readonly sideJobIds: readonly string[];

  /** Until the browser has said what lay on the paper at the last visit. */
  readonly isStarting: boolean;
  readonly drawing: OpenDrawing | null;
  readonly planned: Planned | null;
  readonly isPlanning: boolean;
  readonly fault: PlanFault | null;

  /** The moment of the plan that is looked at, s; null for the whole plot (or the live one). */
  readonly momentS: number | null;
  readonly isPlaying: boolean;
  readonly playRate: number;
  readonly hover: Hover | null;
  /** The stroke that was clicked, of this plan: another plan may number the strokes differently. */
  readonly selected: Selected | null;
  /** While the simulated pen is looked at. */
  readonly swing: Swing | null;
  /** Places on the file's page that a note of the report is about, while it is shown; mm x0 y0 x1 y1. */
  readonly noteBoxes: readonly (readonly [number, number, number, number])[];
  /** The lines on which a dragged drawing has come to lie. */
  readonly snapLines: SnapLines | null;

  readonly link: ServerLink;
  /** The server lets this device in only once it is paired. */
  readonly isUnpaired: boolean;
  readonly takeOverQuestion: TakeOverQuestion | null;
  readonly version: string | null;
  /** The server has a newer page than this one. */
  readonly isOutdated: boolean;
  readonly plotters: readonly Plotter[];
  readonly plotterId: string | null;
  /** Heights, pens and presets as the server has them, by plotter id; a plotter for which nothing was set has none. */
  readonly plotterSettings: Readonly<Record<string, PlotterSettings>>;
  readonly jobs: readonly Job[];
  /** How each plotter's queue continues from job to job, by the plotter's id. */
  readonly queues: Readonly<Record<string, QueueSettings>>;
  /** Who this browser is to the server; null until it has said. */
  readonly me: Me | null;
  /** The browser that may change things now; null: none. */
  readonly operator: Operator | null;
  /** Errors on the server without a request by this page. */
  readonly serverNotices: readonly ServerNotice[];
  /** The server's name on the network; null while it has none. */
  readonly localName: string | null;
  readonly live: LivePlot | null;
  readonly samples: readonly SampleInfo[];

  /** Those that come with plotwright, and those made by the users of this server. */
  readonly machines: readonly ListedMachine[];
  /** Of the current plotter. */
  readonly presets: readonly Preset[];
  readonly openDialog: DialogName | null;
  readonly notices: readonly Notice[];
  /** The button whose request is under way, by name: it is disabled meanwhile. */
  readonly busyAction: string | null;
}

export const createPageStore = ({ settings, view }: Remembered) =>
  createStore<PageState>()(() => ({
    settings,
    undoStack: [],
    redoStack: [],
    view,
    pageView: "prepare",
    watchedId: null,
    watchPlan: null,
    isFullScreen: false,
    sideJobIds: [],
    isStarting: true,
    drawing: null,
    planned: null,
    isPlanning: false,
    fault: null,
    momentS: null,
    isPlaying: false,
    playRate: 10,
    hover: null,
    selected: null,
    swing: null,
    noteBoxes: [],
    snapLines: null,
    link: "connecting",
    isUnpaired: false,
    takeOverQuestion: null,
    version: null,
    isOutdated: false,
    plotters: [],
    plotterId: null,
    plotterSettings: {},
    jobs: [],
    queues: {},
    me: null,
    operator: null,
    serverNotices: [],
    localName: null,
    live: null,
    samples: [],
    machines: [],
    presets: [],
    openDialog: null,
    notices: [],
    busyAction: null,
  }));

export type PageStore = ReturnType<typeof createPageStore>;

/** The selected stroke, if the plan on the paper is the one that it was selected in. */
export const selectedStroke = ({ selected, planned }: PageState): Selected | null =>
  selected !== null && selected.of === planned ? selected : null;

/** The plotter that the page shows and sends to. */
export const currentPlotter = (state: PageState): Plotter | null =>
  state.plotters.find((plotter) => plotter.id === state.plotterId) ?? state.plotters[0] ?? null;

/** Of the current plotter's board; null: not known, or of another controller than the machine's. */
export const boardFirmware = (state: PageState): string | null => {
  const machine = findMachine(state.settings);
  return machine && firmwareFor(machine, currentPlotter(state)?.firmware ?? null);
};

/** The current plotter would do something now: it is there, free, and heard of. */
export const isReady = (state: PageState): boolean =>
  state.link === "connected" && currentPlotter(state)?.connection === "idle";

/** States in which a job has the plotter, or waits to have it back. */
export const ACTIVE_STATES: readonly Job["state"][] = ["plotting", "paused", "interrupted"];

/** The job that the current plotter is at, if any. */
export const activeJob = (state: PageState): Job | null => {
  const plotterId = currentPlotter(state)?.id;
  return (
    state.jobs.find(
      (job) => (job.state === "plotting" || job.state === "paused") && job.plotterId === plotterId,
    ) ?? null
  );
};

/** That job, else one of the current plotter that was interrupted and can go on. */
export const unfinishedJob = (state: PageState): Job | null => {
  const plotterId = currentPlotter(state)?.id;
  const isBroken = (job: Job): boolean => job.state === "interrupted" && job.plotterId === plotterId;
  return activeJob(state) ?? state.jobs.find(isBroken) ?? null;
};

/** What Watch shows: the job that has the plotter or waits to have it back, else the last one that had it. */
export const watchedJob = (state: PageState): Job | null =>
  unfinishedJob(state) ?? state.jobs.find(({ id }) => id === state.watchedId) ?? null;

/** A watcher has nothing to lay out. */
export const shownView = (state: PageState): PageView => (mayOperate(state) ? state.pageView : "watch");

/** Watchers see everything and may stop a plot; they change nothing else. */
export const mayOperate = ({ me }: PageState): boolean => me?.role !== "watch";

/** Another browser that has the plotters in hand, if any. */
export const otherOperator = ({ operator, me }: PageState): Operator | null =>
  operator !== null && operator.id !== me?.id ? operator : null;
