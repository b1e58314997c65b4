/** The last drawing, stored in the browser. In IndexedDB, which has room for large ones. */
import { openDB, type IDBPDatabase } from "idb";
import { z } from "zod";
import type { DrawingText } from "../backend/drawing-text.js";
import { textOfDrawing } from "../state/sheet-actions.js";
import type { OpenDrawing, PageStore } from "../state/store.js";

const keptDrawingSchema = z.object({
  name: z.string(),
  text: z.union([z.string(), z.instanceof(ArrayBuffer)]),
  jobId: z.string().nullable(),
  sourceId: z.string().nullable(),
});
export type KeptDrawing = z.infer<typeof keptDrawingSchema>;

/** Where it is stored. Tests pass their own. */
export interface DrawingStorage {
  read(): Promise<unknown>;
  write(drawing: KeptDrawing): Promise<void>;
}

/** Null if there is none, or if the browser does not return it. */
export const readKeptDrawing = async (storage: DrawingStorage): Promise<KeptDrawing | null> => {
  const parsed = keptDrawingSchema.safeParse(await storage.read().catch(() => null));
  return parsed.success ? parsed.data : null;
};

/**
 * Stores each drawing once it has been planned; one that can't be read is not needed at the next visit. `onFault`:
 * called the first time that a drawing can't be stored.
 */
export const keepDrawing = (store: PageStore, storage: DrawingStorage, onFault: () => void): void => {
  let kept: readonly unknown[] = [];
  let isFaultKnown = false;
  let timer: ReturnType<typeof setTimeout> | undefined;
  const failed = (): void => {
    if (!isFaultKnown) onFault();
    isFaultKnown = true;
  };
  const write = ({ name, jobId, sourceId }: OpenDrawing, text: DrawingText): void =>
    void storage.write({ name, text, jobId, sourceId }).catch(failed);
  store.subscribe(({ drawing, planned, settings }) => {
    if (!drawing || planned?.drawingKey !== drawing.key) return;
    const now = [drawing.key, drawing.sheet, drawing.jobId, drawing.sourceId];
    if (now.every((value, index) => value === kept[index])) return;
    kept = now;
    clearTimeout(timer);
    if (drawing.sheet === null) return write(drawing, drawing.text);
    // While a drawing of a sheet is dragged, the sheet changes many times a second.
    timer = setTimeout(
      () => void textOfDrawing(drawing, settings).then((text) => write(drawing, text), failed),
      SHEET_RESTS_MS,
    );
  });
};

const SHEET_RESTS_MS = 400;

const DATABASE = "plotwright";
const TABLE = "page";
const KEY = "drawing";

export const browserDrawings = (): DrawingStorage => {
  let opened: Promise<IDBPDatabase> | null = null;
  const database = (): Promise<IDBPDatabase> =>
    (opened ??= openDB(DATABASE, 1, { upgrade: (db) => void db.createObjectStore(TABLE) }));
  return {
    read: async () => (await database()).get(TABLE, KEY) as Promise<unknown>,
    write: async (drawing) => {
      const db = await database();
      try {
        await db.put(TABLE, drawing, KEY);
      } catch (error) {
        // There is no room for this drawing. Delete the older one, so that the next visit does not restore it instead.
        await db.delete(TABLE, KEY);
        throw error;
      }
    },
  };
};
