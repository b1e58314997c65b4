/** Requests about jobs, the queue, the plotter and who operates, as functions on the store. */
import type { MachineProfile } from "../../src/index.js";
import { tilesOf } from "../../src/internal.js";
import {
  machineProfileSchema,
  withOffs,
  type HandMove,
  type HandMoveRequest,
  type HistoryRequest,
  type Job,
  type JobChange,
  type JobPage,
  type JobPatch,
  type JobPlace,
  type LibraryRequest,
  type MovePlace,
  type NewJob,
  type PlotSettings,
  type Plotter,
  type QueueSettings,
} from "../../src/schema/index.js";
import type { DrawingText } from "../backend/drawing-text.js";
import { addJob, BackendFault, type Backend, type JobAction } from "../backend/backend.js";
import { withPageWords } from "./server-events.js";
import { activeJob, currentPlotter, penOf, type PageNotice, type PageStore } from "./store.js";
import { textOfDrawing } from "./sheet-actions.js";
import { stateText } from "./text.js";

interface ServerActionDeps {
  readonly store: PageStore;
  readonly backend: Backend;
  /** Sends a request. A failure becomes a notice, and the result is null. `name` names the button to disable meanwhile. */
  attempt<T>(name: string, request: () => Promise<T>): Promise<T | null>;
  notify(kind: PageNotice["kind"], text: string): void;
}

export const createServerActions = ({ store, backend, attempt, notify }: ServerActionDeps) => {
  const addToQueue = async (copies: number, from: JobPlace | null): Promise<Job | null> => {
    const state = store.getState();
    const { drawing, settings } = state;
    if (!drawing) return null;
    const plotterId = currentPlotter(state)?.id;
    const newJob = {
      name: drawing.name,
      settings,
      ...(plotterId ? { plotterId } : {}),
      ...(copies > 1 ? { copies } : {}),
      ...(from ? { from } : {}),
    };
    const job = await attempt("add", async () =>
      addJob(backend, newJob, await textOfDrawing(drawing, settings)),
    );
    const now = store.getState();
    if (job && now.drawing?.key === drawing.key && now.drawing.sheet === drawing.sheet) {
      // Of several sheets each one is a job.
      const isWhole = tilesOf(settings.prepare).length === 1;
      const jobId = isWhole && now.settings === settings ? job.id : null;
      // Later changes concern a single job, not the first of several copies.
      const sourceId = isWhole && copies === 1 ? job.id : drawing.sourceId;
      store.setState({ drawing: { ...drawing, jobId, sourceId } });
    }
    return job;
  };

  const changeJob = async (
    id: string,
    change: JobChange & { readonly pen?: PlotSettings["pen"] },
  ): Promise<void> => {
    const wantedPen = change.pen ? { jobId: id, pen: change.pen } : null;
    if (wantedPen) store.setState({ wantedPen });
    const job = await attempt(`change ${id}`, () => backend.jobs.change(id, change));
    // A newer request has replaced this one, and its answer comes later.
    if (wantedPen === null || store.getState().wantedPen !== wantedPen) return;
    // The answer may come before the job's event.
    store.setState(({ jobs }) => ({
      wantedPen: null,
      jobs: jobs.map((old) => (old.id === job?.id ? { ...old, settings: job.settings } : old)),
    }));
  };

  /** The body of a move has its numbers and `how` side by side. */
  const moveByHand = (id: string, { kind, ...numbers }: HandMove, how: HandMoveRequest): Promise<Plotter> =>
    (backend.moves[kind] as (plotterId: string, body: object) => Promise<Plotter>)(id, {
      ...numbers,
      ...how,
    });

  return {
    takeOver: () => attempt("take-over", () => backend.operator.take()),
    /** Gets this browser's identity. Called on each connection, because a restarted server may have forgotten it. */
    loadServerState: async (): Promise<void> => {
      try {
        store.setState({ me: await backend.state.me(), isUnpaired: false });
      } catch (error) {
        if (error instanceof BackendFault && error.code === "not-allowed")
          store.setState({ isUnpaired: true });
      }
    },
    dismissServerNotice: (id: string) => attempt(`notice ${id}`, () => backend.operator.dismissNotice(id)),
    loadSamples: async (): Promise<void> => {
      const answer = await attempt("samples", () => backend.samples.list());
      if (answer) store.setState({ samples: answer.samples });
    },
    queueDrawing: async (): Promise<void> => {
      const job = await addToQueue(store.getState().copies, null);
      if (job) notify("info", stateText.added(job.name));
    },
    /** With `from`, the plot waits at that place with the pen up until it is resumed. */
    plotDrawing: async (from: JobPlace | null = null): Promise<void> => {
      const job = await addToQueue(1, from);
      if (job) await attempt("plot", () => backend.jobs.start(job.id));
    },
    /** A page of finished plots: those after a job, or the newest. `plotterId` "": of all plotters. */
    fetchHistory: async ({ after, name, plotterId }: HistoryRequest): Promise<JobPage | null> => {
      const wanted = { ...(after && { after }), ...(name && { name }), ...(plotterId && { plotterId }) };
      const page = await attempt("history", () => backend.state.history(wanted));
      return page && { ...page, jobs: page.jobs.map(withPageWords) };
    },
    keepJob: async ({ id }: Job): Promise<void> => {
      const kept = await attempt(`keep ${id}`, () => backend.library.keep(id, {}));
      if (kept) notify("info", stateText.kept(kept.path));
    },
    listLibrary: (wanted: LibraryRequest) => attempt("library", () => backend.library.list(wanted)),
    saveToLibrary: (path: string, drawing: DrawingText) =>
      attempt("save-to-library", () => backend.library.save(path, drawing)),
    removeFromLibrary: (path: string) => attempt(`remove ${path}`, () => backend.library.remove(path)),
    saveToJob: async (id: string): Promise<void> => {
      const { settings } = store.getState();
      const job = await attempt("save", () => backend.jobs.patch(id, { settings: withOffs(settings) }));
      if (!job) return;
      notify("info", stateText.saved(job.name));
      store.setState(({ drawing, settings: now }) =>
        drawing?.sourceId === id && now === settings ? { drawing: { ...drawing, jobId: id } } : {},
      );
    },
    actOnJob: (id: string, action: JobAction) => attempt(`${action} ${id}`, () => backend.jobs[action](id)),
    changeJob,
    /** Changes a part of a running plot's pen settings. The rest is as last requested. */
    changeJobPen: (job: Job, part: Partial<PlotSettings["pen"]>): Promise<void> => {
      store.setState({ nudgedJobId: job.id });
      return changeJob(job.id, { pen: { ...penOf(store.getState(), job), ...part } });
    },
    movePlace: (id: string, move: MovePlace) => attempt(`place ${id}`, () => backend.jobs.place(id, move)),
    moveJobPen: (id: string, up: boolean) => attempt(`pen ${id}`, () => backend.jobs.pen(id, { up })),
    moveJob: (id: string, beforeId: string | null) =>
      attempt(`move ${id}`, () => backend.jobs.move(id, { beforeId })),
    duplicateJob: (id: string) => attempt(`duplicate ${id}`, () => backend.jobs.duplicate(id)),
    setQueue: async (settings: QueueSettings): Promise<void> => {
      const id = currentPlotter(store.getState())?.id;
      if (id) await attempt("queue", () => backend.plotters.setQueue(id, settings));
    },
    patchJob: (id: string, patch: JobPatch) => attempt(`patch ${id}`, () => backend.jobs.patch(id, patch)),
    removeJob: (id: string) => attempt(`remove ${id}`, () => backend.jobs.remove(id)),
    movePen: async (up: boolean, heightPct: number): Promise<void> => {
      const id = currentPlotter(store.getState())?.id;
      if (!id) return notify("error", stateText.notConnected);
      const { pen } = store.getState().settings;
      await attempt("pen", () => backend.plotters.pen(id, { up, heightPct, settings: { pen } }));
    },
    motorsOff: async (): Promise<void> => {
      const id = currentPlotter(store.getState())?.id;
      if (id) await attempt("motors-off", () => backend.plotters.motorsOff(id));
    },
    stopMove: async (): Promise<void> => {
      const id = currentPlotter(store.getState())?.id;
      if (id) await attempt("stop", () => backend.plotters.stop(id));
    },
    /** Lets the user choose the port, where the page itself opens it. */
    connectPlotter: (id: string) => attempt("connect", () => backend.connect(id)),
    /**
     * With the page's speeds and heights; `profile`: of the machine that is being set up. Null if it failed, and the user
     * has seen why.
     */
    moveByHand: async (move: HandMove, profile?: MachineProfile): Promise<Plotter | null> => {
      const state = store.getState();
      const id = currentPlotter(state)?.id;
      const how = { settings: state.settings, profile: profile && machineProfileSchema.parse(profile) };
      return id ? attempt(move.kind, () => moveByHand(id, move, how)) : null;
    },
    /**
     * Plots a job that is not the drawing on the paper: at once, or after the running plot. Null: it could not be
     * added, and the user has seen why.
     */
    plotJob: async ({ drawing, ...newJob }: NewJob & { readonly drawing: string }): Promise<Job | null> => {
      const plotterId = currentPlotter(store.getState())?.id;
      const job = await attempt("add", () =>
        addJob(backend, { ...newJob, ...(plotterId ? { plotterId } : {}) }, drawing),
      );
      if (!job) return null;
      store.setState(({ utilityJobIds }) => ({ utilityJobIds: [...utilityJobIds, job.id] }));
      if (activeJob(store.getState()) === null) await attempt("plot", () => backend.jobs.start(job.id));
      else notify("info", stateText.added(job.name));
      return job;
    },
  };
};
