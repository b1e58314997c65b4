/** What a sheet with several drawings needs of the settings, and the types of its changes. */
import type { Box } from "../../src/internal.js";
import type { PlotSettings } from "../../src/schema/index.js";
import type { Placed } from "../scene/arrange.js";
import type { PlannerFile } from "../worker/planner.js";
import type { FileMeasured, SheetPiece } from "../worker/protocol.js";
import type { PageStore } from "./store.js";
import type { createUiActions } from "./ui-actions.js";
import type { createUndo } from "./undo.js";

/** A drawing on the sheet, with what its file draws. */
export type PlacedPiece = SheetPiece & Placed & { readonly name: string };

/** The pieces as they shall be. */
export type SheetEdit = (pieces: readonly PlacedPiece[], room: SheetRoom) => readonly PlacedPiece[];

/** The paper, and the space inside its margins, mm. */
export interface SheetRoom {
  readonly paper: Box;
  readonly inside: Box;
}

export interface SheetParts {
  readonly store: PageStore;
  readonly ui: Pick<ReturnType<typeof createUiActions>, "notify">;
  readonly undo: Pick<ReturnType<typeof createUndo>, "changeDocument">;
  measure(file: PlannerFile): Promise<FileMeasured>;
}

/** On a sheet each drawing has its place, so the settings place nothing. */
export const sheetSettings = (settings: PlotSettings): PlotSettings => {
  const { prepare } = settings;
  const isOutsidePlaced = prepare.outside === "move" || prepare.outside === "fit";
  return {
    ...settings,
    prepare: {
      ...prepare,
      fit: "auto",
      rotateDeg: "auto",
      mirror: "none",
      layout: null,
      pxPerInch: "auto",
      cropToPage: false,
      outside: isOutsidePlaced ? "refuse" : prepare.outside,
    },
  };
};
