/** A plotter of a running server, as a handle: each plot is a job there, which is started and followed. */
import { PlotwrightError, type Line } from "../../src/index.js";
import { isSameJson, withGiven } from "../../src/internal.js";
import {
  ENDED_STATES,
  type Job,
  type JobState,
  type Plotter,
  type PlotSettings,
  type ServerEvent,
} from "../../src/schema/index.js";
import { Waiters } from "../plotter/waiters.js";
import { endedOtherwise, LiveSender } from "./live-sender.js";
import { liveSocket, type OpenSocket } from "./live-socket.js";
import { BaseHandle } from "./base-handle.js";
import type { BegunLive } from "./programs-live.js";
import { closed, type CurrentPlot, stopped } from "./current-plot.js";
import {
  fileOf,
  givenOf,
  liftAfterMsOf,
  penTarget,
  positionOf,
  type HandleState,
  type LiveOptions,
  type PlotOptions,
  type PlotResult,
  type PlotterHandle,
} from "./plotter-handle.js";
import { followEvents, serverClient, type ServerAccess, type ServerClient } from "./server-client.js";

/** Throws `not-found` for an unknown plotter, and the server's errors. */
export async function openServedPlotter(
  access: ServerAccess,
  wanted: string | undefined,
  openSocket: OpenSocket,
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
  return new ServerHandle(access, client, plotter, openSocket);
}

/** A plot whose server does not answer for this time ends for the program. A server that is restarted is back before. */
const LOST_MS = 60_000;

/** The job of a plot that this program waits for. */
interface Followed {
  readonly id: string;
  readonly plot: CurrentPlot;
  readonly resolve: (job: Job) => void;
  readonly reject: (error: Error) => void;
  /** Wait for a state of the job. */
  readonly waiters: Waiters;
}

class ServerHandle extends BaseHandle {
  private readonly end = new AbortController();
  private followed: Followed | null = null;
  private sender: LiveSender | null = null;
  private job: Job | null = null;
  /** Why the server's state is not known, and since when. */
  private trouble: { readonly message: string; readonly sinceMs: number } | null = null;

  constructor(
    private readonly access: ServerAccess,
    private readonly requests: ServerClient,
    private plotter: Plotter,
    private readonly openSocket: OpenSocket,
  ) {
    super();
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
      message: trouble?.message ?? message,
      plot: job && {
        progress: job.progress,
        elapsedS: job.elapsedS,
        remainingS: job.remainingS ?? 0,
      },
      wait: job?.wait ?? null,
    };
  }

  protected async draw(
    drawing: string | readonly Line[],
    options: PlotOptions,
    plot: CurrentPlot,
  ): Promise<PlotResult> {
    const { name = "drawing" } = options;
    const given = givenOf(options);
    const { id: plotterId } = this.plotter;
    const { settings } = await this.client.plotters.defaults(plotterId);
    const file = fileOf(drawing, withGiven<PlotSettings>(settings, given));
    plot.throwIfStopped();
    const { id: drawingId } = await this.client.drawings.upload(file);
    plot.throwIfStopped();
    const { id, warnings } = await this.client.jobs.add({ name, drawingId, plotterId, settings: given });
    const ended = this.followJob(id, plot);
    await this.start(id, plot);
    this.control(id, plot);
    const { plottedS, elapsedS } = await ended;
    return { plottedS: plottedS ?? elapsedS, warnings };
  }

  protected async beginLive(options: LiveOptions, plot: CurrentPlot): Promise<BegunLive> {
    const { name } = options;
    const settings = givenOf(options);
    const liftAfterMs = liftAfterMsOf(options);
    if (this.end.signal.aborted) throw closed();
    plot.throwIfStopped();
    const { url, key } = this.access;
    const socket = liveSocket(this.openSocket, url, this.plotter.id, key);
    const strokes = await LiveSender.begin(socket, { name, settings, liftAfterMs });
    if (this.end.signal.aborted) {
      strokes.close();
      throw closed();
    }
    const { id, warnings } = strokes.job;
    const followed = this.followJob(id, plot);
    this.control(id, plot);
    const ended = Promise.race([strokes.ended, followed]).then(({ state, message, plottedS, elapsedS }) => {
      if (state !== "done") throw endedOtherwise(state, message);
      return { plottedS: plottedS ?? elapsedS, warnings };
    });
    this.sender = strokes;
    // If the server is lost for this program, nothing more of it may be drawn.
    ended.catch(() => strokes.close());
    return { strokes, ended };
  }

  /** Resolves with the job when it is done. */
  private followJob(id: string, plot: CurrentPlot): Promise<Job> {
    const ended = new Promise<Job>((resolve, reject) => {
      this.followed = { id, plot, resolve, reject, waiters: new Waiters() };
    });
    ended.catch(() => undefined);
    return ended;
  }

  private control(id: string, plot: CurrentPlot): void {
    let before: Promise<void> = Promise.resolve();
    // A server refuses to resume what is still coming to rest.
    const inTurn = (action: "pause" | "resume", wanted: JobState): Promise<void> => {
      const asked = before.then(() => this.askUntil(id, action, wanted));
      before = asked.catch(() => undefined);
      return asked;
    };
    plot.begin({
      pause: () => inTurn("pause", "paused"),
      resume: () => inTurn("resume", "plotting"),
      cancel: () => this.ask(id, "cancel", "cancelled"),
    });
  }

  /** Resolves when the job is as wanted, or has ended. */
  private async askUntil(id: string, action: "pause" | "resume", wanted: JobState): Promise<void> {
    await this.ask(id, action, wanted);
    const { followed } = this;
    if (followed?.id !== id) return;
    const isSo = (): boolean =>
      this.job !== null && (this.job.state === wanted || ENDED_STATES.includes(this.job.state));
    await followed.waiters.until(isSo);
  }

  protected plotEnded(): void {
    this.followed?.waiters.end(true);
    this.followed = this.sender = this.job = null;
  }

  async pen(where: "up" | "down" | number): Promise<void> {
    this.plotter = await this.client.plotters.pen(this.plotter.id, penTarget(where));
  }

  async moveTo(xMm: number, yMm: number): Promise<void> {
    this.plotter = await this.client.moves["move-to"](this.plotter.id, positionOf(xMm, yMm));
  }

  async home(): Promise<void> {
    this.plotter = await this.client.moves.home(this.plotter.id, {});
  }

  close(): Promise<void> {
    this.end.abort();
    this.sender?.close();
    this.followed?.reject(
      new PlotwrightError("disconnected", "The connection was closed. The plot continues on the server."),
    );
    return Promise.resolve();
  }

  private get client(): ServerClient {
    if (this.end.signal.aborted) throw closed();
    return this.requests;
  }

  private async start(id: string, plot: CurrentPlot): Promise<void> {
    try {
      plot.throwIfStopped();
      await this.client.jobs.start(id);
    } catch (error) {
      // A queue that runs on by itself may have started it already.
      const job = await this.requests.jobs.get(id);
      if (job.state === "queued") {
        await this.requests.jobs.remove(id);
        throw error;
      }
      this.takeJob(job);
    }
  }

  /** Asks nothing of a plot that is so already, or that has ended: as a plotter of this program. */
  private async ask(id: string, action: "pause" | "resume" | "cancel", wanted: JobState): Promise<void> {
    try {
      await this.client.jobs[action](id);
    } catch (error) {
      if (!(error instanceof PlotwrightError && error.code === "conflict")) throw error;
      const job = await this.client.jobs.get(id);
      this.takeJob(job);
      if (job.state !== wanted && !ENDED_STATES.includes(job.state)) throw error;
    }
  }

  private take(event: ServerEvent): void {
    if (event.type === "snapshot") {
      this.trouble = null;
      event.snapshot.plotters.forEach((plotter) => this.takePlotter(plotter));
      const job = event.snapshot.jobs.find(({ id }) => id === this.followed?.id);
      if (job) this.takeJob(job);
      else if (this.followed) void this.findJob(this.followed);
    } else if (event.type === "plotter") this.takePlotter(event.plotter);
    else if (event.type === "job") this.takeJob(event.job);
    else if (event.type === "progress" && this.job?.id === event.jobId) {
      const { progress, elapsedS, remainingS, xMm, yMm, penUp } = event;
      this.plotter = { ...this.plotter, xMm, yMm, penUp };
      this.takeJob({ ...this.job, progress, elapsedS, remainingS });
    } else if (event.type === "job-removed" && event.id === this.followed?.id) {
      this.followed.reject(removed());
    }
    this.announce();
  }

  /** A snapshot without the job may be older than the job. */
  private async findJob({ id, reject }: Followed): Promise<void> {
    try {
      this.takeJob(await this.client.jobs.get(id));
    } catch (error) {
      if (error instanceof PlotwrightError && error.code === "not-found") reject(removed());
    }
  }

  private takePlotter(plotter: Plotter): void {
    if (plotter.id === this.plotter.id) this.plotter = plotter;
  }

  private takeJob(job: Job): void {
    const { followed, job: before } = this;
    if (followed === null || followed.id !== job.id) return;
    this.job = job;
    followed.waiters.check();
    const { progress, elapsedS, remainingS, state, wait } = job;
    if (state !== "queued") followed.plot.tellProgress({ progress, elapsedS, remainingS: remainingS ?? 0 });
    if (wait !== null && !isSameJson(wait, before?.wait)) void followed.plot.changePen(wait);
    if (state === "done") followed.resolve(job);
    if (state === "cancelled") followed.reject(stopped());
    if (state === "failed" || state === "interrupted") followed.reject(faultOf(job));
  }

  private lost({ message }: Error): void {
    const sinceMs = this.trouble?.sinceMs ?? Date.now();
    this.trouble = { message, sinceMs };
    if (Date.now() - sinceMs >= LOST_MS) {
      const where = "Whether the plot continues is to be seen at the plotter, or on the server's page.";
      this.followed?.reject(new PlotwrightError("disconnected", `${message} ${where}`));
    }
    this.announce();
  }
}

const removed = (): PlotwrightError =>
  new PlotwrightError("not-found", "The job of this plot was removed on the server.");

function faultOf({ name, state, message }: Job): PlotwrightError {
  const why = message ?? `${name} has ${state === "failed" ? "failed" : "been interrupted"}.`;
  return new PlotwrightError(state === "failed" ? "board-error" : "disconnected", why);
}
