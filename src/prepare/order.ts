/**
 * Orders lines within each layer for less pen-up travel.
 *
 * If the file's order has less travel than the result, the file's order is used.
 */
import { tagRanges, type Lines } from "../geometry/polyline.js";
import { improveTour } from "./best-order.js";
import { nearestOrder } from "./nearest.js";
import type { PrepareSettings } from "../settings/prepare.js";
import { fileTour, travelAsDrawn, travelOf, type Tour } from "./tour.js";
import type { Work } from "./work.js";

type OrderSettings = Pick<PrepareSettings, "order" | "orderS" | "reloop">;

/** Lines of one tag (layer) must be contiguous. The tags stay in the same order. */
export function orderLines(lines: Lines, { order, orderS, reloop }: OrderSettings, work: Work): Tour {
  const tour = fileTour(lines);
  if (order === "none") return tour;
  let pen = { x: 0, y: 0 };
  for (const [first, end] of tagRanges(lines)) {
    pen = nearestOrder(lines, first, end, pen, !reloop, tour, work);
  }
  if (order === "best") improveTour(lines, tour, !reloop, orderS, work);
  return travelOf(lines, tour) <= travelAsDrawn(lines) ? tour : fileTour(lines);
}
