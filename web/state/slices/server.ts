/** What the server has: plotters, jobs, and who operates. Its actions: ../server-actions.ts. */
import { findsHome, machineOf } from "../../../src/internal.js";
import type {
  Job,
  ListedMachine,
  Me,
  Notice as ServerNotice,
  Operator,
  PlotSettings,
  Plotter,
  PlotterSettings,
  QueueSettings,
  ServerEvent,
} from "../../../src/schema/index.js";

export type ServerLink = "connecting" | "connected" | "lost";

/** The latest live report of a plot. */
type LivePlot = Omit<Extract<ServerEvent, { type: "progress" }>, "progress" | "elapsedS" | "remainingS">;

export interface ServerSlice {
  readonly link: ServerLink;
  /** The server refuses this device until it is paired. */
  readonly isUnpaired: boolean;
  readonly version: string | null;
  /** The server has a newer page than this one. */
  readonly isOutdated: boolean;
  readonly plotters: readonly Plotter[];
  readonly plotterId: string | null;
  /** Heights, pens and presets as the server has them, by plotter id. A plotter without settings has no entry. */
  readonly plotterSettings: Readonly<Record<string, PlotterSettings>>;
  /** The built-in machines, and the custom ones of this server. */
  readonly machines: readonly ListedMachine[];
  readonly samples: readonly { readonly name: string; readonly title: string }[];
  readonly jobs: readonly Job[];
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
  /** The job whose pen heights were changed here while it plotted. */
  readonly nudgedJobId: string | null;
  /** The job for which the user has said that carriage and pen are where the plotter takes them to be. */
  readonly tickedJobId: string | null;
  /** Where a button would move the place of the paused job, mm; shown on the sheet while there are such buttons. */
  readonly placeMark: { readonly xMm: number; readonly yMm: number } | null;
  /** The name of the request that is running: its button is disabled meanwhile. */
  readonly busyAction: string | null;
  /** Small jobs besides the drawing, such as alignment marks. Watch does not open for them. */
  readonly utilityJobIds: readonly string[];
}

export const SERVER_AT_FIRST = {
  link: "connecting",
  isUnpaired: false,
  version: null,
  isOutdated: false,
  plotters: [],
  plotterId: null,
  plotterSettings: {},
  machines: [],
  samples: [],
  jobs: [],
  queues: {},
  me: null,
  operator: null,
  serverNotices: [],
  localName: null,
  live: null,
  wantedPen: null,
  nudgedJobId: null,
  tickedJobId: null,
  placeMark: null,
  busyAction: null,
  utilityJobIds: [],
} as const satisfies Partial<ServerSlice>;

/** The plotter that the page shows and sends to. */
export const currentPlotter = (state: ServerSlice): Plotter | null =>
  state.plotters.find((plotter) => plotter.id === state.plotterId) ?? state.plotters[0] ?? null;

/** The current plotter is connected and idle. */
export const isReady = (state: ServerSlice): boolean =>
  state.link === "connected" && currentPlotter(state)?.connection === "idle";

/** States in which a job has the plotter, or waits to get it back. */
export const ACTIVE_STATES: readonly Job["state"][] = ["plotting", "paused", "interrupted"];

/** The pen that a paused job waits for; null: it does not wait for one. */
export const penWait = ({ state, wait }: Job): Job["wait"] => (state === "paused" ? wait : null);

/** The current plotter's running or paused job, if any. */
export const activeJob = (state: ServerSlice): Job | null => {
  const plotterId = currentPlotter(state)?.id;
  return (
    state.jobs.find(
      (job) => (job.state === "plotting" || job.state === "paused") && job.plotterId === plotterId,
    ) ?? null
  );
};

/** The running job, else an interrupted job of the current plotter, which can be resumed. */
export const unfinishedJob = (state: ServerSlice): Job | null => {
  const plotterId = currentPlotter(state)?.id;
  const isBroken = (job: Job): boolean => job.state === "interrupted" && job.plotterId === plotterId;
  return activeJob(state) ?? state.jobs.find(isBroken) ?? null;
};

/**
 * The plotter of a job of which a part is drawn, if the rest is still to be drawn. While it is not connected, nobody knows yet
 * whether anything is lost.
 */
const plotterOfRest = ({ plotters }: ServerSlice, job: Job): Plotter | undefined => {
  const plotter = plotters.find(({ id }) => id === job.plotterId);
  const isHeld = job.state === "paused" || job.state === "interrupted";
  const isThere = plotter?.connection === "idle" || plotter?.connection === "busy";
  return isHeld && job.progress > 0 && isThere ? plotter : undefined;
};

/** The plotter does not know where the carriage is: the rest of the job would be drawn elsewhere. */
export const isPositionLost = (state: ServerSlice, job: Job): boolean =>
  plotterOfRest(state, job)?.xMm === null;

/** It does not know how high the pen is: the rest would be drawn in the air, or pressed into the paper. */
export const isHeightLost = (state: ServerSlice, job: Job): boolean =>
  plotterOfRest(state, job)?.heightUnsure === true;

/** What the user must bring back by hand before the job goes on. */
export const lostByHand = (state: ServerSlice, job: Job): "corner" | "height" | "both" | null => {
  const isCorner = isPositionLost(state, job) && !findsHome(machineOf(job.settings));
  const isHeight = isHeightLost(state, job);
  return isCorner && isHeight ? "both" : isCorner ? "corner" : isHeight ? "height" : null;
};

/** The job must not move before the user has done that, and has said so. */
export const needsTick = (state: ServerSlice, job: Job): boolean =>
  lostByHand(state, job) !== null && state.tickedJobId !== job.id;

/** A job's pen settings, with changes that the server has not answered yet. */
export const penOf = ({ wantedPen }: ServerSlice, { id, settings }: Job): PlotSettings["pen"] =>
  wantedPen?.jobId === id ? wantedPen.pen : settings.pen;

/** This device may do everything that the page can. */
export const mayOperate = ({ me }: ServerSlice): boolean => (me?.role ?? "operate") === "operate";

/** It may lay out drawings and add them to the queue. A watcher sees everything and may stop a plot, nothing else. */
export const maySubmit = ({ me }: ServerSlice): boolean => me?.role !== "watch";

/** It may do that, and nothing else. */
export const onlySubmits = ({ me }: ServerSlice): boolean => me?.role === "submit";

/** The operator, if it is another browser. */
export const otherOperator = ({ operator, me }: ServerSlice): Operator | null =>
  operator !== null && operator.id !== me?.id ? operator : null;
