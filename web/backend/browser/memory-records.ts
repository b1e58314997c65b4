/** The records of a host in a browser that stores nothing. They are lost when the tab is closed. */
import type { Records, StoreName } from "./database.js";

export class MemoryRecords implements Records {
  readonly #drawings = new Map<string, unknown>();

  /** Always empty: nothing is left from an earlier host, and this host has all records but drawings in memory anyway. */
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
