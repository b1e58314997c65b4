/** The user's actions on a sheet with several drawings. What they do is loaded with the first one: sheet-edits.ts. */
import type { PlotSettings } from "../../src/schema/index.js";
import type { PageSheet } from "../worker/protocol.js";
import type { DrawingText } from "../backend/drawing-text.js";
import { sheetSettings, type SheetEdit, type SheetParts } from "./sheet-settings.js";
import type { OpenDrawing } from "./store.js";

/** The drawing as it is sent and stored. */
export const textOfDrawing = async (drawing: OpenDrawing, settings: PlotSettings): Promise<DrawingText> =>
  drawing.sheet === null
    ? drawing.text
    : (await import("./sheet-text.js")).textOfSheet(drawing.sheet, settings.prepare);

export const createSheetActions = (parts: SheetParts) => {
  const { store, undo } = parts;
  const changeSheet = (what: string, sheet: PageSheet, name?: string): void => {
    const { drawing, settings } = store.getState();
    if (!drawing) return;
    undo.changeDocument(`sheet ${what}`, {
      settings: sheetSettings(settings),
      drawing: { ...drawing, name: name ?? drawing.name, text: "", sheet, jobId: null, sourceId: null },
    });
  };
  const editSheet = async (what: string, edit: SheetEdit): Promise<void> =>
    (await import("./sheet-edits.js")).editSheet({ ...parts, changeSheet }, what, edit);
  const editSelected = async (
    what: string,
    edit: (edits: typeof import("./sheet-edits.js"), ids: readonly string[]) => SheetEdit,
  ): Promise<void> => {
    const { selectedPieces } = store.getState();
    // Of other drawings it is a step of its own for undo, also soon after.
    await editSheet(
      `${what} ${selectedPieces.join()}`,
      edit(await import("./sheet-edits.js"), selectedPieces),
    );
  };
  return {
    changeSheet,
    selectPieces: (selectedPieces: readonly string[]): void => store.setState({ selectedPieces }),
    /** Adds drawings to the sheet. */
    addFiles: async (files: readonly File[]): Promise<void> =>
      (await import("./sheet-edits.js")).addFiles({ ...parts, changeSheet }, files),
    /** Changes the drawings on the sheet. A single drawing becomes a sheet with the first change. */
    editSheet,
    duplicatePieces: () => editSelected("duplicate", ({ duplicated }, ids) => duplicated(ids)),
    removePieces: () => editSelected("remove", ({ without }, ids) => without(ids)),
    /** Moves each drawing that leaves the paper back onto it. */
    moveOntoPaper: () => editSelected("onto paper", ({ ontoPaper }) => ontoPaper),
    /** Fits all drawings together into the margins. */
    fitSheet: () => editSelected("fit", ({ fittedToMargins }) => fittedToMargins),
  };
};
