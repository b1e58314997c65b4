/** How densely a drawing is drawn, so that its lines can be shown thin enough to stay apart. */
import type { PickGrid } from "./pick.js";

/**
 * The mean distance between a line and the next, mm, where there are lines at all: the area of the grid's cells that
 * have a line in them, by the length drawn. Empty paper counts for nothing.
 */
export const lineGapMm = ({ cellMm, starts }: PickGrid, drawMm: number): number => {
  let filled = 0;
  for (let c = 0; c + 1 < starts.length; c++) if (starts[c + 1] > starts[c]) filled++;
  return (filled * cellMm * cellMm) / Math.max(1e-6, drawMm);
};
