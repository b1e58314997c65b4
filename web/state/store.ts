/** The page's whole state, without React: the drawing, the server's state, the view. */
import { createStore } from "zustand/vanilla";
import { findMachine, firmwareFor, type PaperSize, type Springs } from "../../src/internal.js";
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
import type { DrawingText } from "../worker/drawing-text.js";
import type { PlanFault, Planned } from "../worker/protocol.js";
import type { Remembered, ViewSettings } from "./persist.js";

/** The drawing on the paper. */
export interface OpenDrawing {
  readonly key: string;
  readonly name: string;
  readonly text: DrawingText;
  /** The job that it was opened from or sent as, as long as the settings are that job's. */
  readonly jobId: string | null;
  /** The single job that it was opened from or sent as, even after the settings were changed. */
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
  /** The frequencies and damping used. */
  readonly springs: Springs;
  /** The machine was not measured. */
  readonly isAssumed: boolean;
  /** How much of the plot is simulated, 0 … 1. */
  readonly share: number;
  /** Null until the simulation is complete. */
  readonly picture: Picture | null;
  readonly result: Pick<SwingPicture, "error" | "topMm"> | null;
  readonly fault: string | null;
}

/** "prepare": the drawing that is laid out for plotting; "watch": the running plot. */
export type PageView = "prepare" | "watch";

/** The plan of the job that Watch shows, not of the drawing in Prepare. */
export interface WatchPlan {
  readonly key: string;
  readonly planned: Planned | null;
  readonly fault: string | null;
}

/** Asked when the user presses something that only the operator may do. */
interface TakeOverQuestion {
  readonly operator: string | null;
  answer(takesOver: boolean): void;
}

/** Dialogs, one at a time. */
export type DialogName = "keys" | "about" | "machines" | "wizard" | "console" | "studio" | "ringing";

/** What undo restores. */
export type UndoStep = Pick<PageState, "settings" | "presets">;

export interface PageState {
  readonly settings: PlotSettings;
  readonly undoStack: readonly UndoStep[];
  readonly redoStack: readonly UndoStep[];
  readonly view: ViewSettings;

  readonly pageView: PageView;
  /** The last job that had the plotter: Watch shows it while none is running. */
  readonly watchedId: string | null;
  readonly watchPlan: WatchPlan | null;
  /** Watch fills the screen. */
  readonly isFullScreen: boolean;
  /** Small jobs besides the drawing, such as alignment marks. Watch does not open for them. */
  readonly sideJobIds: readonly string[];

  /** True until the browser has returned the drawing of the last visit. */
  readonly isStarting: boolean;
  readonly drawing: OpenDrawing | null;
  /** How many times "Add to queue" adds the drawing. */
  readonly copies: number;
  /** A paper whose size is typed into fields, also while that happens to be the size of a paper with a name. */
  readonly typedPaper: PaperSize | null;
  readonly planned: Planned | null;
  readonly isPlanning: boolean;
  readonly fault: PlanFault | null;

  /** The shown moment of the plan, s; null for the whole plot (or the live one). */
  readonly momentS: number | null;
  readonly isPlaying: boolean;
  readonly playRate: number;
  readonly hover: Hover | null;
  /** The clicked stroke and its plan: another plan may number the strokes differently. */
  readonly selected: Selected | null;
  /** Set while the simulated pen is shown. */
  readonly swing: Swing | null;
  /** Places on the file's page that the user wants to see for a warning; mm x0 y0 x1 y1. */
  readonly noteBoxes: readonly (readonly [number, number, number, number])[];
  /** The lines that a dragged drawing has snapped to. */
  readonly snapLines: SnapLines | null;

  readonly link: ServerLink;
  /** The server refuses this device until it is paired. */
  readonly isUnpaired: boolean;
  readonly takeOverQuestion: TakeOverQuestion | null;
  readonly version: string | null;
  /** The server has a newer page than this one. */
  readonly isOutdated: boolean;
  readonly plotters: readonly Plotter[];
  readonly plotterId: string | null;
  /** Heights, pens and presets as the server has them, by plotter id. A plotter without settings has no entry. */
  readonly plotterSettings: Readonly<Record<string, PlotterSettings>>;
  readonly jobs: readonly Job[];
  /** The server has ended jobs that are not in `jobs`. */
  readonly hasOlderJobs: boolean;
  /** Plotters whose older jobs are all in `jobs`; "" if the jobs of all plotters are. */
  readonly wholeHistories: readonly string[];
  /** Whether each plotter's queue starts the next job by itself, by plotter id. */
  readonly queues: Readonly<Record<string, QueueSettings>>;
  /** This browser's identity and role; null until the server has answered. */
  readonly me: Me | null;
  /** The browser that holds the operator lock; null: none. */
  readonly operator: Operator | null;
  /** Server errors that no request of this page caused. */
  readonly serverNotices: readonly ServerNotice[];
  /** The server's name on the network; null while it has none. */
  readonly localName: string | null;
  readonly live: LivePlot | null;
  /** The newest pen settings sent for a running plot, until the server has answered: it plans the rest first. */
  readonly wantedPen: { readonly jobId: string; readonly pen: PlotSettings["pen"] } | null;
  readonly samples: readonly { readonly name: string; readonly title: string }[];

  /** The built-in machines, and the custom ones of this server. */
  readonly machines: readonly ListedMachine[];
  /** The current plotter's presets. */
  readonly presets: readonly Preset[];
  readonly openDialog: DialogName | null;
  readonly notices: readonly Notice[];
  /** The name of the request that is running: its button is disabled meanwhile. */
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
    copies: 1,
    typedPaper: null,
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
    hasOlderJobs: false,
    wholeHistories: [],
    queues: {},
    me: null,
    operator: null,
    serverNotices: [],
    localName: null,
    live: null,
    wantedPen: null,
    samples: [],
    machines: [],
    presets: [],
    openDialog: null,
    notices: [],
    busyAction: null,
  }));

export type PageStore = ReturnType<typeof createPageStore>;

/** The selected stroke, if it belongs to the current plan. */
export const selectedStroke = ({ selected, planned }: PageState): Selected | null =>
  selected !== null && selected.of === planned ? selected : null;

/** The plotter that the page shows and sends to. */
export const currentPlotter = (state: PageState): Plotter | null =>
  state.plotters.find((plotter) => plotter.id === state.plotterId) ?? state.plotters[0] ?? null;

/** The firmware of the current plotter's board; null: unknown, or its controller is not the machine's. */
export const boardFirmware = (state: PageState): string | null => {
  const machine = findMachine(state.settings);
  return machine && firmwareFor(machine, currentPlotter(state)?.firmware ?? null);
};

/** The current plotter is connected and idle. */
export const isReady = (state: PageState): boolean =>
  state.link === "connected" && currentPlotter(state)?.connection === "idle";

/** States in which a job has the plotter, or waits to get it back. */
export const ACTIVE_STATES: readonly Job["state"][] = ["plotting", "paused", "interrupted"];

/** The pen that a paused job waits for; null: it does not wait for one. */
export const penWait = ({ state, wait }: Job): Job["wait"] => (state === "paused" ? wait : null);

/** The current plotter's running or paused job, if any. */
export const activeJob = (state: PageState): Job | null => {
  const plotterId = currentPlotter(state)?.id;
  return (
    state.jobs.find(
      (job) => (job.state === "plotting" || job.state === "paused") && job.plotterId === plotterId,
    ) ?? null
  );
};

/** The running job, else an interrupted job of the current plotter, which can be resumed. */
export const unfinishedJob = (state: PageState): Job | null => {
  const plotterId = currentPlotter(state)?.id;
  const isBroken = (job: Job): boolean => job.state === "interrupted" && job.plotterId === plotterId;
  return activeJob(state) ?? state.jobs.find(isBroken) ?? null;
};

/** A job's pen settings, with changes that the server has not answered yet. */
export const penOf = ({ wantedPen }: PageState, { id, settings }: Job): PlotSettings["pen"] =>
  wantedPen?.jobId === id ? wantedPen.pen : settings.pen;

/** What Watch shows: the unfinished job, else the last one that had the plotter. */
export const watchedJob = (state: PageState): Job | null =>
  unfinishedJob(state) ?? state.jobs.find(({ id }) => id === state.watchedId) ?? null;

/** A watcher sees only Watch. */
export const shownView = (state: PageState): PageView => (mayOperate(state) ? state.pageView : "watch");

/** A watcher sees everything and may stop a plot, nothing else. */
export const mayOperate = ({ me }: PageState): boolean => me?.role !== "watch";

/** The operator, if it is another browser. */
export const otherOperator = ({ operator, me }: PageState): Operator | null =>
  operator !== null && operator.id !== me?.id ? operator : null;
