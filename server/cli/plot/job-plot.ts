/** A job of a server, watched like a plot of this process. */
import { setTimeout as wait } from "node:timers/promises";
import type { PlotOutcome } from "../../../host/plotter/plotter-port.js";
import { PlotwrightError } from "../../../src/index.js";
import type { Job, PlotWait } from "../../../src/schema/index.js";
import type { PlotAmounts } from "./plot-report.js";
import type { WatchedPlot } from "./plot-watch.js";
import type { ServerClient } from "../../../host/handle/server-client.js";

const POLL_MS = 300;
/** A server that restarts answers again after some seconds. */
const MAX_SILENT_POLLS = 40;

export class JobPlot implements WatchedPlot {
  readonly finished: Promise<PlotOutcome>;
  private readonly progressListeners: ((progress: PlotAmounts) => void)[] = [];
  private readonly heldListeners: ((held: boolean, wait: PlotWait | null) => void)[] = [];
  private isHeld = false;
  private waitsFor: string | null = null;
  private isLeft = false;

  constructor(
    private readonly client: ServerClient,
    private readonly id: string,
  ) {
    this.finished = this.follow();
    // Its rejection is handled where it is awaited, which may be later.
    this.finished.catch(() => undefined);
  }

  onProgress(listener: (progress: PlotAmounts) => void): void {
    this.progressListeners.push(listener);
  }

  onHeld(listener: (held: boolean, wait: PlotWait | null) => void): void {
    this.heldListeners.push(listener);
  }

  async pause(): Promise<void> {
    await this.client.jobs.pause(this.id);
  }

  async resume(): Promise<void> {
    await this.client.jobs.resume(this.id);
  }

  async cancel(): Promise<void> {
    await this.client.jobs.cancel(this.id);
  }

  /** Only this command ends: the server goes on. */
  interrupt(): Promise<void> {
    this.isLeft = true;
    return Promise.resolve();
  }

  private async follow(): Promise<PlotOutcome> {
    for (let silent = 0; ; await wait(POLL_MS)) {
      if (this.isLeft) return { kind: "cancelled" };
      const job = await this.client.jobs.get(this.id).catch((error: unknown) => {
        const isSilent = error instanceof PlotwrightError && error.code === "disconnected";
        if (!isSilent || ++silent > MAX_SILENT_POLLS) throw error;
        return null;
      });
      if (job === null) continue;
      silent = 0;
      this.announce(job);
      if (job.state === "done" || job.state === "cancelled") return { kind: job.state };
      if (job.state === "failed" || job.state === "interrupted") throw faultOf(job);
    }
  }

  private announce({ state, progress, elapsedS, remainingS, wait: waitsFor }: Job): void {
    if (state !== "queued") {
      const amounts = { progress, elapsedS, remainingS: remainingS ?? 0 };
      this.progressListeners.forEach((listener) => listener(amounts));
    }
    const isHeld = state === "paused";
    const layer = waitsFor?.layerName ?? null;
    if (isHeld === this.isHeld && layer === this.waitsFor) return;
    this.isHeld = isHeld;
    this.waitsFor = layer;
    this.heldListeners.forEach((listener) => listener(isHeld, waitsFor));
  }
}

function faultOf({ id, name, state, message }: Job): PlotwrightError {
  const why = message ?? `${name} has ${state === "failed" ? "failed" : "been interrupted"}.`;
  if (state === "failed") return new PlotwrightError("board-error", why);
  return new PlotwrightError("disconnected", `${why} Use plotwright resume ${id} to resume it.`);
}
