/**
 * IndexedDB with delayed writes: a change is queued at once, and all changes of one turn of the event loop go into one
 * transaction. `written` resolves when everything queued so far is stored.
 *
 * Durability is strict, except for transactions that change only journals. As on the server, journals survive a crash
 * of the browser but not of the computer, and the stream to the board never waits for the disk.
 */
import { openDB, type IDBPDatabase } from "idb";

/** One store for each kind of record. Keys are ids. Values are plain JSON, except drawings, which are text or bytes. */
const STORES = ["jobs", "plotters", "settings", "journals", "machines", "drawings"] as const;
export type StoreName = (typeof STORES)[number];

const VERSION = 1;
const RETRY_MS = 5_000;

interface Change {
  readonly store: StoreName;
  readonly key: string;
  /** Undefined: the record is removed. */
  readonly value: unknown;
}

/** Where the host keeps its records: `Database`, or memory if the browser stores nothing. */
export interface Records {
  /** All records of a store, by key. */
  read(store: Exclude<StoreName, "drawings">): Promise<Map<string, unknown>>;
  readDrawing(id: string): Promise<unknown>;
  drawingIds(): Promise<string[]>;
  put(store: StoreName, key: string, value: unknown): void;
  remove(store: StoreName, key: string): void;
  /** Resolves when all changes so far are stored; rejects if that failed. */
  written(): Promise<void>;
  close(): Promise<void>;
}

export interface DatabaseEvents {
  /** Called for each transaction that failed; its changes are tried again. */
  onFault(error: unknown): void;
  /** Called for each transaction that is stored. */
  onWritten(): void;
  /** Called after the user cleared the site's data: all records but the drawings are stored again. */
  onCleared(): void;
}

export class Database implements Records {
  private db!: IDBPDatabase;
  /** The latest of each record but the drawings, by store and key, to be stored again if the user clears the site's data. */
  private readonly known = new Map<string, Change>();
  /** Changes that no transaction has taken yet, by store and key. */
  private queued = new Map<string, Change>();
  private running: Promise<void> = Promise.resolve();
  /** The transaction after the running one. When it begins, it takes all queued changes. */
  private next: Promise<void> | null = null;
  private last: Promise<void> = Promise.resolve();

  private constructor(
    private readonly name: string,
    private readonly events: DatabaseEvents,
  ) {}

  /** Rejects if the browser stores nothing for this site, as some do in private windows. */
  static async open(name: string, events: DatabaseEvents): Promise<Database> {
    const database = new Database(name, events);
    await database.connect();
    return database;
  }

  private async connect(): Promise<void> {
    this.db = await openDB(this.name, VERSION, {
      upgrade: (db) => {
        for (const store of STORES) {
          if (!db.objectStoreNames.contains(store)) db.createObjectStore(store);
        }
      },
      // Not called for `close`: only if the browser closes it, when the user clears the site's data.
      terminated: () => void this.connectAgain(),
    });
  }

  private async connectAgain(): Promise<void> {
    try {
      await this.connect();
    } catch (error) {
      this.events.onFault(error);
      setTimeout(() => void this.connectAgain(), RETRY_MS);
      return;
    }
    for (const change of this.known.values()) this.change(change);
    this.events.onCleared();
  }

  async read(store: Exclude<StoreName, "drawings">): Promise<Map<string, unknown>> {
    const found = this.db.transaction(store).store;
    const [keys, values] = await Promise.all([found.getAllKeys(), found.getAll() as Promise<unknown[]>]);
    const records = new Map(keys.map((key, index) => [String(key), values[index]]));
    for (const [key, value] of records) this.remember({ store, key, value });
    return records;
  }

  async readDrawing(id: string): Promise<unknown> {
    return this.db.get("drawings", id);
  }

  async drawingIds(): Promise<string[]> {
    return (await this.db.getAllKeys("drawings")).map(String);
  }

  put(store: StoreName, key: string, value: unknown): void {
    this.change({ store, key, value });
  }

  remove(store: StoreName, key: string): void {
    this.change({ store, key, value: undefined });
  }

  written(): Promise<void> {
    return this.last;
  }

  async close(): Promise<void> {
    await this.written().catch(() => undefined);
    this.db.close();
  }

  private remember(change: Change): void {
    if (change.store === "drawings") return;
    const id = `${change.store}/${change.key}`;
    if (change.value === undefined) this.known.delete(id);
    else this.known.set(id, change);
  }

  private change(change: Change): void {
    this.remember(change);
    this.queued.set(`${change.store}/${change.key}`, change);
    this.last = this.nextWrite();
    // Not an unhandled rejection: `events` and every caller of `written` get the error.
    this.last.catch(() => undefined);
  }

  private nextWrite(): Promise<void> {
    this.next ??= this.running
      .catch(() => undefined)
      .then(() => {
        this.next = null;
        this.running = this.write();
        return this.running;
      });
    return this.next;
  }

  private async write(): Promise<void> {
    const changes = this.queued;
    this.queued = new Map();
    if (changes.size === 0) return;
    try {
      await this.transact([...changes.values()]);
      this.events.onWritten();
    } catch (error) {
      // Newer changes of the same records win.
      this.queued = new Map([...changes, ...this.queued]);
      setTimeout(() => void this.nextWrite().catch(() => undefined), RETRY_MS);
      this.events.onFault(error);
      throw error;
    }
  }

  private async transact(changes: readonly Change[]): Promise<void> {
    const isJournal = changes.every(({ store }) => store === "journals");
    const transaction = this.db.transaction(STORES, "readwrite", {
      durability: isJournal ? "relaxed" : "strict",
    });
    const requests = changes.map(({ store, key, value }): Promise<unknown> => {
      const records = transaction.objectStore(store);
      return value === undefined ? records.delete(key) : records.put(value, key);
    });
    // Otherwise the commit waits for the results of all requests, and is lost if the tab dies meanwhile.
    transaction.commit();
    await Promise.all([...requests, transaction.done]);
  }
}
