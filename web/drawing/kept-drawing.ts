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

/** Keeps each drawing once it has been planned: one that can't be read is nothing to come back to. */
export const keepDrawing = (store: PageStore, storage: DrawingStorage): (() => void) => {
  let kept = "";
  return store.subscribe(({ drawing, planned }) => {
    if (!drawing || planned?.drawingKey !== drawing.key) return;
    const { key, name, text, jobId, sourceId } = drawing;
    const now = JSON.stringify([key, jobId, sourceId]);
    if (now === kept) return;
    kept = now;
    void storage.write({ name, text, jobId, sourceId }).catch(() => undefined);
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
  return {
    read: async () => answerOf((await table("readonly")).get(KEY)),
    write: async (drawing) => {
      try {
        await answerOf((await table("readwrite")).put(drawing, KEY));
      } catch {
        // No room for this one: an older drawing must not come back in its place.
        await answerOf((await table("readwrite")).delete(KEY));
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
