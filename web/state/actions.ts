/**
 * The user's actions as functions on the store. Those for the drawing are in drawing-actions.ts, those for jobs and the
 * plotter in job-actions.ts.
 */
import type { MachineProfile, StrokeSet } from "../../src/index.js";
import { BackendFault, type Backend } from "../backend/backend.js";
import type { PlotSettings, Preset } from "../../src/schema/index.js";
import type { Planner } from "../worker/planner.js";
import type { ExportFormat } from "../worker/protocol.js";
import { createDrawingActions } from "./drawing-actions.js";
import { createJobActions } from "./job-actions.js";
import { createNotices } from "./notices.js";
import { createAsOperator } from "./take-over.js";
import { createPlotterSync, withMachine } from "./plotter-sync.js";
import { fromPreset, withPreset } from "./presets.js";
import type { ViewSettings } from "./persist.js";
import { boardFirmware, type PageStore, type PageView } from "./store.js";
import { createUndo } from "./undo.js";

export type Actions = ReturnType<typeof createActions>;

interface ActionDeps {
  readonly store: PageStore;
  readonly backend: Backend;
  readonly planner: Pick<Planner, "request" | "export" | "strokes">;
  nowMs(): number;
  after(delayMs: number, callback: () => void): void;
}

export const createActions = (deps: ActionDeps) => {
  const { store, backend, planner } = deps;
  const notices = createNotices(store, deps.after);
  const asOperator = createAsOperator(store, backend);

  /** Sends a request to the server. A failure becomes a notice. The button called `name` is disabled meanwhile. */
  const attempt = async <T>(name: string, request: () => Promise<T>): Promise<T | null> => {
    store.setState({ busyAction: name });
    try {
      const answer = await asOperator(request);
      notices.clearErrors();
      return answer;
    } catch (error) {
      failed(error);
      return null;
    } finally {
      store.setState(({ busyAction }) => (busyAction === name ? { busyAction: null } : {}));
    }
  };
  const failed = (error: unknown): void =>
    notices.notify("error", error instanceof Error ? error.message : String(error));

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

  const undo = createUndo({
    store,
    nowMs: () => deps.nowMs(),
    setSettings,
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
    if (profile) undo.changeSettings("machine", (settings) => withMachine(settings, profile));
  };

  return {
    notify: notices.notify,
    dismiss: notices.dismiss,
    attempt,
    replan,
    changeSettings: undo.changeSettings,
    undo: undo.undo,
    redo: undo.redo,
    changeView: (change: Partial<ViewSettings>): void =>
      store.setState(({ view }) => ({ view: { ...view, ...change } })),
    showView: (pageView: PageView): void => store.setState({ pageView, isFullScreen: false }),
    ...createDrawingActions({
      store,
      backend,
      notices,
      undo,
      attempt,
      replan,
      followPlotter: () => sync.follow(false),
    }),
    ...createJobActions({ store, backend, attempt, notify: notices.notify }),
    takeOver: () => attempt("take-over", () => backend.operator.take()),
    /** Gets this browser's identity. Called on each connection, because a restarted server may have forgotten it. */
    meet: async (): Promise<void> => {
      try {
        store.setState({ me: await backend.state.me(), isUnpaired: false });
      } catch (error) {
        if (error instanceof BackendFault && error.code === "not-allowed")
          store.setState({ isUnpaired: true });
      }
    },
    dismissServerNotice: (id: string) => attempt(`notice ${id}`, () => backend.operator.dismissNotice(id)),
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
      undo.changePresets(`remove ${name}`, ({ presets }) => presets.filter((preset) => preset.name !== name)),
    /** Gets the strokes of the current plan, to simulate the pen on them. Not answered while another plan is made. */
    askStrokes: (take: (strokes: StrokeSet) => void): void => planner.strokes(take),
    exportAs: (format: ExportFormat, firmware: string): void => planner.export(format, firmware),
    loadSamples: async (): Promise<void> => {
      const answer = await attempt("samples", () => backend.samples.list());
      if (answer) store.setState({ samples: answer.samples });
    },
  };
};
