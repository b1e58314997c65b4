/** How dense a drawing is, so that its lines can be shown thin enough to stay apart. */
import type { PickGrid } from "./pick.js";

/**
 * The mean distance between neighbouring lines, mm: the area of all grid cells that contain a line, divided by the
 * length drawn. Empty paper does not count.
 */
export const lineGapMm = ({ cellMm, starts }: PickGrid, drawMm: number): number => {
  let filled = 0;
  for (let c = 0; c + 1 < starts.length; c++) if (starts[c + 1] > starts[c]) filled++;
  return (filled * cellMm * cellMm) / Math.max(1e-6, drawMm);
};
