/** Waiting copies of one drawing that follow each other share a row. */
import type { Job } from "../../src/schema/index.js";

/** The jobs of a row, never empty. The first represents them all. */
export type Copies = readonly [Job, ...Job[]];

/** Groups the waiting jobs into rows, in their order. */
export const rowsOf = (jobs: readonly Job[]): readonly Copies[] => {
  const rows: [Job, ...Job[]][] = [];
  let lastKey = "";
  for (const job of jobs) {
    const key = keyOf(job);
    const row = rows.at(-1);
    if (row && key === lastKey) row.push(job);
    else rows.push([job]);
    lastKey = key;
  }
  return rows;
};

/** Everything that is the same for copies. */
const keyOf = ({ name, plotterId, settings, stats, message, speedPct, place }: Job): string =>
  JSON.stringify([name, plotterId, settings, stats, message, speedPct, place]);
