/**
 * The storage interfaces of the queue and the plotters. The server implements them with SQLite and files
 * (server/storage/store.ts), the page without a server with IndexedDB (web/backend/browser/stored-model.ts).
 *
 * The methods are synchronous. On the server a method returns only after the change is on disk. In the browser it
 * returns at once, but answers and events are delayed until the change is stored.
 */
import type { Job } from "../src/schema/index.js";

export interface StoredDrawing {
  readonly id: string;
  readonly bytes: number;
}

/** A file of the watched folder. The same name with different content is a different file. */
export interface WatchedFile {
  readonly name: string;
  readonly sha256: string;
}

/** A plotter as stored; without a name, the name is derived from its device. */
export interface PlotterRow {
  readonly id: string;
  readonly name: string | null;
  readonly device: string;
  readonly machine: string | null;
}

/** JSON values by name. */
export interface SettingStore {
  /** A JSON value stored under a name, or undefined; parse it with its schema. */
  setting(key: string): unknown;
  saveSetting(key: string, value: unknown): void;
}

export interface JobStore extends SettingStore {
  /** Queue order first, then history, newest first. */
  jobs(): Job[];
  /** Ids in the order of jobs(). */
  order(): string[];
  /** The id of the job's drawing; throws `not-found`. */
  drawingOf(id: string): string;
  /** Stores everything `work` writes, or nothing. A nested call joins the outer transaction. */
  transaction(work: () => void): void;
  /** Adds a job before another job of the queue, or last. */
  addJob(job: Job, drawing: StoredDrawing, beforeId?: string | null): void;
  saveJob(job: Job): void;
  /**
   * Sets the expected time of a plotter's queued jobs to planned time × `ratio`. Returns the changed times by
   * job id.
   */
  saveExpected(plotterId: string, ratio: number): Record<string, number>;
  /** Moves a job before another job of the queue; null: to the end. Throws `not-found`. */
  moveJob(id: string, beforeId: string | null): void;
  /** Removes the job; returns its drawing's id if no other job uses it, else null. */
  removeJob(id: string): string | null;
  /** Stores how far a plot has got. */
  saveJournal(id: string, entry: unknown): void;
  journal(id: string): unknown;
  clearJournal(id: string): void;
  /** Only for jobs from a watched folder. */
  saveSeen(file: WatchedFile): void;
  /** Only for jobs from a shared queue. */
  saveShared(id: string, jobId: string): void;
}

export interface PlotterStore {
  /** Empty on the first start. */
  plotters(): PlotterRow[];
  /** Adds a new plotter last, or updates a stored one. */
  savePlotter(row: PlotterRow): void;
  removePlotter(id: string): void;
  /** The stored settings of each plotter, by its id; parse them with their schema. */
  plotterSettings(): Record<string, unknown>;
  savePlotterSettings(id: string, settings: unknown): void;
}

/** The drawing of a live job. */
export interface GrowingDrawing {
  readonly id: string;
  /** Replaces everything from a position on, in bytes. Not flushed to the disk: it survives a kill, not a power cut. */
  write(from: number, text: string): Promise<void>;
  /** Resolves when all of it is on the disk. */
  close(): Promise<void>;
}

/** Drawings are added before their job; the queue removes those that no job uses any more. */
export interface DrawingStore {
  /** Adds a drawing that will grow; `text` is ASCII. */
  grow(text: string): Promise<GrowingDrawing>;
  remove(id: string): Promise<void>;
}
