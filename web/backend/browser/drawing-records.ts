/** The drawings of a browser's host, by id. */
import { PlotwrightError } from "../../../src/index.js";
import type { GrowingDrawing } from "../../../host/storage.js";
import type { DrawingText } from "../drawing-text.js";
import type { Records, StoreName } from "./database.js";
import { browserText } from "./text.js";

export const drawingRecords = (db: Pick<Records, "put" | "remove" | "readDrawing" | "written">) => ({
  add: async (drawing: DrawingText): Promise<string> => {
    const id = crypto.randomUUID();
    db.put("drawings", id, drawing);
    await db.written().catch((cause: unknown) => {
      // A large drawing must not prevent later, smaller changes from being stored.
      db.remove("drawings", id);
      throw new PlotwrightError("disk-full", browserText.notAdded(storageReason(cause)), { cause });
    });
    return id;
  },
  read: async (id: string): Promise<DrawingText> => {
    // A plot begins by reading its drawing. Waiting here ensures that the plot's new state is stored first. If it can't
    // be stored, the plot begins anyway, and a notice asks the user to keep the tab open.
    await db.written().catch(() => undefined);
    const drawing = await db.readDrawing(id).catch((cause: unknown) => {
      throw new PlotwrightError("bad-file", browserText.notRead(storageReason(cause)), { cause });
    });
    if (typeof drawing === "string" || drawing instanceof ArrayBuffer) return drawing;
    throw new PlotwrightError("bad-file", "The browser no longer has this drawing. Add it again.");
  },
  /** The database has no part of a record: all of it is written again, at intervals that grow with it. */
  grow: async (text: string): Promise<GrowingDrawing> => {
    const id = crypto.randomUUID();
    let whole = text;
    let writtenLength = 0;
    const put = (): void => {
      writtenLength = whole.length;
      db.put("drawings", id, whole);
    };
    put();
    await db.written();
    return {
      id,
      write: (from, more) => {
        whole = whole.slice(0, from) + more;
        if (whole.length < writtenLength || whole.length > 1.1 * writtenLength) put();
        return Promise.resolve();
      },
      close: () => {
        put();
        return db.written();
      },
    };
  },
  /** Does not wait until this is stored: the answer to the page does (`Host.written`). */
  remove: (id: string): Promise<void> => {
    db.remove("drawings", id);
    return Promise.resolve();
  },
});

/** Why the browser's storage failed, in words for the user. */
export const storageReason = (error: unknown): string => {
  if (error instanceof DOMException && error.name === "QuotaExceededError") return browserText.full;
  if (error instanceof DOMException && error.name === "InvalidStateError") return browserText.closedStorage;
  return browserText.storageSays(error instanceof Error ? error.message : String(error));
};

/** The records of a host in a browser that stores nothing. They are lost when the tab is closed. */
export class MemoryRecords implements Records {
  private readonly drawings = new Map<string, unknown>();

  /** Always empty: nothing is left from an earlier host, and this host has all records but drawings in memory anyway. */
  read(): Promise<Map<string, unknown>> {
    return Promise.resolve(new Map());
  }

  readDrawing(id: string): Promise<unknown> {
    return Promise.resolve(this.drawings.get(id));
  }

  drawingIds(): Promise<string[]> {
    return Promise.resolve([...this.drawings.keys()]);
  }

  put(store: StoreName, key: string, value: unknown): void {
    if (store === "drawings") this.drawings.set(key, value);
  }

  remove(store: StoreName, key: string): void {
    if (store === "drawings") this.drawings.delete(key);
  }

  written(): Promise<void> {
    return Promise.resolve();
  }

  close(): Promise<void> {
    return Promise.resolve();
  }
}
