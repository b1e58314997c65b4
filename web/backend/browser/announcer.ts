/**
 * Announces the changes of a browser's host. Each event is held back until all changes before it are stored. Progress is
 * limited as by the server (server/http/events.ts).
 */
import type { ServerEvent } from "../../../src/schema/index.js";
import type { Records } from "./database.js";

/** Interval for progress events; only the newest of each plotter is sent. */
const PROGRESS_MS = 100;

type ProgressEvent = Extract<ServerEvent, { type: "progress" }>;

export function announcer(
  db: Pick<Records, "written">,
  send: (event: ServerEvent) => void,
): (event: ServerEvent) => void {
  const progress = new Map<string, ProgressEvent>();
  let progressTimer: ReturnType<typeof setTimeout> | null = null;
  let last: Promise<void> = Promise.resolve();
  const sendStored = (event: ServerEvent): void => {
    // A change that can't be stored is announced too: the page must always show a running plot. A notice reports the
    // fault.
    const stored = db.written().catch(() => undefined);
    last = last.then(() => stored).then(() => send(event));
  };
  const sendProgress = (): void => {
    if (progressTimer !== null) clearTimeout(progressTimer);
    progressTimer = null;
    for (const event of progress.values()) sendStored(event);
    progress.clear();
  };
  return (event) => {
    if (event.type === "progress") {
      progress.set(event.plotterId, event);
      progressTimer ??= setTimeout(sendProgress, PROGRESS_MS);
      return;
    }
    // Pending progress goes first, so that a job's end is not followed by older progress.
    if (event.type === "job") sendProgress();
    sendStored(event);
  };
}
