/** The user's actions as functions on the store: those of each slice, and those that need several. */
import type { MachineProfile } from "../../src/index.js";
import type { Backend } from "../backend/backend.js";
import {
  fromPreset,
  withoutPreset,
  withPreset,
  type PlotSettings,
  type Preset,
} from "../../src/schema/index.js";
import type { Planner } from "../worker/planner.js";
import { createDocumentActions } from "./document-actions.js";
import { createPlanActions } from "./plan-actions.js";
import { createPlayerActions } from "./player-actions.js";
import { createSheetActions } from "./sheet-actions.js";
import { createServerActions } from "./server-actions.js";
import { createAsOperator } from "./take-over.js";
import { createPlotterSync, withMachine } from "./plotter-sync.js";
import type { PageStore } from "./store.js";
import { createUiActions } from "./ui-actions.js";
import { createUndo } from "./undo.js";

export type Actions = ReturnType<typeof createActions>;

interface ActionDeps {
  readonly store: PageStore;
  readonly backend: Backend;
  readonly planner: Pick<Planner, "request" | "export" | "strokes" | "sketches" | "measure">;
  nowMs(): number;
  after(delayMs: number, callback: () => void): void;
}

export const createActions = (deps: ActionDeps) => {
  const { store, backend, planner } = deps;
  const ui = createUiActions(store, deps.after);
  const plan = createPlanActions(store, planner);
  const asOperator = createAsOperator(store, backend);

  /** Sends a request to the server. A failure becomes a notice. The button called `name` is disabled meanwhile. */
  const attempt = async <T>(name: string, request: () => Promise<T>): Promise<T | null> => {
    store.setState({ busyAction: name });
    try {
      const answer = await asOperator(request);
      ui.clearErrors();
      return answer;
    } catch (error) {
      failed(error);
      return null;
    } finally {
      store.setState(({ busyAction }) => (busyAction === name ? { busyAction: null } : {}));
    }
  };
  const failed = (error: unknown): void =>
    ui.notify("error", error instanceof Error ? error.message : String(error));

  const setSettings = (settings: PlotSettings): void => {
    store.setState(({ drawing }) => ({ settings, drawing: drawing && { ...drawing, jobId: null } }));
    plan.replan();
  };

  const undo = createUndo({
    store,
    nowMs: () => deps.nowMs(),
    setSettings,
    setDocument: ({ settings, drawing }) => {
      store.setState({ settings, drawing: drawing && { ...drawing, jobId: null } });
      plan.replan();
    },
    changed: (before) => sync.changed(before),
  });

  /** What belongs to the plotter: the model, heights, pens and presets. */
  const sync = createPlotterSync({
    store,
    backend,
    asOperator,
    after: deps.after,
    failed,
    show: ({ settings, presets }, isStep) => {
      if (isStep) undo.noteStep("of the plotter, elsewhere");
      else undo.clear();
      store.setState({ presets });
      if (settings !== store.getState().settings) setSettings(settings);
    },
  });

  /** Sets the machine in this page's settings and on the plotter, which uses it for moves by hand. */
  const chooseMachine = (profile: MachineProfile | null): void => {
    if (!profile) return;
    const isShown = store.getState().settings.machine === profile.id;
    undo.changeSettings("machine", (settings) => withMachine(settings, profile));
    if (isShown) sync.confirmed(profile.id);
  };

  const measure: Planner["measure"] = (file) => planner.measure(file);
  const document = createDocumentActions({
    store,
    backend,
    ui,
    undo,
    attempt,
    replan: plan.replan,
    measure,
    followPlotter: () => sync.follow(false),
  });
  const sheet = createSheetActions({ store, ui, undo, measure });

  return {
    ...ui,
    ...plan,
    ...createPlayerActions(store),
    ...document,
    ...sheet,
    /** The first of the files replaces the drawing, unless they are added; the others are added. */
    openDropped: async ([first, ...others]: readonly File[], isAdded: boolean): Promise<void> => {
      if (!first) return;
      if (isAdded) return sheet.addFiles([first, ...others]);
      await document.openFile(first);
      if (others.length > 0) await sheet.addFiles(others);
    },
    ...createServerActions({ store, backend, attempt, notify: ui.notify }),
    attempt,
    changeSettings: undo.changeSettings,
    undo: undo.undo,
    redo: undo.redo,
    chooseMachine,
    /** Shows another plotter with its model, heights, pens and presets. */
    choosePlotter: (id: string): void => {
      store.setState({ plotterId: id });
      sync.follow();
    },
    followPlotter: (): void => sync.follow(),
    /** Saves a custom machine and chooses it. Null if it failed, and the user has seen why. */
    saveMachine: async (profile: MachineProfile): Promise<MachineProfile | null> => {
      const saved = await attempt("machine", () => backend.machines.save(profile.id, profile));
      chooseMachine(saved);
      return saved;
    },
    removeMachine: ({ id }: MachineProfile) => attempt("machine", () => backend.machines.remove(id)),
    savePreset: (name: string): void =>
      undo.changePresets(`save ${name}`, ({ presets, settings }) => withPreset(presets, name, settings)),
    takePreset: (preset: Preset): void =>
      undo.changeSettings(`preset ${preset.name}`, (settings) => fromPreset(settings, preset)),
    removePreset: (name: string): void =>
      undo.changePresets(`remove ${name}`, ({ presets }) => withoutPreset(presets, name)),
  };
};
