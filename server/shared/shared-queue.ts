/**
 * One server's part in the shared queue: when a plotter of its has nothing to do, takes the next job that is meant
 * for that plotter (by name, or by machine) into its own queue. From there it is a job like any other: durable,
 * interrupted and recovered where it was taken. The own queue knows a shared job's id, so that one which was
 * taken just before a crash comes in once.
 */
import { PlotwrightError } from "../../src/index.js";
import {
  newSharedJobSchema,
  SERVER_LOST_AFTER_MS,
  type NewSharedJob,
  type SharedJob,
  type SharedTarget,
} from "../../src/schema/index.js";
import type { PlotterPort } from "../queue/plotter-port.js";
import type { DrawingFiles } from "../queue/drawing-files.js";
import type { JobQueue } from "../queue/job-queue.js";
import type { Claims } from "../queue/queue-parts.js";
import type { Store } from "../queue/store.js";
import type { SharedStore, TakenJob } from "./shared-store.js";

export interface SharedParts {
  readonly shared: SharedStore;
  /** Kept with the data folder: it finds what it had taken again. */
  readonly serverId: string;
  /** For people. */
  readonly serverName: string;
  readonly store: Pick<Store, "isShared" | "untoldShared" | "saveTold" | "forgetShared">;
  readonly queue: JobQueue;
  readonly files: DrawingFiles;
  readonly plotters: ReadonlyMap<string, PlotterPort>;
  readonly log: (line: string) => void;
  readonly notice: (message: string) => void;
  /** 2 s unless told. */
  readonly pollMs?: number;
  /** A server that was not heard of for so long counts as gone; SERVER_LOST_AFTER_MS unless told. */
  readonly lostAfterMs?: number;
}

const POLL_MS = 2_000;
const payloadSchema = newSharedJobSchema.omit({ target: true });

export class SharedQueue {
  readonly #parts: SharedParts;
  #timer: NodeJS.Timeout | null = null;
  #running: Promise<void>;
  #isClosed = false;
  /** What this server had taken is in its queue. */
  #isCaughtUp = false;
  /** Taken, but not begun as yet. */
  readonly #unstarted = new Set<string>();
  /** Jobs on servers that have gone, of which has been told. */
  readonly #toldOf = new Set<string>();
  /** Plotters of no known model, of which has been told. */
  readonly #toldNameless = new Set<string>();
  #lastTrouble: string | null = null;

  constructor(parts: SharedParts) {
    this.#parts = parts;
    this.#running = this.#round();
  }

  async send({ name, drawing, settings, target }: NewSharedJob): Promise<string> {
    return this.#parts.shared.send(name, targetText(target), JSON.stringify({ name, drawing, settings }));
  }

  list(): Promise<SharedJob[]> {
    return this.#parts.shared.list();
  }

  withdraw(id: string): Promise<void> {
    return this.#parts.shared.withdraw(id);
  }

  /** What a server took that has gone since, and has not begun there, waits again. Throws `conflict`. */
  giveBack(id: string): Promise<void> {
    return this.#parts.shared.giveBack(id, this.#lostAfterMs);
  }

  /** Before a job of this queue begins: why it must not, or null. Others learn of it in the same step. */
  async claim(jobId: string): Promise<string | null> {
    const { shared, store, serverId, queue, log } = this.#parts;
    const known = store.untoldShared().find((one) => one.jobId === jobId);
    if (known === undefined) return null;
    const { name } = queue.get(jobId);
    try {
      if (await shared.claim(known.id, serverId)) return null;
      return await this.#leave(known);
    } catch (error) {
      log(
        `shared queue: "${name}" does not begin: ${error instanceof Error ? error.message : String(error)}`,
      );
      return `The queue that the servers share can't be reached, so another one may have been given "${name}". It can begin when the database is back; a duplicate of it begins at any time.`;
    }
  }

  async release(jobId: string): Promise<void> {
    const { shared, store, serverId, log } = this.#parts;
    const known = store.untoldShared().find((one) => one.jobId === jobId);
    if (known === undefined) return;
    await shared.release(known.id, serverId).catch((error: unknown) => log(`shared queue: ${String(error)}`));
  }

  get #lostAfterMs(): number {
    return this.#parts.lostAfterMs ?? SERVER_LOST_AFTER_MS;
  }

  /** Looks for work at once, unless it does already: to be called when a plotter may have become free. */
  wake(): void {
    if (this.#timer === null || this.#isClosed) return;
    clearTimeout(this.#timer);
    this.#timer = null;
    this.#running = this.#round();
  }

  async close(): Promise<void> {
    this.#isClosed = true;
    if (this.#timer !== null) clearTimeout(this.#timer);
    await this.#running;
    await this.#parts.shared.close();
  }

  /** Never rejects: without its database a server goes on with its own queue. */
  async #round(): Promise<void> {
    const { shared, serverId, log } = this.#parts;
    try {
      await shared.seen(serverId);
      if (!this.#isCaughtUp) {
        await this.#letGo();
        for (const job of await shared.unfinished(serverId)) await this.#bringIn(job);
        this.#isCaughtUp = true;
      }
      await this.#tellBegun();
      await this.#startThem();
      await this.#tellLost();
      for (const plotter of this.#parts.plotters.values()) await this.#feed(plotter);
      if (this.#lastTrouble !== null) log("shared queue: it works again");
      this.#lastTrouble = null;
    } catch (error) {
      this.#isCaughtUp = false;
      const trouble = error instanceof Error ? error.message : String(error);
      if (trouble !== this.#lastTrouble) log(`shared queue: ${trouble}`);
      this.#lastTrouble = trouble;
    }
    if (this.#isClosed) return;
    this.#timer = setTimeout(() => this.wake(), this.#parts.pollMs ?? POLL_MS);
    this.#timer.unref();
  }

  /** While this server was away, others may have been given what it had taken. */
  async #letGo(): Promise<void> {
    const { shared, store, serverId, queue } = this.#parts;
    for (const known of store.untoldShared()) {
      const job = queue.list().find((one) => one.id === known.jobId);
      if (job?.state === "queued" && !(await shared.isStill(known.id, serverId))) await this.#leave(known);
    }
  }

  /**
   * Takes what is another server's out of the own queue; returns what was said of it. It is said first: whoever sees
   * that the job is gone finds out why, and after a crash between the two it is said again rather than never.
   */
  async #leave({ id, jobId }: { readonly id: string; readonly jobId: string }): Promise<string> {
    const { store, queue, log, notice } = this.#parts;
    const message = `"${queue.get(jobId).name}" was given to another server while this one was away.`;
    log(`shared queue: ${message}`);
    notice(message);
    await queue.remove(jobId);
    store.forgetShared(id);
    return message;
  }

  /** What has begun here is nobody else's any more. */
  async #tellBegun(): Promise<void> {
    const { shared, store, serverId, queue, notice } = this.#parts;
    for (const { id, jobId } of store.untoldShared()) {
      const job = queue.list().find((one) => one.id === jobId);
      if (job?.state === "queued") continue;
      const isOurs = await shared.begun(id, serverId);
      store.saveTold(id);
      if (isOurs || job === undefined) continue;
      notice(`"${job.name}" was given to another server while this one was away, and may be drawn twice.`);
    }
  }

  /** Once for each job: somebody has to say whether it shall wait. */
  async #tellLost(): Promise<void> {
    const { shared, notice } = this.#parts;
    for (const { id, name, server } of await shared.lost(this.#lostAfterMs)) {
      if (this.#toldOf.has(id)) continue;
      this.#toldOf.add(id);
      notice(
        `"${name}" is with ${server}, which has gone. It waits there until that server is back; to let another one have it: Studio, Servers.`,
      );
    }
  }

  /** Where the queue runs on; again and again, since a plotter may have lost its board just now. */
  async #startThem(): Promise<void> {
    const { queue } = this.#parts;
    for (const id of this.#unstarted) {
      const job = queue.list().find((one) => one.id === id);
      if (job?.state !== "queued") this.#unstarted.delete(id);
      else if (queue.settings(job.plotterId).runOn) await startIfFree(queue, id);
    }
  }

  /** Only a plotter that is there and has nothing to do takes work, or it would keep it from one that is free. */
  async #feed(plotter: PlotterPort): Promise<void> {
    const { shared, serverId, serverName, queue, log } = this.#parts;
    const { name, machine, connection } = plotter.snapshot();
    if (this.#isClosed || connection !== "idle" || queue.liveJobCount(plotter.id) > 0) return;
    if (machine === null && !this.#toldNameless.has(plotter.id)) {
      this.#toldNameless.add(plotter.id);
      log(`shared queue: ${name} takes only jobs for ${name} itself: nobody has said what model it is`);
    }
    const targets: SharedTarget[] = [{ plotter: name }, ...(machine === null ? [] : [{ machine }])];
    for (const target of targets) {
      const taker = { serverId, server: serverName, plotterId: plotter.id };
      const job = await shared.take(targetText(target), taker);
      if (job === null) continue;
      await this.#bringIn(job);
      return;
    }
  }

  async #bringIn({ id, plotterId, payload }: TakenJob): Promise<void> {
    const { shared, store, queue, files, log, notice } = this.#parts;
    if (store.isShared(id)) {
      await shared.finish(id, "stored", null);
      return;
    }
    const parsed = payloadSchema.safeParse(JSON.parse(payload));
    try {
      if (!parsed.success)
        throw new PlotwrightError("bad-setting", "It is of another version of plotwright.");
      const { name, drawing, settings } = parsed.data;
      const stored = await files.add([Buffer.from(drawing, "utf8")]);
      const job = await queue.add({ name, settings, drawing: stored, sharedId: id, plotterId });
      log(`shared queue: took "${name}" as ${job.id}`);
      await shared.finish(id, "stored", null);
      this.#unstarted.add(job.id);
      await this.#startThem();
    } catch (error) {
      if (store.isShared(id) || !(error instanceof PlotwrightError)) throw error;
      const message = `A job of the shared queue can't be plotted: ${error.message}`;
      log(message);
      notice(message);
      await shared.finish(id, "refused", error.message);
    }
  }
}

/**
 * For a server's own queue, which is there before it shares one, or shares none any more: what it took from others
 * then waits, since it may have been given away.
 */
export const claimsOf = (store: Pick<Store, "untoldShared">, shared: () => SharedQueue | null): Claims => ({
  claim: async (jobId) => {
    const queue = shared();
    if (queue !== null) return queue.claim(jobId);
    if (!store.untoldShared().some((one) => one.jobId === jobId)) return null;
    return "It is of the queue that servers share, so another one may have been given it: start this server with --shared-queue, or duplicate the job and start the copy.";
  },
  release: async (jobId) => shared()?.release(jobId),
});

const targetText = (target: SharedTarget): string =>
  "plotter" in target ? `plotter ${target.plotter.toLowerCase()}` : `machine ${target.machine}`;

/** It may have been started, or the plotter taken, by somebody meanwhile. */
async function startIfFree(queue: JobQueue, id: string): Promise<void> {
  try {
    await queue.start(id);
  } catch (error) {
    if (!(error instanceof PlotwrightError)) throw error;
  }
}
