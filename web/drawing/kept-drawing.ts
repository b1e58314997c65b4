/** The last drawing, stored in the browser. In IndexedDB, which has room for large ones. */
import { z } from "zod";
import type { PageStore } from "../state/store.js";

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
  let kept = "";
  let isFaultKnown = false;
  store.subscribe(({ drawing, planned }) => {
    if (!drawing || planned?.drawingKey !== drawing.key) return;
    const { key, name, text, jobId, sourceId } = drawing;
    const now = JSON.stringify([key, jobId, sourceId]);
    if (now === kept) return;
    kept = now;
    storage.write({ name, text, jobId, sourceId }).catch(() => {
      if (!isFaultKnown) onFault();
      isFaultKnown = true;
    });
  });
};

const DATABASE = "plotwright";
const TABLE = "page";
const KEY = "drawing";

export const browserDrawings = (): DrawingStorage => {
  let opened: Promise<IDBDatabase> | null = null;
  const table = async (mode: IDBTransactionMode): Promise<IDBObjectStore> => {
    opened ??= openDatabase();
    return (await opened).transaction(TABLE, mode).objectStore(TABLE);
  };
  /** Resolves when the change is stored. Only the end of the transaction shows whether there was room. */
  const change = async (make: (table: IDBObjectStore) => void): Promise<void> => {
    const changed = await table("readwrite");
    return new Promise((resolve, reject) => {
      const { transaction } = changed;
      transaction.oncomplete = () => resolve();
      transaction.onabort = () => reject(transaction.error ?? new Error("The browser does not store data."));
      make(changed);
    });
  };
  return {
    read: async () => answerOf((await table("readonly")).get(KEY)),
    write: async (drawing) => {
      try {
        await change((drawings) => drawings.put(drawing, KEY));
      } catch (error) {
        // There is no room for this drawing. Delete the older one, so that the next visit does not restore it instead.
        await change((drawings) => drawings.delete(KEY));
        throw error;
      }
    },
  };
};

const openDatabase = (): Promise<IDBDatabase> => {
  const request = indexedDB.open(DATABASE, 1);
  request.onupgradeneeded = () => request.result.createObjectStore(TABLE);
  return answerOf(request);
};

const answerOf = <T>(request: IDBRequest<T>): Promise<T> =>
  new Promise((resolve, reject) => {
    request.onsuccess = () => resolve(request.result);
    request.onerror = () => reject(request.error ?? new Error("The browser does not store data."));
  });
