/** The user's actions that put a drawing on the paper. */
import { isSameJson, isSheetBegun, tileCount } from "../../src/internal.js";
import { type Job, DEFAULT_PLOT_SETTINGS, type PlotSettings } from "../../src/schema/index.js";
import type { Backend } from "../backend/backend.js";
import type { DrawingText } from "../backend/drawing-text.js";
import type { FileMeasured, PageSheet, PlanFault } from "../worker/protocol.js";
import type { PlannerFile } from "../worker/planner.js";
import { contentOfDrawing, headOf } from "./drawing-content.js";
import type { createUiActions } from "./ui-actions.js";
import { openedSettings } from "./plotter-sync.js";
import type { OpenDrawing, PageState, PageStore } from "./store.js";
import { stateText } from "./text.js";
import type { createUndo } from "./undo.js";

/**
 * Whether the drawing is opened again, perhaps after it was edited. Files are known by their name. Pasted drawings all
 * have the same one, so only their text tells them apart.
 */
const isAgain = (before: OpenDrawing, name: string, text: DrawingText): boolean =>
  before.sheet === null && name === before.name && (name !== stateText.pastedName || text === before.text);

interface DocumentParts {
  readonly store: PageStore;
  readonly backend: Pick<Backend, "samples" | "jobs" | "library">;
  readonly ui: Pick<ReturnType<typeof createUiActions>, "notify" | "clearErrors">;
  readonly undo: ReturnType<typeof createUndo>;
  attempt<T>(name: string, request: () => Promise<T>): Promise<T | null>;
  replan(): void;
  measure(file: PlannerFile): Promise<FileMeasured>;
  /** Shows the plotter's own heights and pens again, without an undo step. */
  followPlotter(): void;
}

export const createDocumentActions = (parts: DocumentParts) => {
  const { store, backend, ui, undo, attempt, replan, measure, followPlotter } = parts;
  let nextDrawing = 1;
  /** The drawing before the one being opened, to return to if the new file can't be read. */
  let lastGood: Pick<PageState, "drawing" | "settings"> | null = null;
  /** Another drawing that has just been opened, until its file is read. */
  let unreadKey: string | null = null;
  let lastRequest = 0;

  /**
   * Called when the user asks for a drawing. The result tells whether that is still the last one asked for: a file that
   * arrives late must not replace a newer one.
   */
  const startRequest = (): (() => boolean) => {
    const request = ++lastRequest;
    return () => request === lastRequest;
  };

  const isSheet = (text: DrawingText): boolean => isSheetBegun(headOf(text).trimStart());
  const sheetIn = async (text: DrawingText): Promise<PageSheet | null> =>
    isSheet(text) ? (await import("./sheet-text.js")).sheetOfText(text, measure) : null;

  const openDrawing = (
    name: string,
    text: DrawingText,
    jobId: string | null = null,
    sheet: PageSheet | null = null,
  ): void => {
    ui.clearErrors();
    const { drawing, planned, settings } = store.getState();
    const isOther = jobId === null && (drawing === null || !isAgain(drawing, name, text));
    const key = `drawing-${nextDrawing++}`;
    if (drawing && planned) lastGood = { drawing, settings };
    unreadKey = isOther ? key : null;
    store.setState({
      drawing: { key, name, text: sheet ? "" : text, sheet, jobId, sourceId: jobId },
      selectedPieces: [],
      copies: 1,
      // A file that was edited and opened again keeps its layer settings and its place.
      settings: isOther ? forOtherDrawing(settings) : settings,
      planned: null,
      fault: null,
      pageView: "prepare",
    });
    // After a job, the plotter's own heights and pens apply again.
    if (jobId === null) followPlotter();
    replan();
  };

  /** Called when the drawing's file has been read. */
  const noteRead = (drawingKey: string): void => {
    lastGood = null;
    if (drawingKey !== unreadKey) return;
    unreadKey = null;
    // Earlier steps hold the layers and the place of the drawing before. Cleared only now: the file could be read.
    undo.clear();
  };

  /** Returns to the previous drawing if the one just opened can't be read. False: there is none to return to. */
  const revertedAfterFault = ({ stage, message }: PlanFault): boolean => {
    const { drawing: unread } = store.getState();
    if (stage !== "import" || !lastGood || !unread) return false;
    store.setState({ ...lastGood, planned: null, fault: null });
    lastGood = null;
    replan();
    ui.notify("error", stateText.cannotRead(unread.name, message));
    return true;
  };

  /** Shows the drawing of the last visit. The settings were restored before. */
  const restoreDrawing = async (kept: Omit<OpenDrawing, "key" | "sheet">): Promise<void> => {
    const sheet = isSheet(kept.text) ? await sheetIn(kept.text) : null;
    // Another drawing was opened meanwhile.
    if (sheet && store.getState().drawing !== null) return;
    const drawing = { ...kept, key: `drawing-${nextDrawing++}`, text: sheet ? "" : kept.text, sheet };
    store.setState({ drawing, planned: null, fault: null });
    replan();
  };

  const showJobSettings = (job: Job): void => {
    const settings = openedSettings(store.getState(), job);
    const jobId = isSameJson(settings, job.settings) ? job.id : null;
    store.setState(({ drawing }) => ({ settings, drawing: drawing && { ...drawing, jobId } }));
    replan();
  };

  return {
    openDrawing,
    noteRead,
    revertedAfterFault,
    restoreDrawing,
    /**
     * If the restored drawing is a job's, its settings come from the job: another tab may have stored others meanwhile.
     */
    takeJobSettings: (): void => {
      const { drawing, jobs, settings } = store.getState();
      if (!drawing || drawing.jobId === null) return;
      const job = jobs.find(({ id }) => id === drawing.jobId);
      if (!job) store.setState({ drawing: { ...drawing, jobId: null } });
      else if (!isSameJson(job.settings, settings)) showJobSettings(job);
    },
    openFile: async (file: File): Promise<void> => {
      const isLast = startRequest();
      const content = await contentOfDrawing(file);
      if (!isLast()) return;
      if ("problem" in content) return ui.notify("error", content.problem);
      const { name, text } = content;
      const sheet = await sheetIn(text);
      if (isLast()) openDrawing(name, text, null, sheet);
    },
    openPasted: (text: string): void => {
      if (!/<svg[\s>]/i.test(text)) return ui.notify("error", stateText.pasteNothing);
      startRequest();
      openDrawing(stateText.pastedName, text);
    },
    openSample: async (name: string, title: string): Promise<void> => {
      const isLast = startRequest();
      const svg = await attempt("sample", () => backend.samples.get(name));
      if (svg !== null && isLast()) openDrawing(title, svg);
    },
    openFromLibrary: async (path: string): Promise<void> => {
      const isLast = startRequest();
      const text = await attempt(`open ${path}`, () => backend.library.get(path));
      if (text !== null && isLast()) openDrawing(path.replace(/^.*\//, "").replace(/\.\w+$/, ""), text);
    },
    openJob: async (job: Job): Promise<void> => {
      const isLast = startRequest();
      const text = await attempt(`open ${job.id}`, () => backend.jobs.drawing(job.id));
      if (text === null || !isLast()) return;
      const sheet = await sheetIn(text);
      if (!isLast()) return;
      undo.clear();
      openDrawing(job.name, text, job.id, sheet);
      showJobSettings(job);
    },
  };
};

/** Layers identified by a colour mean the same in every drawing. */
const isColorId = (id: string): boolean => /^#[0-9a-f]{6}$/.test(id);

/** What was chosen for one drawing: its place by hand, its filled shapes, what happens outside the paper, its px per inch, its sheets. */
const OF_ONE_DRAWING = [
  "layout",
  "hatch",
  "hatchOutlines",
  "outlineFills",
  "hideCovered",
  "outside",
  "pxPerInch",
  "tileColumns",
  "tileRows",
  "tile",
] as const satisfies readonly (keyof PlotSettings["prepare"])[];

/** The settings for another drawing: without those of single layers, except layers identified by a colour. */
export const forOtherDrawing = (settings: PlotSettings): PlotSettings => {
  const kept = <T>(byLayer: Readonly<Record<string, T>> | undefined): Record<string, T> =>
    Object.fromEntries(Object.entries(byLayer ?? {}).filter(([id]) => isColorId(id)));
  const { motion, pen, prepare } = settings;
  const usual = DEFAULT_PLOT_SETTINGS.prepare;
  return {
    ...settings,
    prepare: {
      ...prepare,
      ...Object.fromEntries(OF_ONE_DRAWING.map((name) => [name, usual[name]])),
      // To fill several sheets it was fitted to them.
      fit: tileCount(prepare) > 1 ? usual.fit : prepare.fit,
      hiddenLayers: [],
      shownLayers: [],
      layerOrder: prepare.layerOrder.filter(isColorId),
      layerRepeats: kept(prepare.layerRepeats),
      layerHatches: prepare.layerHatches.filter(({ layer }) => isColorId(layer)),
    },
    motion: motion.layers ? { ...motion, layers: kept(motion.layers) } : motion,
    pen: pen.layers ? { ...pen, layers: kept(pen.layers) } : pen,
    layerPens: kept(settings.layerPens),
    layerStops: kept(settings.layerStops),
  };
};
