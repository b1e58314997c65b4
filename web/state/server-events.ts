/** Applies the server's events to the page's state. Pure functions. */
import { inPageWords } from "../../src/internal.js";
import { ENDED_STATES, type ServerEvent, type Snapshot } from "../../src/schema/index.js";
import { lostByHand, type PageState } from "./store.js";

type Change = Partial<PageState>;

/** What the server says of a job or a plotter names settings for the command line, too. */
export const withPageWords = <T extends { readonly message: string | null }>(item: T): T =>
  item.message === null ? item : { ...item, message: inPageWords(item.message) };

export const applyServerEvent = (state: PageState, event: ServerEvent): Change => {
  const change = changeBy(state, event);
  const after = { ...state, ...change };
  const job = after.jobs.find(({ id }) => id === state.tickedJobId);
  // If it is lost once more, the user is asked again.
  return job && lostByHand(after, job) !== null ? change : { ...change, tickedJobId: null };
};

const changeBy = (state: PageState, event: ServerEvent): Change => {
  switch (event.type) {
    case "snapshot":
      return applySnapshot(state, event.snapshot);
    case "job":
      return applyJob(state, withPageWords(event.job));
    case "job-removed":
      return { jobs: state.jobs.filter((job) => job.id !== event.id) };
    case "expected":
      return {
        jobs: state.jobs.map((job) => ({ ...job, expectedS: event.expectedS[job.id] ?? job.expectedS })),
      };
    case "order":
      return { jobs: ordered(state, event.ids) };
    case "plotter":
      return { plotters: upserted(state.plotters, withPageWords(event.plotter)) };
    case "plotters":
      return withPlotters(state, event.plotters.map(withPageWords));
    case "plotter-settings":
      return { plotterSettings: { ...state.plotterSettings, [event.plotterId]: event.settings } };
    case "machines":
      return { machines: event.machines };
    case "queue":
      return {};
    case "queues":
      return { queues: event.queues };
    case "operator":
      return { operator: event.operator };
    case "local-name":
      return { localName: event.localName };
    case "notice":
      return { serverNotices: upserted(state.serverNotices, withPageWords(event.notice)) };
    case "notice-removed":
      return { serverNotices: state.serverNotices.filter(({ id }) => id !== event.id) };
    case "progress":
      return applyProgress(state, event);
  }
};

/** The whole state, sent when the page has connected. The live report is dropped unless its job is still running. */
const applySnapshot = (state: PageState, snapshot: Snapshot): Change => {
  const { version, plotters, plotterSettings, jobs, queues, operator, serverNotices } = snapshot;
  const { localName, machines } = snapshot;
  const isRunning = jobs.some(({ id, state: now }) => id === state.live?.jobId && now === "plotting");
  return {
    ...withPlotters(state, plotters.map(withPageWords)),
    ...(isRunning ? {} : { live: null }),
    version,
    isOutdated: state.isOutdated || (state.version !== null && state.version !== version),
    plotterSettings,
    jobs: jobs.map(withPageWords),
    queues,
    operator,
    serverNotices: serverNotices.map(withPageWords),
    localName,
    machines,
  };
};

/** Keeps the chosen plotter as long as it exists. */
const withPlotters = ({ plotterId }: PageState, plotters: PageState["plotters"]): Change => ({
  plotters,
  plotterId: plotters.some(({ id }) => id === plotterId) ? plotterId : (plotters[0]?.id ?? null),
});

const applyJob = (state: PageState, job: PageState["jobs"][number]): Change => {
  const isOver = ENDED_STATES.includes(job.state) && state.live?.jobId === job.id;
  return { jobs: upserted(state.jobs, job), ...(isOver ? { live: null } : {}) };
};

const upserted = <T extends { readonly id: string }>(list: readonly T[], item: T): readonly T[] =>
  list.some((other) => other.id === item.id)
    ? list.map((other) => (other.id === item.id ? item : other))
    : [...list, item];

/** In the given order. Unknown ids are skipped, and jobs that are not named come last. */
const ordered = ({ jobs }: PageState, ids: readonly string[]): PageState["jobs"] => {
  const place = new Map(ids.map((id, index) => [id, index]));
  const placeOf = (id: string): number => place.get(id) ?? ids.length;
  return [...jobs].sort((a, b) => placeOf(a.id) - placeOf(b.id));
};

const applyProgress = (state: PageState, event: Extract<ServerEvent, { type: "progress" }>): Change => {
  const { progress, elapsedS, remainingS, ...live } = event;
  const { jobId, plotterId, xMm, yMm, penUp, penMoving } = live;
  return {
    live,
    jobs: state.jobs.map((job) => (job.id === jobId ? { ...job, progress, elapsedS, remainingS } : job)),
    plotters: state.plotters.map((plotter) =>
      plotter.id === plotterId ? { ...plotter, xMm, yMm, penUp, penMoving } : plotter,
    ),
  };
};
