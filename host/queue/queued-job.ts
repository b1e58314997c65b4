/** Creates a queued job, and measures how long a plot moves. */
import type { Job } from "../../src/schema/index.js";

/** A new queued job with a new id; plotter, name, settings and figures come from `from`. */
export function queuedJob(
  from: Pick<Job, "plotterId" | "name" | "settings" | "stats" | "warnings">,
  nowIso: string,
): Job {
  return {
    id: crypto.randomUUID(),
    plotterId: from.plotterId,
    name: from.name,
    state: "queued",
    settings: from.settings,
    stats: from.stats,
    warnings: from.warnings,
    progress: 0,
    elapsedS: 0,
    remainingS: from.stats?.durationS ?? null,
    message: null,
    place: null,
    speedPct: 100,
    plottedS: null,
    expectedS: null,
    wait: null,
    createdAt: nowIso,
    startedAt: null,
    endedAt: null,
  };
}

/** Measures how long a plot has moved, without the time in which it was held. Times are ISO 8601, as in the job. */
export class MotionTimer {
  #since: number | null;
  #movedMs = 0;

  constructor(nowIso: string) {
    this.#since = Date.parse(nowIso);
  }

  hold(nowIso: string): void {
    this.#movedMs = this.movedS(nowIso) * 1000;
    this.#since = null;
  }

  release(nowIso: string): void {
    this.#since = Date.parse(nowIso);
  }

  movedS(nowIso: string): number {
    const now = this.#since === null ? 0 : Date.parse(nowIso) - this.#since;
    return (this.#movedMs + now) / 1000;
  }
}
