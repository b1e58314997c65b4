/** When each job of a plotter's queue starts and ends, as far as that is known, and where a person must act. */
import { needsNewPaper } from "../../src/internal.js";
import type { Job } from "../../src/schema/index.js";
import type { Copies } from "./copies.js";

/** What a person must do before a row of the queue can start. */
export type QueueBreak =
  /** Put in new paper, and press Start. */
  | { readonly kind: "paper" }
  /** Put in another pen. `isStop`: the plot waits for it; otherwise it would begin with the wrong pen. */
  | { readonly kind: "pen"; readonly name: string; readonly color: string | null; readonly isStop: boolean }
  /** It waits at its first stroke until it is resumed. */
  | { readonly kind: "place" };

/** Times are in seconds from now; null: not known. */
export interface AxisRow {
  readonly copies: Copies;
  /** Of all copies. */
  readonly durationS: number | null;
  readonly fromS: number | null;
  readonly toS: number | null;
  /** Nobody has to act before. Otherwise it starts, or ends, at this time at the earliest. */
  readonly isStartSure: boolean;
  readonly isEndSure: boolean;
  readonly breaks: readonly QueueBreak[];
}

export interface QueueAxis {
  readonly rows: readonly AxisRow[];
  /** From the rest of the running plot to the end of the last row, as far as it is known. */
  readonly totalS: number;
  readonly isTotalKnown: boolean;
  readonly endS: number | null;
  readonly isEndSure: boolean;
}

/** The job's expected duration; null while it is being planned. */
export const expectedSOf = ({ expectedS, stats }: Job): number | null =>
  expectedS ?? stats?.durationS ?? null;

/** Whether new paper is put in between two plots. */
export const waitsForPaper = (before: Job, next: Job, runsOn: boolean): boolean =>
  !runsOn || needsNewPaper(before.settings.prepare, next.settings.prepare);

/** How often a running job still waits for another pen. */
export const stopsLeft = ({ stats, progress }: Job): number =>
  stats?.pens?.stops.filter(({ atS }) => atS > progress * stats.durationS).length ?? 0;

const sum = (a: number | null, b: number | null): number | null => (a === null || b === null ? null : a + b);

/**
 * `active`: the jobs that have the plotter, or wait to get it back. Without one, the times are those of a start now.
 * While one does not move, nobody knows when the others start. `runsOn`: the next plot starts by itself. `seesAll`: these
 * are all jobs of the plotter; otherwise those of others may come first.
 */
export const queueAxis = (
  active: readonly Job[],
  waiting: readonly Copies[],
  { runsOn, seesAll }: { readonly runsOn: boolean; readonly seesAll: boolean },
): QueueAxis => {
  const running = active.find(({ state }) => state === "plotting");
  const isHeld = active.length > 0 && running === undefined;
  let atS: number | null = isHeld || !seesAll ? null : running === undefined ? 0 : running.remainingS;
  let isSure = running === undefined || stopsLeft(running) === 0;
  let before: Job | undefined = running ?? active[0];
  const rows: AxisRow[] = [];
  for (const copies of waiting) {
    const [job] = copies;
    const breaks = breaksBetween(before, job, runsOn);
    const isStartSure: boolean = isSure && breaks.every((one) => one.kind === "pen" && !one.isStop);
    const durationS = copies.reduce((all, copy) => sum(all, expectedSOf(copy)), 0 as number | null);
    const fromS = atS;
    atS = sum(atS, durationS);
    const waitsBetween = copies.length > 1 && waitsForPaper(job, job, runsOn);
    isSure = isStartSure && !waitsBetween && (job.stats?.pens?.stops.length ?? 0) === 0;
    rows.push({ copies, durationS, fromS, toS: atS, isStartSure, isEndSure: isSure, breaks });
    before = job;
  }
  const knownS = [
    ...active.map((job) => job.remainingS ?? expectedSOf(job)),
    ...rows.map((row) => row.durationS),
  ];
  return {
    rows,
    totalS: knownS.reduce<number>((all, s) => all + (s ?? 0), 0),
    isTotalKnown: !knownS.includes(null),
    endS: atS,
    isEndSure: isSure,
  };
};

/** `before`: the job plotted before it; undefined: none, and it is not known which pen is in the holder. */
const breaksBetween = (before: Job | undefined, job: Job, runsOn: boolean): readonly QueueBreak[] => {
  const breaks: QueueBreak[] = [];
  if (before !== undefined && waitsForPaper(before, job, runsOn)) breaks.push({ kind: "paper" });
  const pen = penBreak(before, job);
  if (pen !== null) breaks.push(pen);
  if (job.place !== null) breaks.push({ kind: "place" });
  return breaks;
};

const penBreak = (before: Job | undefined, job: Job): QueueBreak | null => {
  const { first, stops = [] } = job.stats?.pens ?? {};
  const stop = stops.find(({ strokeIndex }) => strokeIndex === 0);
  if (stop) return { kind: "pen", name: stop.name, color: stop.color, isStop: true };
  const last = before?.stats?.pens?.last;
  const needsOther = first && last && first.name !== last.name;
  return needsOther ? { kind: "pen", ...first, isStop: false } : null;
};
