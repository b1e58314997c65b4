/** Copies of one drawing that wait one after the other share a row. */
import type { Job } from "../../src/schema/index.js";

/** The first stands for all; never empty. */
export type Copies = readonly [Job, ...Job[]];

/** The waiting jobs in their order, by rows. */
export const rowsOf = (jobs: readonly Job[]): readonly Copies[] => {
  const rows: [Job, ...Job[]][] = [];
  let before = "";
  for (const job of jobs) {
    const now = likenessOf(job);
    const row = rows.at(-1);
    if (row && now === before) row.push(job);
    else rows.push([job]);
    before = now;
  }
  return rows;
};

/** What copies have in common. */
const likenessOf = ({ name, plotterId, settings, stats, message, speedPct, place }: Job): string =>
  JSON.stringify([name, plotterId, settings, stats, message, speedPct, place]);
