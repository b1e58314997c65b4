/** A sheet as the text of one drawing, and back. Loaded with the first sheet. */
import { sheetSize, parseSheet, type SheetFile } from "../../src/internal.js";
import type { PlotSettings } from "../../src/schema/index.js";
import { textOf, type DrawingText } from "../backend/drawing-text.js";
import { mapOfMatrix, matrixOf } from "../scene/arrange.js";
import type { FileMeasured, PageSheet, SheetSourceFile } from "../worker/protocol.js";
import type { PlannerFile } from "../worker/planner.js";

let nextFile = 1;
let nextPiece = 1;
export const newFileKey = (): string => `file-${nextFile++}`;
export const newPieceId = (): string => `piece-${nextPiece++}`;

export const textOfSheet = ({ files, pieces }: PageSheet, prepare: PlotSettings["prepare"]): string => {
  const sheet: SheetFile = {
    format: "plotwright-sheet",
    version: 1,
    ...sheetSize(prepare),
    files: files.map(({ name, text, layerPrefix }) => ({ name, text: textOf(text), layerPrefix })),
    items: pieces.map(({ fileKey, map, isCropped }) => ({
      file: files.findIndex(({ key }) => key === fileKey),
      matrix: matrixOf(map),
      ...(isCropped ? { crop: true } : {}),
    })),
  };
  return JSON.stringify(sheet);
};

/** Null for a text that is damaged: it is opened as a drawing then, and the reader says what is wrong with it. */
export const sheetOfText = async (
  content: DrawingText,
  measure: (file: PlannerFile) => Promise<FileMeasured>,
): Promise<PageSheet | null> => {
  const sheet = parsed(textOf(content));
  if (sheet === null) return null;
  const files: SheetSourceFile[] = [];
  for (const { name, text, layerPrefix } of sheet.files) {
    const key = newFileKey();
    const extent = await measure({ key, text });
    if ("fault" in extent) return null;
    files.push({ key, name, text, layerPrefix, extent });
  }
  const pieces = sheet.items.map(({ file, matrix, crop = false }) => ({
    id: newPieceId(),
    fileKey: files[file].key,
    map: mapOfMatrix(matrix),
    isCropped: crop,
  }));
  return { files, pieces };
};

const parsed = (text: string): SheetFile | null => {
  try {
    return parseSheet(text);
  } catch {
    return null;
  }
};
