/**
 * Jobs, plotters, settings and journals in memory. Each change is queued for IndexedDB. The changes of `together` are
 * made in one turn of the event loop, so they are stored in one transaction.
 */
import { PlotwrightError } from "../../../src/index.js";
import { ENDED_STATES, jobSchema, type Job } from "../../../src/schema/index.js";
import type { JobStore, PlotterRow, PlotterStore, StoredDrawing } from "../../../host/storage.js";
import type { Database } from "./database.js";

interface JobRow {
  readonly job: Job;
  readonly drawing: string;
  readonly position: number;
}

interface StoredPlotter extends PlotterRow {
  readonly position: number;
  readonly settings?: unknown;
}

type Changes = Pick<Database, "put" | "remove">;

/** The records read from IndexedDB, by key. */
interface StoredRecords {
  readonly jobs: ReadonlyMap<string, unknown>;
  readonly plotters: ReadonlyMap<string, unknown>;
  readonly settings: ReadonlyMap<string, unknown>;
  readonly journals: ReadonlyMap<string, unknown>;
}

export class StoredModel implements JobStore, PlotterStore {
  private readonly jobRows = new Map<string, JobRow>();
  private readonly plotterRows = new Map<string, StoredPlotter>();
  private readonly settings: Map<string, unknown>;
  private readonly journals: Map<string, unknown>;
  /** How many stored jobs can't be read. They stay in the database. */
  readonly unreadableCount: number;

  constructor(
    private readonly db: Changes,
    records: StoredRecords,
  ) {
    let unreadableCount = 0;
    for (const [id, stored] of records.jobs) {
      const row = stored as JobRow;
      const parsed = jobSchema.safeParse(row.job);
      if (parsed.success) this.jobRows.set(id, { ...row, job: parsed.data });
      else unreadableCount++;
    }
    this.unreadableCount = unreadableCount;
    for (const [id, row] of records.plotters) this.plotterRows.set(id, row as StoredPlotter);
    this.settings = new Map(records.settings);
    this.journals = new Map(records.journals);
  }

  jobs(): Job[] {
    return this.ordered().map(({ job }) => job);
  }

  order(): string[] {
    return this.ordered().map(({ job }) => job.id);
  }

  drawingOf(id: string): string {
    return this.row(id).drawing;
  }

  isUsed(drawing: string): boolean {
    return [...this.jobRows.values()].some((row) => row.drawing === drawing);
  }

  /** Nothing here throws after its first change, so there is nothing to undo. */
  transaction(work: () => void): void {
    work();
  }

  addJob(job: Job, drawing: StoredDrawing, beforeId: string | null = null): void {
    this.save({ job, drawing: drawing.id, position: this.lastPosition() + 1 });
    if (beforeId !== null) this.moveJob(job.id, beforeId);
  }

  saveJob(job: Job): void {
    this.save({ ...this.row(job.id), job });
  }

  saveExpected(plotterId: string, ratio: number): Record<string, number> {
    const changed: Record<string, number> = {};
    for (const row of this.jobRows.values()) {
      const { job } = row;
      if (job.plotterId !== plotterId || job.state !== "queued" || job.stats === null) continue;
      const expectedS = job.stats.durationS * ratio;
      if (job.expectedS === expectedS) continue;
      this.save({ ...row, job: { ...job, expectedS } });
      changed[job.id] = expectedS;
    }
    return changed;
  }

  moveJob(id: string, beforeId: string | null): void {
    const row = this.row(id);
    if (beforeId === null) {
      this.save({ ...row, position: this.lastPosition() + 1 });
      return;
    }
    const target = this.jobRows.get(beforeId);
    if (target === undefined || beforeId === id || isEnded(target.job)) {
      throw new PlotwrightError("not-found", `There is no job ${beforeId} in the queue.`);
    }
    const { position } = target;
    for (const other of this.jobRows.values()) {
      if (other.position >= position) this.save({ ...other, position: other.position + 1 });
    }
    this.save({ ...row, position });
  }

  removeJob(id: string): string | null {
    const { drawing } = this.row(id);
    this.jobRows.delete(id);
    this.db.remove("jobs", id);
    this.clearJournal(id);
    return this.isUsed(drawing) ? null : drawing;
  }

  saveJournal(id: string, entry: unknown): void {
    this.journals.set(id, entry);
    this.db.put("journals", id, entry);
  }

  journal(id: string): unknown {
    return this.journals.get(id);
  }

  clearJournal(id: string): void {
    if (this.journals.delete(id)) this.db.remove("journals", id);
  }

  setting(key: string): unknown {
    return this.settings.get(key);
  }

  saveSetting(key: string, value: unknown): void {
    this.settings.set(key, value);
    this.db.put("settings", key, value);
  }

  plotters(): PlotterRow[] {
    return [...this.plotterRows.values()]
      .sort((a, b) => a.position - b.position)
      .map(({ id, name, device, machine }) => ({ id, name, device, machine }));
  }

  savePlotter(row: PlotterRow): void {
    const before = this.plotterRows.get(row.id);
    const positions = [...this.plotterRows.values()].map(({ position }) => position);
    this.writePlotter({ position: Math.max(0, ...positions) + 1, ...before, ...row });
  }

  removePlotter(id: string): void {
    this.plotterRows.delete(id);
    this.db.remove("plotters", id);
  }

  plotterSettings(): Record<string, unknown> {
    const rows = [...this.plotterRows.values()].filter(({ settings }) => settings !== undefined);
    return Object.fromEntries(rows.map(({ id, settings }) => [id, settings]));
  }

  savePlotterSettings(id: string, settings: unknown): void {
    const row = this.plotterRows.get(id);
    if (row !== undefined) this.writePlotter({ ...row, settings });
  }

  saveSeen(): void {
    throw new Error("A page has no watched folder.");
  }

  saveShared(): void {
    throw new Error("A page has no shared queue.");
  }

  private ordered(): JobRow[] {
    const rows = [...this.jobRows.values()];
    const waiting = rows.filter(({ job }) => !isEnded(job)).sort((a, b) => a.position - b.position);
    const ended = rows
      .filter(({ job }) => isEnded(job))
      .sort((a, b) => compare(b.job.endedAt ?? "", a.job.endedAt ?? "") || b.position - a.position);
    return [...waiting, ...ended];
  }

  private lastPosition(): number {
    return Math.max(0, ...[...this.jobRows.values()].map(({ position }) => position));
  }

  private row(id: string): JobRow {
    const row = this.jobRows.get(id);
    if (row === undefined) throw new PlotwrightError("not-found", `There is no job ${id}.`);
    return row;
  }

  private save(row: JobRow): void {
    this.jobRows.set(row.job.id, row);
    this.db.put("jobs", row.job.id, row);
  }

  private writePlotter(row: StoredPlotter): void {
    this.plotterRows.set(row.id, row);
    this.db.put("plotters", row.id, row);
  }
}

const isEnded = ({ state }: Job): boolean => ENDED_STATES.includes(state);
const compare = (a: string, b: string): number => (a < b ? -1 : a > b ? 1 : 0);
