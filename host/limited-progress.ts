/**
 * Limits progress events to ten times a second, the newest of each plotter, for the server and for the browser's host.
 * Other events pass at once.
 */
import type { ServerEvent } from "../src/schema/index.js";

const PROGRESS_MS = 100;

type ProgressEvent = Extract<ServerEvent, { type: "progress" }>;

export class LimitedProgress {
  private readonly waiting = new Map<string, { readonly event: ProgressEvent; readonly sinceMs: number }>();
  private timer: ReturnType<typeof setTimeout> | null = null;

  constructor(private readonly send: (event: ServerEvent) => void) {}

  announce(event: ServerEvent): void {
    if (event.type === "progress") {
      this.waiting.set(event.plotterId, { event, sinceMs: Date.now() });
      this.timer ??= setTimeout(() => this.sendWaiting(), PROGRESS_MS);
      return;
    }
    // Waiting progress goes first, so that a job's end is not followed by older progress.
    if (event.type === "job") this.sendWaiting();
    this.send(event);
  }

  /** Drops what waits. */
  close(): void {
    if (this.timer !== null) clearTimeout(this.timer);
    this.timer = null;
    this.waiting.clear();
  }

  private sendWaiting(): void {
    const events = [...this.waiting.values()];
    this.close();
    for (const { event, sinceMs } of events) this.send({ ...event, heldBackMs: Date.now() - sinceMs });
  }
}
