/**
 * How long a plot is likely to take: the plan's time times what this plotter's ended plots took in relation
 * to theirs. The plan knows motion to the step; what it leaves out (a slow servo, a busy computer, the board's
 * own pauses) is much the same from plot to plot on one machine.
 *
 * The middle one of the ratios, so that one odd plot counts for nothing. Ratios beyond 0.5 … 2 are of another
 * kind (a virtual board run faster than time, speeds changed on the way) and are left out.
 */
import type { Job } from "../../src/schema/index.js";

const MOST_PLOTS = 20;
const LEAST_S = 5;
const LEAST_RATIO = 0.5;
const MOST_RATIO = 2;

/** Real seconds for one planned second; 1 without history. `jobs`: newest history first. */
export function timeRatio(jobs: readonly Job[], plotterId: string): number {
  const ratios: number[] = [];
  for (const { state, plotterId: on, plottedS, stats, speedPct } of jobs) {
    if (on !== plotterId || state !== "done" || plottedS === null || stats === null) continue;
    if (speedPct !== 100 || stats.durationS < LEAST_S) continue;
    const ratio = plottedS / stats.durationS;
    if (ratio >= LEAST_RATIO && ratio <= MOST_RATIO) ratios.push(ratio);
    if (ratios.length === MOST_PLOTS) break;
  }
  if (ratios.length === 0) return 1;
  ratios.sort((a, b) => a - b);
  const middle = ratios.length >> 1;
  return ratios.length % 2 === 1
    ? (ratios[middle] as number)
    : ((ratios[middle - 1] as number) + (ratios[middle] as number)) / 2;
}

export const expectedS = (stats: Job["stats"], ratio: number): number | null =>
  stats === null ? null : stats.durationS * ratio;
