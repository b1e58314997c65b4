/** What the actions on a sheet do: adding, copying, removing and moving drawings. Loaded with the first one. */
import { compose, isEmptyBox, orientedPaper, sheetOf } from "../../src/internal.js";
import type { PlotSettings } from "../../src/schema/index.js";
import { asAdded, atFreePlace, fittedInto, gridOf, movedOnto, type GridWish } from "../scene/arrange.js";
import type { PageSheet, SheetPiece, SheetSourceFile } from "../worker/protocol.js";
import { contentOfDrawing } from "./drawing-content.js";
import {
  sheetSettings,
  type PlacedPiece,
  type SheetEdit,
  type SheetParts,
  type SheetRoom,
} from "./sheet-settings.js";
import { newFileKey, newPieceId } from "./sheet-text.js";
import type { PageState, PageStore } from "./store.js";
import { stateText } from "./text.js";

interface Parts extends SheetParts {
  changeSheet(what: string, sheet: PageSheet, name?: string): void;
}

export const roomOf = ({ prepare }: PlotSettings): SheetRoom => {
  try {
    return sheetOf(prepare);
  } catch {
    // The margins leave no room.
    const { widthMm, heightMm } = orientedPaper(prepare.paper, prepare.landscape);
    const paper = { x0: 0, y0: 0, x1: widthMm, y1: heightMm };
    return { paper, inside: paper };
  }
};

/** The drawings on the sheet, in paint order, as they lie on the paper. Empty without a sheet. */
export const piecesOnPaper = ({ drawing, settings, planned }: PageState): readonly PlacedPiece[] => {
  if (!drawing?.sheet) return [];
  const { files, pieces } = drawing.sheet;
  // A sheet from elsewhere may be placed by its settings as a whole, until it is changed here.
  const isPlacedAsWhole = JSON.stringify(sheetSettings(settings)) !== JSON.stringify(settings);
  const toPaper = isPlacedAsWhole && planned?.drawingKey === drawing.key ? planned.pageToPaper : null;
  return pieces.flatMap((piece) => {
    const file = files.find(({ key }) => key === piece.fileKey);
    if (!file || isEmptyBox(file.extent.content)) return [];
    const map = toPaper ? compose(toPaper, piece.map) : piece.map;
    return [{ ...piece, map, extent: file.extent, name: file.name }];
  });
};

const asSheet = (files: readonly SheetSourceFile[], pieces: readonly PlacedPiece[]): PageSheet => ({
  files: files.filter(({ key }) => pieces.some(({ fileKey }) => fileKey === key)),
  pieces: pieces.map(({ id, fileKey, map, isCropped }) => ({ id, fileKey, map, isCropped })),
});

/** The page's sheet with other pieces; null without a sheet, or if none is left. */
export const withPieces = ({ drawing }: PageState, pieces: readonly PlacedPiece[]): PageSheet | null =>
  drawing?.sheet && pieces.length > 0 ? asSheet(drawing.sheet.files, pieces) : null;

/** A single drawing becomes a sheet once it is planned. Added pieces are selected. */
export const editSheet = async (parts: Parts, what: string, edit: SheetEdit): Promise<void> => {
  const found = parts.store.getState().drawing?.sheet ? currentSheet(parts.store) : await foundSheet(parts);
  if (!found) return;
  const { files, pieces } = found;
  const after = edit(pieces, roomOf(parts.store.getState().settings));
  if (after.length === 0) return;
  parts.changeSheet(what, asSheet(files, after));
  const added = after.filter((piece) => !pieces.some(({ id }) => id === piece.id)).map(({ id }) => id);
  if (added.length > 0) parts.store.setState({ selectedPieces: added });
};

interface Found {
  readonly files: readonly SheetSourceFile[];
  readonly pieces: readonly PlacedPiece[];
}

const currentSheet = (store: PageStore): Found => {
  const state = store.getState();
  return { files: state.drawing?.sheet?.files ?? [], pieces: piecesOnPaper(state) };
};

/** The sheet, or the single drawing as one. Null if it can't be drawn, or another one was opened meanwhile. */
const foundSheet = async ({ store, measure }: Parts): Promise<Found | null> => {
  const { drawing } = store.getState();
  if (!drawing) return null;
  if (drawing.sheet) return currentSheet(store);
  const extent = await measure(drawing);
  if ("fault" in extent || isEmptyBox(extent.content) || !(await isPlanned(store))) return null;
  const { planned, settings, drawing: now } = store.getState();
  if (!planned || now?.key !== drawing.key) return null;
  if (now.sheet) return currentSheet(store);
  const file = { key: drawing.key, name: drawing.name, text: drawing.text, layerPrefix: "", extent };
  const piece: PlacedPiece = {
    id: newPieceId(),
    name: drawing.name,
    fileKey: file.key,
    map: planned.fileToPaper,
    isCropped: settings.prepare.cropToPage,
    extent,
  };
  return { files: [file], pieces: [piece] };
};

/** Waits until the drawing is planned with the current settings. False: it can't be planned. */
const isPlanned = (store: PageStore): Promise<boolean> =>
  new Promise((resolve) => {
    const check = ({ isPlanning, planned }: PageState): void => {
      if (isPlanning) return;
      stop();
      resolve(planned !== null);
    };
    const stop = store.subscribe(check);
    check(store.getState());
  });

/** Adds the files where there is room. Each one that can't be read is named. */
export const addFiles = async (parts: Parts, given: readonly File[]): Promise<void> => {
  const { store, ui, measure, changeSheet } = parts;
  const added: SheetSourceFile[] = [];
  for (const one of given) {
    const content = await contentOfDrawing(one);
    if ("problem" in content) {
      ui.notify("error", content.problem);
      continue;
    }
    const { name, text } = content;
    const key = newFileKey();
    const extent = await measure({ key, text });
    if ("fault" in extent) ui.notify("error", stateText.cannotRead(name, extent.fault));
    else if (isEmptyBox(extent.content)) ui.notify("error", stateText.drawsNothing(name));
    else added.push({ key, name, text, layerPrefix: "", extent });
  }
  const found = added.length > 0 ? await foundSheet(parts) : null;
  if (!found) return;
  const files = [...found.files];
  const pieces = [...found.pieces];
  const { inside } = roomOf(store.getState().settings);
  for (const file of added) {
    const known = files.find(({ text }) => text === file.text);
    if (!known) files.push({ ...file, layerPrefix: freePrefix(files) });
    const { key, name, extent } = known ?? file;
    pieces.push({ id: newPieceId(), name, fileKey: key, ...asAdded(extent, pieces, inside) });
  }
  const selected = pieces.slice(found.pieces.length).map(({ id }) => id);
  const names = files.map(({ name }) => name);
  changeSheet("add", asSheet(files, pieces), stateText.sheetName(names));
  store.setState({ selectedPieces: selected });
};

/** Layers of files that were added later have ids of their own, also after the first file was removed. */
const freePrefix = (files: readonly SheetSourceFile[]): string => {
  let number = files.length + 1;
  while (files.some(({ layerPrefix }) => layerPrefix === `${number}/`)) number++;
  return `${number}/`;
};

const isOneOf =
  (ids: readonly string[]) =>
  ({ id }: SheetPiece): boolean =>
    ids.includes(id);

/** Changes the pieces with these ids. */
export const eachOf =
  (ids: readonly string[], change: (piece: PlacedPiece, room: SheetRoom) => PlacedPiece): SheetEdit =>
  (pieces, room) =>
    pieces.map((piece) => (isOneOf(ids)(piece) ? change(piece, room) : piece));

export const without =
  (ids: readonly string[]): SheetEdit =>
  (pieces) =>
    pieces.filter((piece) => !isOneOf(ids)(piece));

/** Adds a copy of each of them, where there is room. */
export const duplicated =
  (ids: readonly string[]): SheetEdit =>
  (pieces, { inside }) =>
    pieces
      .filter(isOneOf(ids))
      .reduce<readonly PlacedPiece[]>(
        (all, piece) => [...all, { ...atFreePlace(piece, all, inside), id: newPieceId() }],
        pieces,
      );

/** Copies of the first of them in a grid, in place of all of them that show the same drawing. */
export const inGrid =
  (ids: readonly string[], wish: GridWish): SheetEdit =>
  (pieces, { inside }) => {
    const first = pieces.find(isOneOf(ids)) ?? pieces.at(-1);
    if (!first) return pieces;
    const isReplaced = (piece: PlacedPiece): boolean =>
      piece === first || (isOneOf(ids)(piece) && piece.fileKey === first.fileKey);
    const copies = gridOf(first, wish, inside).map((copy) => ({ ...copy, id: newPieceId() }));
    return pieces.flatMap((piece) => (piece === first ? copies : isReplaced(piece) ? [] : [piece]));
  };

export const ontoPaper: SheetEdit = (pieces, { paper }) => pieces.map((piece) => movedOnto(piece, paper));

export const fittedToMargins: SheetEdit = (pieces, { inside }) => fittedInto(pieces, inside);
