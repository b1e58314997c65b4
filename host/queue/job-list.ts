/**
 * The current state of all jobs, in memory and on disk. Every change is stored, then applied in memory, then announced.
 * So even if the process is killed, browsers have only seen changes that were stored.
 *
 * There are two exceptions:
 * - Progress is only in memory and is stored with the next change of state.
 * - A job that is on a plotter still changes when the disk is full. The change is announced with a message about the
 *   disk, and stored as soon as there is room.
 */
import { PlotwrightError } from "../../src/index.js";
import { ENDED_STATES, type HistoryRequest, type Job, type JobPage } from "../../src/schema/index.js";
import { DISK_FULL, isDiskFault } from "../disk-fault.js";
import { applyJobEvent, isOnPlotter, type JobEvent } from "./job-states.js";
import type { NewQueueJob, QueueParts } from "./queue-parts.js";
import type { StoredDrawing } from "../storage.js";

type ListParts = Pick<QueueParts, "store" | "announce" | "nowIso" | "withChange" | "afterChange">;

const RETRY_MS = 5_000;
/** Ended jobs in a snapshot, and in each further part of the history. */
const HISTORY_PAGE = 50;

/** The source of a new job, its place in the queue, and the number of jobs to add. */
interface Origin extends Pick<NewQueueJob, "watched" | "sharedId" | "copies"> {
  readonly beforeId?: string | null;
}

export class JobList {
  private readonly jobs = new Map<string, Job>();
  /** Jobs whose last change could not be stored, by id, each in its stored state. */
  private readonly unsaved = new Map<string, Job | null>();
  /** Read from the store when it is needed; null after a change. */
  private storedOrder: readonly string[] | null = null;
  private retry: ReturnType<typeof setTimeout> | null = null;

  constructor(private readonly parts: ListParts) {
    for (const job of parts.store.jobs()) this.jobs.set(job.id, job);
  }

  /** Queue order first, then history, newest first. */
  list(): Job[] {
    return this.order().map((id) => this.get(id));
  }

  order(): readonly string[] {
    this.storedOrder ??= this.parts.store.order();
    return this.storedOrder;
  }

  /** The whole queue, and the newest jobs of the history: of all, or of one submitter. */
  recent(submitterId?: string): JobPage {
    let endedCount = 0;
    const ids = this.orderFor(submitterId).filter((id) => !this.isEnded(id) || ++endedCount <= HISTORY_PAGE);
    return { jobs: ids.map((id) => this.get(id)), hasOlderJobs: endedCount > HISTORY_PAGE };
  }

  /** The next jobs of the history. Throws `not-found` if there is no job `after`. */
  older({ after, plotterId, name = "" }: HistoryRequest, submitterId?: string): JobPage {
    const order = this.orderFor(submitterId);
    const from = after === undefined ? 0 : order.indexOf(this.getFor(after, submitterId).id) + 1;
    const part = name.toLowerCase();
    const isWanted = (job: Job): boolean =>
      ENDED_STATES.includes(job.state) &&
      (plotterId ?? job.plotterId) === job.plotterId &&
      job.name.toLowerCase().includes(part);
    const older = order.slice(from).filter((id) => isWanted(this.get(id)));
    return {
      jobs: older.slice(0, HISTORY_PAGE).map((id) => this.get(id)),
      hasOlderJobs: older.length > HISTORY_PAGE,
    };
  }

  private orderFor(submitterId?: string): readonly string[] {
    const order = this.order();
    return submitterId === undefined
      ? order
      : order.filter((id) => this.get(id).submittedBy?.id === submitterId);
  }

  /** As `get`: to a submitter, the jobs of others do not exist. */
  getFor(id: string, submitterId?: string): Job {
    const job = this.jobs.get(id);
    const isHidden = submitterId !== undefined && job?.submittedBy?.id !== submitterId;
    if (job === undefined || isHidden) throw new PlotwrightError("not-found", `There is no job ${id}.`);
    return job;
  }

  private isEnded(id: string): boolean {
    return ENDED_STATES.includes(this.get(id).state);
  }

  has(id: string): boolean {
    return this.jobs.has(id);
  }

  /** Throws `not-found`. */
  get(id: string): Job {
    return this.getFor(id);
  }

  /**
   * Adds jobs and copies of them before another job of the queue, or last. All are stored in one transaction: many flushes
   * to the disk would delay the plotters, and a fault between them would leave only some of the jobs.
   */
  insert(
    wanted: readonly Job[],
    drawing: StoredDrawing,
    { beforeId = null, watched, sharedId, copies = 1 }: Origin = {},
  ): Job {
    const { store, announce } = this.parts;
    const jobs = [...wanted];
    while (jobs.length < copies * wanted.length) {
      jobs.push(...wanted.map((job) => ({ ...job, id: crypto.randomUUID() })));
    }
    const [first] = jobs;
    store.transaction(() => {
      for (const each of jobs) store.addJob(each, drawing, beforeId);
      if (watched !== undefined) store.saveSeen(watched);
      if (sharedId !== undefined) store.saveShared(sharedId, first.id);
    });
    this.storedOrder = null;
    for (const each of jobs) {
      this.jobs.set(each.id, each);
      announce({ type: "job", job: each });
    }
    this.announceOrder();
    return first;
  }

  /** Returns the job's drawing if no other job uses it, else null. */
  remove(id: string): string | null {
    const unused = this.parts.store.removeJob(id);
    this.storedOrder = null;
    this.jobs.delete(id);
    this.unsaved.delete(id);
    this.parts.announce({ type: "job-removed", id });
    return unused;
  }

  /** `more`: other fields to change in the same step. */
  apply(id: string, event: JobEvent, more: Partial<Job> = {}): Job {
    const before = this.get(id);
    const after = this.save({ ...applyJobEvent(before, event, this.parts.nowIso()), ...more });
    if (ENDED_STATES.includes(after.state) !== ENDED_STATES.includes(before.state)) this.announceOrder();
    return after;
  }

  save(job: Job): Job {
    const before = this.jobs.get(job.id);
    try {
      return this.write(job);
    } catch (error) {
      if (before && isOnPlotter(before) && isDiskFault(error)) return this.saveLater(job);
      throw error;
    }
  }

  /** Adds the message about the full disk to a job that is on a plotter, unless it has the message already. */
  diskIsFull(id: string): void {
    if (!this.unsaved.has(id)) this.saveLater(this.get(id));
  }

  /** Tries once more to store the unsaved jobs. */
  close(): void {
    this.saveUnsaved();
    if (this.retry !== null) clearTimeout(this.retry);
  }

  private write(job: Job): Job {
    const { store, announce, withChange, afterChange } = this.parts;
    const before = this.unsaved.get(job.id) ?? this.jobs.get(job.id) ?? null;
    store.transaction(() => {
      store.saveJob(job);
      withChange?.(before, job);
    });
    this.storedOrder = null;
    this.unsaved.delete(job.id);
    this.jobs.set(job.id, job);
    announce({ type: "job", job });
    afterChange?.();
    return job;
  }

  private saveLater(job: Job): Job {
    if (!this.unsaved.has(job.id)) this.unsaved.set(job.id, this.jobs.get(job.id) ?? null);
    const announced = { ...job, message: withDiskFull(job.message) };
    this.jobs.set(job.id, announced);
    this.parts.announce({ type: "job", job: announced });
    this.retry ??= setTimeout(() => this.saveUnsaved(), RETRY_MS);
    return announced;
  }

  private saveUnsaved(): void {
    this.retry = null;
    if (this.unsaved.size === 0) return;
    try {
      for (const id of [...this.unsaved.keys()]) {
        const job = this.get(id);
        this.write({ ...job, message: withoutDiskFull(job.message) });
      }
      this.announceOrder();
    } catch {
      this.retry = setTimeout(() => this.saveUnsaved(), RETRY_MS);
    }
  }

  /** Shows a message to the user. The message of a job that has ended stays as it is. */
  note(id: string, message: string): Job {
    const job = this.get(id);
    return ENDED_STATES.includes(job.state) ? job : this.save({ ...job, message });
  }

  /**
   * Updates the expected time of all jobs queued for a plotter. One statement and one event for all jobs keep this fast,
   * because other plotters may be plotting.
   */
  updateExpected(plotterId: string, ratio: number): void {
    const expectedS = this.parts.store.saveExpected(plotterId, ratio);
    const ids = Object.keys(expectedS);
    for (const id of ids) this.jobs.set(id, { ...this.get(id), expectedS: expectedS[id] ?? null });
    if (ids.length > 0) this.parts.announce({ type: "expected", expectedS });
  }

  /** Changes memory only, without storing or announcing. */
  progressed(id: string, progress: Pick<Job, "progress" | "elapsedS" | "remainingS">): void {
    this.jobs.set(id, { ...this.get(id), ...progress });
  }

  /** Call after the order was changed in the store. */
  announceOrder(): void {
    this.storedOrder = null;
    this.parts.announce({ type: "order", ids: this.recent().jobs.map(({ id }) => id) });
  }

  /** Throws `conflict` unless the job is queued. `what`: the part to change, as in "Its settings". */
  mustBeQueued(id: string, what: string): Job {
    const job = this.get(id);
    if (job.state === "queued") return job;
    throw new PlotwrightError(
      "conflict",
      `"${job.name}" is ${job.state}. ${what} can change only while it is queued.`,
    );
  }
}

const withDiskFull = (message: string | null): string =>
  [withoutDiskFull(message), DISK_FULL].filter(Boolean).join(" ");

const withoutDiskFull = (message: string | null): string | null =>
  message?.replace(DISK_FULL, "").trim() || null;
