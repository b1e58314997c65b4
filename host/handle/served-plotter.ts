/** A plotter of a running server, as a handle: each plot is a job there, which is started and followed. */
import { PlotwrightError, type Line } from "../../src/index.js";
import { isSameJson, withGiven } from "../../src/internal.js";
import type { Job, Plotter, PlotSettings, PlotWait, ServerEvent } from "../../src/schema/index.js";
import {
  fileOf,
  givenOf,
  HandleListeners,
  notPlotting,
  penTarget,
  stopped,
  type HandleState,
  type PlotOptions,
  type PlotResult,
  type PlotterHandle,
} from "./plotter-handle.js";
import { followEvents, serverClient, type ServerAccess, type ServerClient } from "./server-client.js";

/** Throws `not-found` for an unknown plotter, and the server's errors. */
export async function openServedPlotter(
  access: ServerAccess,
  wanted: string | undefined,
): Promise<PlotterHandle> {
  const client = serverClient(access);
  const { plotters } = await client.state.get();
  const plotter =
    wanted === undefined
      ? plotters[0]
      : plotters.find(({ id, name }) => id === wanted || name.toLowerCase() === wanted.toLowerCase());
  if (plotter === undefined) {
    const known = plotters.map(({ name }) => name).join(", ");
    throw new PlotwrightError(
      "not-found",
      `The server at ${access.url} has no plotter ${wanted ?? ""}. It has: ${known === "" ? "none" : known}.`,
    );
  }
  return new ServerHandle(access, client, plotter);
}

/** The job of a plot that this program waits for. */
interface Followed {
  readonly id: string;
  readonly options: PlotOptions;
  readonly resolve: (job: Job) => void;
  readonly reject: (error: Error) => void;
}

class ServerHandle implements PlotterHandle {
  private readonly listeners = new HandleListeners();
  private readonly end = new AbortController();
  private followed: Followed | null = null;
  private job: Job | null = null;
  /** Why the server's state is not known. */
  private trouble: string | null = null;

  constructor(
    access: ServerAccess,
    private readonly client: ServerClient,
    private plotter: Plotter,
  ) {
    void followEvents(
      access,
      (event) => this.take(event),
      (error) => this.lost(error),
      this.end.signal,
    );
  }

  get state(): HandleState {
    const { kind, connection, activity, firmware, message, penUp, xMm, yMm } = this.plotter;
    const { job, trouble } = this;
    return {
      ...{ kind, activity, firmware, penUp, xMm, yMm },
      connection: trouble === null ? connection : "absent",
      message: trouble ?? message,
      plot: job && {
        progress: job.progress,
        elapsedS: job.elapsedS,
        remainingS: job.remainingS ?? 0,
      },
      wait: job?.wait ?? null,
    };
  }

  onChange(listener: (state: HandleState) => void): () => void {
    return this.listeners.add(listener);
  }

  async plot(drawing: string | readonly Line[], options: PlotOptions = {}): Promise<PlotResult> {
    if (this.followed)
      throw new PlotwrightError("busy", "This program is plotting already: wait until it ends.");
    const { name = "drawing", signal } = options;
    const given = givenOf(options);
    const { id: plotterId } = this.plotter;
    const { settings } = await this.client.plotters.defaults(plotterId);
    const file = fileOf(drawing, withGiven<PlotSettings>(settings, given));
    const { id: drawingId } = await this.client.drawings.upload(file);
    const { id, warnings } = await this.client.jobs.add({ name, drawingId, plotterId, settings: given });
    if (signal?.aborted === true) {
      await this.client.jobs.remove(id);
      throw stopped();
    }
    const ended = new Promise<Job>((resolve, reject) => {
      this.followed = { id, options, resolve, reject };
    });
    ended.catch(() => undefined);
    signal?.addEventListener("abort", () => void this.client.jobs.cancel(id).catch(() => undefined), {
      once: true,
    });
    try {
      await this.start(id);
      const { plottedS, elapsedS } = await ended;
      return { plottedS: plottedS ?? elapsedS, warnings };
    } finally {
      this.followed = this.job = null;
      this.listeners.announce(this.state);
    }
  }

  async pause(): Promise<void> {
    await this.client.jobs.pause(this.running());
  }

  async resume(): Promise<void> {
    await this.client.jobs.resume(this.running());
  }

  async stop(): Promise<void> {
    await this.client.jobs.cancel(this.running());
  }

  async pen(where: "up" | "down" | number): Promise<void> {
    this.plotter = await this.client.plotters.pen(this.plotter.id, penTarget(where));
  }

  async moveTo(xMm: number, yMm: number): Promise<void> {
    this.plotter = await this.client.moves["move-to"](this.plotter.id, { xMm, yMm });
  }

  async home(): Promise<void> {
    this.plotter = await this.client.moves.home(this.plotter.id, {});
  }

  close(): Promise<void> {
    this.end.abort();
    this.followed?.reject(
      new PlotwrightError("disconnected", "The connection was closed. The plot continues on the server."),
    );
    return Promise.resolve();
  }

  private running(): string {
    if (this.followed === null) throw notPlotting();
    return this.followed.id;
  }

  private async start(id: string): Promise<void> {
    try {
      await this.client.jobs.start(id);
    } catch (error) {
      // A queue that runs on by itself may have started it already.
      if ((await this.client.jobs.get(id)).state === "queued") {
        await this.client.jobs.remove(id);
        throw error;
      }
    }
  }

  private take(event: ServerEvent): void {
    if (event.type === "snapshot") {
      this.trouble = null;
      event.snapshot.plotters.forEach((plotter) => this.takePlotter(plotter));
      const job = event.snapshot.jobs.find(({ id }) => id === this.followed?.id);
      if (job) this.takeJob(job);
    } else if (event.type === "plotter") this.takePlotter(event.plotter);
    else if (event.type === "job") this.takeJob(event.job);
    else if (event.type === "progress" && this.job?.id === event.jobId) {
      const { progress, elapsedS, remainingS, xMm, yMm, penUp } = event;
      this.plotter = { ...this.plotter, xMm, yMm, penUp };
      this.takeJob({ ...this.job, progress, elapsedS, remainingS });
    } else if (event.type === "job-removed" && event.id === this.followed?.id) {
      this.followed.reject(new PlotwrightError("not-found", "The job was removed on the server."));
    }
    this.listeners.announce(this.state);
  }

  private takePlotter(plotter: Plotter): void {
    if (plotter.id === this.plotter.id) this.plotter = plotter;
  }

  private takeJob(job: Job): void {
    const { followed, job: before } = this;
    if (followed === null || followed.id !== job.id) return;
    this.job = job;
    const { progress, elapsedS, remainingS, state, wait } = job;
    if (state !== "queued")
      followed.options.onProgress?.({ progress, elapsedS, remainingS: remainingS ?? 0 });
    if (wait !== null && !isSameJson(wait, before?.wait)) void this.changePen(followed, wait);
    if (state === "done") followed.resolve(job);
    if (state === "cancelled") followed.reject(stopped());
    if (state === "failed" || state === "interrupted") followed.reject(faultOf(job));
  }

  private async changePen({ id, options, reject }: Followed, wait: PlotWait): Promise<void> {
    if (options.onPenChange === undefined) return;
    try {
      await options.onPenChange(wait);
      await this.client.jobs.resume(id);
    } catch (error) {
      reject(error instanceof Error ? error : new Error(String(error)));
      await this.client.jobs.cancel(id).catch(() => undefined);
    }
  }

  private lost({ message }: Error): void {
    this.trouble = message;
    this.listeners.announce(this.state);
  }
}

function faultOf({ name, state, message }: Job): PlotwrightError {
  const why = message ?? `${name} has ${state === "failed" ? "failed" : "been interrupted"}.`;
  return new PlotwrightError(state === "failed" ? "board-error" : "disconnected", why);
}
