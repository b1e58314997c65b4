/** The user's actions as functions on the store. Those for jobs and the plotter are in job-actions.ts. */
import type { MachineProfile, StrokeSet } from "../../src/index.js";
import { findMachine, isDrawingName, placedForPage, type PaperSize } from "../../src/internal.js";
import { BackendFault, type Backend } from "../backend/backend.js";
import type { Job, PlotSettings, Preset } from "../../src/schema/index.js";
import { stateText } from "./text.js";
import type { Planner } from "../worker/planner.js";
import { contentOf, type DrawingText } from "../worker/drawing-text.js";
import type { ExportFormat, PlanFault } from "../worker/protocol.js";
import { createJobActions } from "./job-actions.js";
import { forOtherDrawing } from "./other-drawing.js";
import { createAsOperator } from "./take-over.js";
import { createPlotterSync, openedSettings, withMachine } from "./plotter-sync.js";
import { fromPreset, withPreset } from "./presets.js";
import type { ViewSettings } from "./persist.js";
import {
  boardFirmware,
  type Notice,
  type OpenDrawing,
  type PageState,
  type PageStore,
  type PageView,
  type UndoStep,
} from "./store.js";

export type Actions = ReturnType<typeof createActions>;

const UNDO_DEPTH = 100;
/** Changes of the same thing within this time are one undo step, so that dragging a slider is one step. */
const COALESCE_MS = 800;
const INFO_MS = 5_000;
const HEAD_LENGTH = 4_096;

const headOf = (content: DrawingText): string => {
  const head = content.slice(0, HEAD_LENGTH);
  return typeof head === "string" ? head : new TextDecoder().decode(head);
};

interface ActionDeps {
  readonly store: PageStore;
  readonly backend: Backend;
  readonly planner: Pick<Planner, "request" | "export" | "strokes">;
  nowMs(): number;
  after(delayMs: number, callback: () => void): void;
}

export const createActions = (deps: ActionDeps) => {
  const { store, backend, planner } = deps;
  let nextNotice = 1;
  let nextDrawing = 1;
  /** The drawing before the one being opened, to return to if the new file can't be read. */
  let lastGood: Pick<PageState, "drawing" | "settings"> | null = null;
  /** A drawing that has just been opened, until its page size is known. */
  let unplacedKey: string | null = null;
  let lastChange = { what: "", atMs: -Infinity };

  const notify = (kind: Notice["kind"], text: string): void => {
    const notice = { id: nextNotice++, kind, text };
    store.setState(({ notices }) => ({
      notices: [...notices.filter((n) => n.text !== text), notice].slice(-4),
    }));
    if (kind === "info") deps.after(INFO_MS, () => dismiss(notice.id));
  };
  const dismiss = (id: number): void =>
    store.setState(({ notices }) => ({ notices: notices.filter((notice) => notice.id !== id) }));

  /** A successful action makes earlier error messages obsolete. */
  const clearErrors = (): void =>
    store.setState(({ notices }) => ({ notices: notices.filter(({ kind }) => kind !== "error") }));

  const asOperator = createAsOperator(store, backend);

  /** Sends a request to the server. A failure becomes a notice. The button called `name` is disabled meanwhile. */
  const attempt = async <T>(name: string, request: () => Promise<T>): Promise<T | null> => {
    store.setState({ busyAction: name });
    try {
      const answer = await asOperator(request);
      clearErrors();
      return answer;
    } catch (error) {
      notify("error", error instanceof Error ? error.message : String(error));
      return null;
    } finally {
      store.setState(({ busyAction }) => (busyAction === name ? { busyAction: null } : {}));
    }
  };

  const replan = (): void => {
    const state = store.getState();
    const { drawing, settings } = state;
    if (!drawing) return;
    store.setState({ isPlanning: true });
    planner.request({ drawing, settings, firmware: boardFirmware(state) });
  };

  const setSettings = (settings: PlotSettings): void => {
    store.setState(({ drawing }) => ({ settings, drawing: drawing && { ...drawing, jobId: null } }));
    replan();
  };

  /** Stores the state for undo. `what` names the thing that is about to change. */
  const noteStep = (what: string): UndoStep => {
    const { settings, presets, undoStack } = store.getState();
    const before = { settings, presets };
    const isSame = what === lastChange.what && deps.nowMs() - lastChange.atMs < COALESCE_MS;
    lastChange = { what, atMs: deps.nowMs() };
    store.setState({
      undoStack: isSame ? undoStack : [...undoStack, before].slice(-UNDO_DEPTH),
      redoStack: [],
    });
    return before;
  };

  const changeSettings = (what: string, change: (settings: PlotSettings) => PlotSettings): void => {
    const before = noteStep(what);
    setSettings(change(before.settings));
    sync.changed(before);
  };

  const changePresets = (what: string, change: (step: UndoStep) => UndoStep["presets"]): void => {
    const before = noteStep(what);
    store.setState({ presets: change(before) });
    sync.changed(before);
  };

  /** What belongs to the plotter: the model, heights, pens and presets. */
  const sync = createPlotterSync({
    store,
    backend,
    asOperator,
    after: deps.after,
    failed: (error) => notify("error", error instanceof Error ? error.message : String(error)),
    show: ({ settings, presets }, isStep) => {
      if (isStep) noteStep("of the plotter, elsewhere");
      else store.setState({ undoStack: [], redoStack: [] });
      store.setState({ presets });
      if (settings !== store.getState().settings) setSettings(settings);
    },
  });

  const step = (from: "undoStack" | "redoStack", to: "undoStack" | "redoStack"): void => {
    const state = store.getState();
    const target = state[from].at(-1);
    if (!target) return;
    lastChange = { what: "", atMs: -Infinity };
    const { settings, presets } = state;
    store.setState({
      [from]: state[from].slice(0, -1),
      [to]: [...state[to], { settings, presets }],
      presets: target.presets,
    });
    if (target.settings !== settings) setSettings(target.settings);
    sync.changed(state);
  };

  const openDrawing = (name: string, svg: DrawingText, jobId: string | null = null): void => {
    clearErrors();
    const { drawing, planned, settings } = store.getState();
    const isOther = jobId === null && name !== drawing?.name;
    const key = `drawing-${nextDrawing++}`;
    if (drawing && planned) lastGood = { drawing, settings };
    unplacedKey = isOther ? key : null;
    store.setState({
      drawing: { key, name, text: svg, jobId, sourceId: jobId },
      // A file that was edited and opened again keeps its layer settings and its place.
      settings: isOther ? forOtherDrawing(settings) : settings,
      planned: null,
      fault: null,
      pageView: "prepare",
    });
    // After a job, the plotter's own heights and pens apply again.
    if (jobId === null) sync.follow(false);
    replan();
  };

  /** Called when the drawing's page size is known. Places a drawing that was just opened, as one undo step. */
  const placeForPage = (drawingKey: string, page: PaperSize): void => {
    lastGood = null;
    if (drawingKey !== unplacedKey) return;
    unplacedKey = null;
    const { settings } = store.getState();
    const prepare = placedForPage(settings.prepare, page, findMachine(settings));
    if (prepare !== settings.prepare) changeSettings("place for page", (now) => ({ ...now, prepare }));
  };

  /** Returns to the previous drawing if the one just opened can't be read. False: there is none to return to. */
  const wentBack = ({ stage, message }: PlanFault): boolean => {
    const { drawing: unread } = store.getState();
    if (stage !== "import" || !lastGood || !unread) return false;
    store.setState({ ...lastGood, planned: null, fault: null });
    lastGood = null;
    replan();
    notify("error", stateText.cannotRead(unread.name, message));
    return true;
  };

  /** Shows the drawing of the last visit. The settings were restored before. */
  const restoreDrawing = (kept: Omit<OpenDrawing, "key">): void => {
    store.setState({ drawing: { key: `drawing-${nextDrawing++}`, ...kept }, planned: null, fault: null });
    replan();
  };

  const showJobSettings = (job: Job): void => {
    const settings = openedSettings(store.getState(), job);
    const isJobs = JSON.stringify(settings) === JSON.stringify(job.settings);
    store.setState(({ drawing }) => ({
      settings,
      drawing: drawing && { ...drawing, jobId: isJobs ? job.id : null },
    }));
    replan();
  };

  /**
   * If the restored drawing is a job's, its settings come from the job: another tab may have stored others meanwhile.
   */
  const takeJobSettings = (): void => {
    const { drawing, jobs, settings } = store.getState();
    if (!drawing || drawing.jobId === null) return;
    const job = jobs.find(({ id }) => id === drawing.jobId);
    if (!job) store.setState({ drawing: { ...drawing, jobId: null } });
    else if (JSON.stringify(job.settings) !== JSON.stringify(settings)) showJobSettings(job);
  };

  const openFile = async (file: File): Promise<void> => {
    const svg = await file.arrayBuffer().then(contentOf, () => null);
    if (svg === null) notify("error", stateText.unreadable(file.name));
    else if (headOf(svg).includes("\0")) notify("error", stateText.notText(file.name));
    else openDrawing(isDrawingName(file.name) ? file.name.replace(/\.\w+$/, "") : file.name, svg);
  };

  const openPasted = (svg: string): void => {
    if (/<svg[\s>]/i.test(svg)) openDrawing(stateText.pastedName, svg);
    else notify("error", stateText.pasteNothing);
  };

  const openSample = async (name: string, title: string): Promise<void> => {
    const svg = await attempt("sample", () => backend.sample(name));
    if (svg !== null) openDrawing(title, svg);
  };

  const openJob = async (job: Job): Promise<void> => {
    const svg = await attempt(`open ${job.id}`, () => backend.jobDrawing(job.id));
    if (svg === null) return;
    store.setState({ undoStack: [], redoStack: [] });
    openDrawing(job.name, svg, job.id);
    showJobSettings(job);
  };

  return {
    notify,
    dismiss,
    attempt,
    replan,
    changeSettings,
    undo: () => step("undoStack", "redoStack"),
    redo: () => step("redoStack", "undoStack"),
    changeView: (change: Partial<ViewSettings>): void =>
      store.setState(({ view }) => ({ view: { ...view, ...change } })),
    /** Watch shows the running job; `jobId` names an ended job to show instead. */
    showView: (pageView: PageView, jobId?: string): void =>
      store.setState(({ watchedId }) => ({ pageView, watchedId: jobId ?? watchedId, isFullScreen: false })),
    openDrawing,
    placeForPage,
    wentBack,
    restoreDrawing,
    takeJobSettings,
    openFile,
    openPasted,
    openSample,
    openJob,
    ...createJobActions({ store, backend, attempt, notify }),
    takeOver: () => attempt("take-over", () => backend.takeOver()),
    /** Gets this browser's identity. Called on each connection, because a restarted server may have forgotten it. */
    meet: async (): Promise<void> => {
      try {
        store.setState({ me: await backend.me(), isUnpaired: false });
      } catch (error) {
        if (error instanceof BackendFault && error.code === "not-allowed")
          store.setState({ isUnpaired: true });
      }
    },
    dismissServerNotice: (id: string) => attempt(`notice ${id}`, () => backend.dismissNotice(id)),
    /** Sets the machine in this page's settings and on the plotter, which uses it for moves by hand. */
    chooseMachine: (profile: MachineProfile | null): void => {
      if (profile) changeSettings("machine", (settings) => withMachine(settings, profile));
    },
    /** Shows another plotter with its model, heights, pens and presets. */
    choosePlotter: (id: string): void => {
      store.setState({ plotterId: id });
      sync.follow();
    },
    followPlotter: (): void => sync.follow(),
    takeOverKept: sync.takeOver,
    loadMachines: async (): Promise<void> => {
      const machines = await attempt("machines", () => backend.machines());
      if (machines) store.setState({ machines });
    },
    savePreset: (name: string): void =>
      changePresets(`save ${name}`, ({ presets, settings }) => withPreset(presets, name, settings)),
    takePreset: (preset: Preset): void =>
      changeSettings(`preset ${preset.name}`, (settings) => fromPreset(settings, preset)),
    removePreset: (name: string): void =>
      changePresets(`remove ${name}`, ({ presets }) => presets.filter((preset) => preset.name !== name)),
    /** Gets the strokes of the current plan, to simulate the pen on them. Not answered while another plan is made. */
    askStrokes: (take: (strokes: StrokeSet) => void): void => planner.strokes(take),
    exportAs: (format: ExportFormat, firmware: string): void => planner.export(format, firmware),
    loadSamples: async (): Promise<void> => {
      const samples = await attempt("samples", () => backend.samples());
      if (samples) store.setState({ samples });
    },
  };
};
