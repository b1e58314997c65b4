/** Actions that plot the drawing or concern the running plot. */
import { isOutOfReach, isOutsideUnanswered } from "../drawing/where-drawn.js";
import { outsideText } from "../drawing/text.js";
import { plotterText } from "../plotter/text.js";
import { previewText } from "../preview/text.js";
import { isForOperator, isForSubmitter, type PageAction } from "../state/page-action.js";
import {
  activeJob,
  currentPlotter,
  mayOperate,
  maySubmit,
  needsTick,
  type PageState,
} from "../state/store.js";
import { stateText } from "../state/text.js";
import { jobText, plotText } from "./text.js";
import type { Job } from "../../src/schema/index.js";

/** A drawing or its settings are being sent. */
export const isSendingJob = ({ busyAction }: PageState): boolean =>
  busyAction === "add" || busyAction === "plot" || busyAction === "save";

/** Why the drawing can't be put in the queue; null: it can. */
const whyNotQueue = (state: PageState): string | null => {
  if (state.link === "lost") return stateText.notConnected;
  if (state.link === "connecting") return plotterText.server.connecting;
  if (!maySubmit(state)) return plotText.watchesOnly;
  if (state.drawing === null) return plotText.needsDrawing;
  if (isSendingJob(state)) return plotText.sending;
  if (state.fault !== null) return previewText.cannotRead(state.drawing.name);
  if (state.planned === null) return plotText.planning;
  if (state.planned.strokeCount === 0) return previewText.nothingToDraw;
  if (state.plotters.length === 0) return plotText.needsPlotter;
  if (isOutsideUnanswered(state)) return outsideText.question;
  return isOutOfReach(state) ? plotText.outOfReach : null;
};

export const QUEUE: PageAction = {
  id: "queue",
  label: ({ copies }) => (copies === 1 ? plotText.addToQueue : plotText.addCopies(copies)),
  words: "print later, enqueue",
  key: "Q",
  isForDrawing: true,
  whyOff: whyNotQueue,
  perform: ({ actions }) => void actions.queueDrawing(),
};

export const PLOT: PageAction = {
  id: "plot",
  label: plotText.plot,
  words: "print, draw, start",
  isForDrawing: true,
  isOffered: isForOperator,
  whyOff: (state) => {
    const why = whyNotQueue(state);
    if (why !== null) return why;
    if (activeJob(state) !== null) return plotText.queueBusy;
    return currentPlotter(state)?.connection === "absent" ? plotText.needsPlotter : null;
  },
  perform: ({ actions }) => void actions.plotDrawing(),
};

/** What P does: the main button of the running job. */
const mainAction = (state: PageState) => {
  const job = activeJob(state);
  const action = job && mainActionOf(state, job);
  return job && action ? { job, action } : null;
};
const PAUSE: PageAction = {
  id: "pause",
  label: plotText.pauseOrResume,
  words: "stop, halt, continue, hold",
  key: "P",
  whyOff: (state) => {
    const main = mainAction(state);
    if (main === null) return activeJob(state) === null ? plotText.noPlot : plotText.stopsOnly;
    if (!isMainActionOff(state, main.job, main.action)) return null;
    if (state.link !== "connected") return stateText.notConnected;
    return isLocked(state, main.job, main.action) ? jobText.tickFirst : jobText.asked;
  },
  perform: ({ store, actions }) => {
    const main = mainAction(store.getState());
    if (main) void actions.actOnJob(main.job.id, main.action);
  },
};

export const SAVE_TO_JOB: PageAction = {
  id: "save-to-job",
  label: (state) => plotText.saveToJob(changedJob(state)?.name ?? ""),
  isOffered: (page) => isForSubmitter(page) && changedJob(page.store.getState()) !== null,
  whyOff: whyNotQueue,
  perform: ({ store, actions }) => {
    const job = changedJob(store.getState());
    if (job) void actions.saveToJob(job.id);
  },
};
/** The queued job that the drawing was opened from or sent as, if its settings were changed here since. */
const changedJob = ({ drawing, jobs }: PageState) =>
  drawing?.jobId === null
    ? (jobs.find(({ id, state }) => id === drawing.sourceId && state === "queued") ?? null)
    : null;

export const PLOT_ACTIONS: readonly PageAction[] = [PLOT, QUEUE, SAVE_TO_JOB, PAUSE];

/** What the main button of a job does. */
type MainAction = "pause" | "resume" | "recover";

const ACTIONS: Readonly<Partial<Record<Job["state"], MainAction>>> = {
  plotting: "pause",
  paused: "resume",
  interrupted: "recover",
};

/** Null: the job has no such button on this page. Those who do not operate may only stop a plot. */
export const mainActionOf = (state: PageState, job: Job): MainAction | null =>
  mayOperate(state) || job.state === "plotting" ? (ACTIONS[job.state] ?? null) : null;

/** Resuming would move carriage or pen from where they are not. */
export const isLocked = (state: PageState, job: Job, action: MainAction): boolean =>
  action === "resume" && needsTick(state, job);

/** Without a connection the server would not receive the request. */
export const isMainActionOff = (state: PageState, job: Job, action: MainAction): boolean =>
  state.link !== "connected" || state.busyAction === `${action} ${job.id}` || isLocked(state, job, action);
