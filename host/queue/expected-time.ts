/**
 * The expected time of a plot: the planned time multiplied by the ratio of real to planned time of this plotter's
 * finished plots. The plan has the exact time of all motion. Other delays (a slow servo, a busy computer, pauses of the
 * board) vary little between plots on one machine.
 *
 * The median ratio is used, so a single unusual plot has no effect. Ratios outside 0.5 … 2 have other causes
 * (a virtual board that runs faster than real time, speeds changed while plotting) and are ignored.
 */
import type { Job } from "../../src/schema/index.js";

const MAX_PLOTS = 20;
const MIN_S = 5;
const MIN_RATIO = 0.5;
const MAX_RATIO = 2;

/** Real seconds per planned second; 1 without history. `jobs` must have the newest history first. */
export function timeRatio(jobs: readonly Job[], plotterId: string): number {
  const ratios: number[] = [];
  for (const { state, plotterId: jobPlotterId, plottedS, stats, speedPct } of jobs) {
    if (jobPlotterId !== plotterId || state !== "done" || plottedS === null || stats === null) continue;
    if (speedPct !== 100 || stats.durationS < MIN_S) continue;
    const ratio = plottedS / stats.durationS;
    if (ratio >= MIN_RATIO && ratio <= MAX_RATIO) ratios.push(ratio);
    if (ratios.length === MAX_PLOTS) break;
  }
  if (ratios.length === 0) return 1;
  ratios.sort((a, b) => a - b);
  const middle = ratios.length >> 1;
  return ratios.length % 2 === 1 ? ratios[middle] : (ratios[middle - 1] + ratios[middle]) / 2;
}

export const expectedS = (stats: Job["stats"], ratio: number): number | null =>
  stats === null ? null : stats.durationS * ratio;

/**
 * Measures how long a plot has moved, without the time in which it was held. Times are ISO 8601, as in the job. `beforeS`:
 * how long it had moved before it was interrupted or cancelled.
 */
export class MotionTimer {
  private since: number | null;
  private movedMs: number;

  constructor(nowIso: string, beforeS: number) {
    this.since = Date.parse(nowIso);
    this.movedMs = beforeS * 1_000;
  }

  hold(nowIso: string): void {
    this.movedMs = this.movedS(nowIso) * 1000;
    this.since = null;
  }

  release(nowIso: string): void {
    this.since = Date.parse(nowIso);
  }

  movedS(nowIso: string): number {
    const now = this.since === null ? 0 : Date.parse(nowIso) - this.since;
    return (this.movedMs + now) / 1000;
  }
}
