/** Changes of settings, sheet and presets by the user, each of which can be undone. */
import type { PlotSettings } from "../../src/schema/index.js";
import type { PageStore, UndoStep } from "./store.js";

const UNDO_DEPTH = 100;
/** Changes of the same thing within this time are one undo step, so that dragging a slider is one step. */
const COALESCE_MS = 800;
const NOTHING_CHANGED = { what: "", atMs: -Infinity };

/** What is selected and still exists. If nothing of it does: what was selected then. */
const selectionAfter = (
  { drawing, selectedPieces }: UndoStep,
  selected: readonly string[],
): readonly string[] => {
  const kept = selected.filter((id) => drawing?.sheet?.pieces.some((piece) => piece.id === id));
  return kept.length > 0 ? kept : selectedPieces;
};

interface UndoParts {
  readonly store: PageStore;
  nowMs(): number;
  setSettings(settings: PlotSettings): void;
  /** Puts settings and sheet of a step on the paper. */
  setDocument(step: Pick<UndoStep, "settings" | "drawing">): void;
  /** Called after each change by the user, with the state before it. */
  changed(before: UndoStep): void;
}

export const createUndo = ({ store, nowMs, setSettings, setDocument, changed }: UndoParts) => {
  let lastChange = NOTHING_CHANGED;

  /** Stores the state for undo. `what` names the thing that is about to change. */
  const noteStep = (what: string): UndoStep => {
    const { settings, presets, drawing, selectedPieces, undoStack } = store.getState();
    const before = { settings, presets, drawing, selectedPieces };
    const isSame = what === lastChange.what && nowMs() - lastChange.atMs < COALESCE_MS;
    lastChange = { what, atMs: nowMs() };
    store.setState({
      undoStack: isSame ? undoStack : [...undoStack, before].slice(-UNDO_DEPTH),
      redoStack: [],
    });
    return before;
  };

  const step = (from: "undoStack" | "redoStack", to: "undoStack" | "redoStack"): void => {
    const state = store.getState();
    const target = state[from].at(-1);
    if (!target) return;
    lastChange = NOTHING_CHANGED;
    const { settings, presets, drawing, selectedPieces } = state;
    store.setState({
      [from]: state[from].slice(0, -1),
      [to]: [...state[to], { settings, presets, drawing, selectedPieces }],
      presets: target.presets,
      selectedPieces: selectionAfter(target, selectedPieces),
    });
    if (target.drawing?.sheet !== drawing?.sheet) setDocument(target);
    else if (target.settings !== settings) setSettings(target.settings);
    changed(state);
  };

  return {
    noteStep,
    clear: (): void => {
      // Otherwise a change of the same thing right after would not become a step.
      lastChange = NOTHING_CHANGED;
      store.setState({ undoStack: [], redoStack: [] });
    },
    changeSettings: (what: string, change: (settings: PlotSettings) => PlotSettings): void => {
      const before = noteStep(what);
      setSettings(change(before.settings));
      changed(before);
    },
    /** Changes the sheet, perhaps together with the settings. */
    changeDocument: (what: string, step: Pick<UndoStep, "settings" | "drawing">): void => {
      const before = noteStep(what);
      setDocument(step);
      changed(before);
    },
    changePresets: (what: string, change: (step: UndoStep) => UndoStep["presets"]): void => {
      const before = noteStep(what);
      store.setState({ presets: change(before) });
      changed(before);
    },
    undo: (): void => step("undoStack", "redoStack"),
    redo: (): void => step("redoStack", "undoStack"),
  };
};
