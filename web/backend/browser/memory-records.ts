/** The records of a host that may not store anything: gone when its tab is closed. */
import type { Records, StoreName } from "./database.js";

export class MemoryRecords implements Records {
  readonly #drawings = new Map<string, unknown>();

  /** A new host begins with nothing, and keeps all but the drawings in its own memory. */
  read(): Promise<Map<string, unknown>> {
    return Promise.resolve(new Map());
  }

  readDrawing(id: string): Promise<unknown> {
    return Promise.resolve(this.#drawings.get(id));
  }

  drawingIds(): Promise<string[]> {
    return Promise.resolve([...this.#drawings.keys()]);
  }

  put(store: StoreName, key: string, value: unknown): void {
    if (store === "drawings") this.#drawings.set(key, value);
  }

  remove(store: StoreName, key: string): void {
    if (store === "drawings") this.#drawings.delete(key);
  }

  written(): Promise<void> {
    return Promise.resolve();
  }

  close(): Promise<void> {
    return Promise.resolve();
  }
}
