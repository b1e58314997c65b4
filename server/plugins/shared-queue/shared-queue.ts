/**
 * One server's side of the shared queue. When one of its plotters is idle, it takes the next job for that
 * plotter (by name or by machine) into its own queue. From then on it is a job like any other: stored,
 * interrupted and recovered on the server that took it. This server's queue also stores the shared job's id, so
 * that a job taken just before a crash is added only once.
 */
import { z } from "zod";
import { PlotwrightError, type ErrorCode } from "../../../src/index.js";
import {
  nameSchema,
  givenSettingsSchema,
  SERVER_LOST_AFTER_MS,
  type GivenSettings,
  type SharedJob,
  type SharedTarget,
} from "../../../src/schema/index.js";
import type { PlotterPort } from "../../../host/plotter/plotter-port.js";
import type { DrawingFiles } from "../../storage/drawing-files.js";
import type { JobQueue } from "../../../host/queue/job-queue.js";
import type { Store } from "../../storage/store.js";
import { isDiskFault } from "../../../host/disk-fault.js";
import type { SharedStore, TakenJob } from "./shared-store.js";

interface SharedParts {
  readonly shared: SharedStore;
  /** Stored in the data folder, so that the server finds the jobs it took before a restart. */
  readonly serverId: string;
  /** Shown to users. */
  readonly serverName: string;
  readonly store: Pick<Store, "isShared" | "unreportedShared" | "saveReported" | "forgetShared">;
  readonly queue: JobQueue;
  readonly files: DrawingFiles;
  readonly plotters: ReadonlyMap<string, PlotterPort>;
  readonly log: (line: string) => void;
  readonly notice: (message: string) => void;
  /** Default 2 s. */
  readonly pollMs?: number | undefined;
  /** Time without a sign of life after which a server counts as lost; default SERVER_LOST_AFTER_MS. */
  readonly lostAfterMs?: number | undefined;
}

const POLL_MS = 2_000;
/** What other servers get: always with the drawing's text. */
const payloadSchema = z.object({
  name: nameSchema(200),
  drawing: z.string().min(1),
  settings: givenSettingsSchema.default({}),
});

interface SentJob {
  readonly name: string;
  /** The drawing's text. */
  readonly drawing: string;
  readonly settings?: GivenSettings | undefined;
  readonly target: SharedTarget;
}

export class SharedQueue {
  private timer: NodeJS.Timeout | null = null;
  private running: Promise<void>;
  private isClosed = false;
  /** All jobs this server took before a restart or failure are in its queue. */
  private isCaughtUp = false;
  /** Jobs taken but not yet started, also before a restart, by their ids in this server's queue. */
  private readonly unstarted: Set<string>;
  /** Jobs put back for other servers that were already reported. */
  private readonly reportedBack = new Set<string>();
  /** Jobs on lost servers that were already reported. */
  private readonly reportedLost = new Set<string>();
  /** Plotters without a machine that were already reported. */
  private readonly reportedNoMachine = new Set<string>();
  private lastFault: string | null = null;

  constructor(private readonly parts: SharedParts) {
    this.unstarted = new Set(parts.store.unreportedShared().map(({ jobId }) => jobId));
    this.running = this.round();
  }

  async send({ name, drawing, settings = {}, target }: SentJob): Promise<string> {
    return this.parts.shared.send(name, targetText(target), JSON.stringify({ name, drawing, settings }));
  }

  list(): Promise<SharedJob[]> {
    return this.parts.shared.list();
  }

  withdraw(id: string): Promise<void> {
    return this.parts.shared.withdraw(id);
  }

  /** Puts a job back in the shared queue if a lost server took it but did not start it. Throws `conflict`. */
  giveBack(id: string): Promise<void> {
    return this.parts.shared.giveBack(id, this.lostAfterMs);
  }

  /**
   * Call before a job starts. Returns null if it may start (the database then marks it as begun), otherwise the reason
   * why it must not.
   */
  async claim(jobId: string): Promise<string | null> {
    const { shared, store, serverId, queue, log } = this.parts;
    const known = store.unreportedShared().find((one) => one.jobId === jobId);
    if (known === undefined) return null;
    const { name } = queue.get(jobId);
    try {
      if (await shared.claim(known.id, serverId)) return null;
      return await this.leave(known);
    } catch (error) {
      log(`shared queue: "${name}" can't start: ${wordsOf(error)}`);
      return `The database of the shared queue can't be reached, so another server may have been given "${name}". Start it when the database is back. Or duplicate it: a duplicate can start at any time.`;
    }
  }

  async release(jobId: string): Promise<void> {
    const { shared, store, serverId, log } = this.parts;
    const known = store.unreportedShared().find((one) => one.jobId === jobId);
    if (known === undefined) return;
    await shared.release(known.id, serverId).catch((error: unknown) => log(`shared queue: ${String(error)}`));
  }

  private get lostAfterMs(): number {
    return this.parts.lostAfterMs ?? SERVER_LOST_AFTER_MS;
  }

  /** Looks for work at once, unless it already does. Call it when a plotter may have become free. */
  wake(): void {
    if (this.timer === null || this.isClosed) return;
    clearTimeout(this.timer);
    this.timer = null;
    this.running = this.round();
  }

  async close(): Promise<void> {
    this.isClosed = true;
    if (this.timer !== null) clearTimeout(this.timer);
    await this.running;
    await this.parts.shared.close();
  }

  /** One round of polling. Never rejects: without the database a server continues with its own queue. */
  private async round(): Promise<void> {
    const { shared, serverId, log } = this.parts;
    try {
      await shared.seen(serverId);
      if (!this.isCaughtUp) {
        await this.dropLost();
        for (const job of await shared.unfinished(serverId)) await this.bringIn(job);
        this.isCaughtUp = true;
      }
      await this.reportBegun();
      await this.startTaken();
      await this.reportLost();
      for (const plotter of this.parts.plotters.values()) await this.feed(plotter);
      if (this.lastFault !== null) log("shared queue: working again");
      this.lastFault = null;
    } catch (error) {
      this.isCaughtUp = false;
      const fault = wordsOf(error);
      if (fault !== this.lastFault) log(`shared queue: ${fault}`);
      this.lastFault = fault;
    }
    if (this.isClosed) return;
    this.timer = setTimeout(() => this.wake(), this.parts.pollMs ?? POLL_MS);
    this.timer.unref();
  }

  /** Drops queued jobs that were given to other servers while this one was away. */
  private async dropLost(): Promise<void> {
    const { shared, store, serverId, queue } = this.parts;
    for (const known of store.unreportedShared()) {
      const job = queue.list().find((one) => one.id === known.jobId);
      if (job?.state === "queued" && !(await shared.isStill(known.id, serverId))) await this.leave(known);
    }
  }

  /**
   * Removes a job that now belongs to another server from this server's queue; returns the message for the user.
   * The message is stored before the job is removed: after a crash between the two it is shown twice rather than
   * never.
   */
  private async leave({ id, jobId }: { readonly id: string; readonly jobId: string }): Promise<string> {
    const { store, queue, log, notice } = this.parts;
    const message = `"${queue.get(jobId).name}" was given to another server while this one was away.`;
    log(`shared queue: ${message}`);
    notice(message);
    await queue.remove(jobId);
    store.forgetShared(id);
    return message;
  }

  /** Marks jobs that have begun here in the database, so that they can't be given to other servers. */
  private async reportBegun(): Promise<void> {
    const { shared, store, serverId, queue, notice } = this.parts;
    for (const { id, jobId } of store.unreportedShared()) {
      const job = queue.list().find((one) => one.id === jobId);
      if (job?.state === "queued") continue;
      const isOurs = await shared.begun(id, serverId);
      store.saveReported(id);
      if (isOurs || job === undefined) continue;
      notice(`"${job.name}" was given to another server while this one was away, and may be plotted twice.`);
    }
  }

  /** Notifies once per job on a lost server: the user has to decide whether it should wait. */
  private async reportLost(): Promise<void> {
    const { shared, notice } = this.parts;
    for (const { id, name, server } of await shared.lost(this.lostAfterMs)) {
      if (this.reportedLost.has(id)) continue;
      this.reportedLost.add(id);
      notice(
        `"${name}" was taken by ${server}, which can't be reached. It waits there until that server is back. To give it to another server, open Sharing, Servers.`,
      );
    }
  }

  /**
   * Starts taken jobs if the plotter's queue runs automatically. Each round tries again: the board may have been missing.
   */
  private async startTaken(): Promise<void> {
    const { queue } = this.parts;
    for (const id of this.unstarted) {
      const job = queue.list().find((one) => one.id === id);
      if (job?.state !== "queued") this.unstarted.delete(id);
      else if (queue.startsByItself(job)) await startIfFree(queue, id);
    }
  }

  /**
   * Takes a job for a plotter that is connected and idle. On any other plotter the job would wait, although
   * another server's plotter may be free.
   */
  private async feed(plotter: PlotterPort): Promise<void> {
    const { shared, serverId, serverName, queue, log } = this.parts;
    const { name, machine, connection } = plotter.snapshot();
    if (this.isClosed || connection !== "idle" || queue.liveJobCount(plotter.id) > 0) return;
    if (machine === null && !this.reportedNoMachine.has(plotter.id)) {
      this.reportedNoMachine.add(plotter.id);
      log(`shared queue: ${name} takes only jobs sent to ${name} by name, because its machine is not set`);
    }
    const targets: SharedTarget[] = [{ plotter: name }, ...(machine === null ? [] : [{ machine }])];
    for (const target of targets) {
      const taker = { serverId, server: serverName, plotterId: plotter.id };
      const job = await shared.take(targetText(target), taker);
      if (job === null) continue;
      await this.bringIn(job);
      return;
    }
  }

  private async bringIn({ id, plotterId, payload }: TakenJob): Promise<void> {
    const { shared, store, queue, files, log, notice } = this.parts;
    if (store.isShared(id)) {
      await shared.finish(id, "stored", null);
      return;
    }
    try {
      const { name, drawing, settings } = payloadOf(payload);
      const stored = await files.add([Buffer.from(drawing, "utf8")]);
      const job = await queue.add({ name, settings, drawing: stored, sharedId: id, plotterId });
      log(`shared queue: took "${name}" as ${job.id}`);
      await shared.finish(id, "stored", null);
      this.unstarted.add(job.id);
      await this.startTaken();
    } catch (error) {
      if (store.isShared(id)) throw error;
      const reason = isDiskFault(error) ? "The disk is full or can't be written to." : wordsOf(error);
      if (!isDrawingFault(error)) return this.putBack(id, reason);
      const message = `A job of the shared queue can't be plotted: ${reason}`;
      log(message);
      notice(message);
      await shared.finish(id, "refused", reason);
    }
  }

  /** Another server may have more memory, for example. Notifies once per job, since this server may get it again. */
  private async putBack(id: string, reason: string): Promise<void> {
    const { shared, serverId, log, notice } = this.parts;
    await shared.putBack(id, serverId);
    if (this.reportedBack.has(id)) return;
    this.reportedBack.add(id);
    const message = `A job of the shared queue was put back, because it can't be plotted here now: ${reason}`;
    log(message);
    notice(message);
  }
}

const wordsOf = (error: unknown): string => (error instanceof Error ? error.message : String(error));

/** Throws `bad-setting`. */
function payloadOf(text: string): z.infer<typeof payloadSchema> {
  try {
    return payloadSchema.parse(JSON.parse(text));
  } catch (cause) {
    throw new PlotwrightError("bad-setting", "It was sent by another version of plotwright.", { cause });
  }
}

const targetText = (target: SharedTarget): string =>
  "plotter" in target ? `plotter ${target.plotter.toLowerCase()}` : `machine ${target.machine}`;

/** Ignores refusals: meanwhile the job may have been started, or the plotter may have got another job. */
async function startIfFree(queue: JobQueue, id: string): Promise<void> {
  try {
    await queue.start(id);
  } catch (error) {
    if (!(error instanceof PlotwrightError)) throw error;
  }
}

/** `too-large` is missing: it depends on what else uses this computer's memory now. */
const DRAWING_FAULTS: readonly ErrorCode[] = ["bad-file", "bad-setting", "out-of-bounds"];

/** Whether the drawing or its settings are at fault, so that plotting it would fail again, on any server. */
const isDrawingFault = (error: unknown): boolean =>
  error instanceof PlotwrightError && DRAWING_FAULTS.includes(error.code);
