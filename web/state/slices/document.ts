/** The drawing on the paper, how it is plotted, and the steps back. Its actions: ../document-actions.ts, ../undo.ts. */
import type { PaperSize } from "../../../src/internal.js";
import type { PlotSettings, Preset } from "../../../src/schema/index.js";
import type { DrawingText } from "../../backend/drawing-text.js";
import type { PageSheet } from "../../worker/protocol.js";

/** The drawing on the paper. */
export interface OpenDrawing {
  readonly key: string;
  readonly name: string;
  /** Empty for a sheet. */
  readonly text: DrawingText;
  /** Several drawings on the sheet; null: one drawing, that of the text. */
  readonly sheet: PageSheet | null;
  /** The job that it was opened from or sent as, as long as the settings are that job's. */
  readonly jobId: string | null;
  /** The single job that it was opened from or sent as, even after the settings were changed. */
  readonly sourceId: string | null;
}

/** What undo restores. */
export type UndoStep = Pick<DocumentSlice, "settings" | "presets" | "drawing" | "selectedPieces">;

export interface DocumentSlice {
  readonly settings: PlotSettings;
  /** The current plotter's presets. */
  readonly presets: readonly Preset[];
  readonly undoStack: readonly UndoStep[];
  readonly redoStack: readonly UndoStep[];
  /** True until the browser has returned the drawing of the last visit. */
  readonly isStarting: boolean;
  readonly drawing: OpenDrawing | null;
  /** Ids of the selected pieces of the sheet. Some of them may be gone. */
  readonly selectedPieces: readonly string[];
  /** How many times "Add to queue" adds the drawing. */
  readonly copies: number;
  /** A paper whose size is typed into fields, also while that happens to be the size of a paper with a name. */
  readonly typedPaper: PaperSize | null;
}

/** Without what the last visit left. */
export const DOCUMENT_AT_FIRST = {
  presets: [],
  undoStack: [],
  redoStack: [],
  isStarting: true,
  drawing: null,
  selectedPieces: [],
  copies: 1,
  typedPaper: null,
} as const satisfies Partial<DocumentSlice>;
