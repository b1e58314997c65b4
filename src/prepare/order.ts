/**
 * The order of drawing, layer by layer: less pen-up travel, the same lines.
 *
 * Whatever is asked for, the result is never longer than the order of the file: the shorter is kept.
 */
import type { Lines } from "../geometry/polyline.js";
import { improveTour } from "./best-order.js";
import { nearestOrder } from "./nearest.js";
import type { PrepareSettings } from "./settings.js";
import { fileTour, tagRanges, travelAsDrawn, travelOf, type Tour } from "./tour.js";
import type { Work } from "./work.js";

/** Lines of one tag (layer) must stand together; they still do afterwards, tags in the same order. */
export function orderLines(lines: Lines, settings: OrderSettings, work: Work): Tour {
  if (settings.order === "none") return fileTour(lines);
  const tour = nearestTour(lines, !settings.reloop, work);
  if (settings.order === "best") improveTour(lines, tour, !settings.reloop, settings.orderS, work);
  return travelOf(lines, tour) <= travelAsDrawn(lines) ? tour : fileTour(lines);
}

type OrderSettings = Pick<PrepareSettings, "order" | "orderS" | "reloop">;

function nearestTour(lines: Lines, freeStart: boolean, work: Work): Tour {
  const tour = fileTour(lines);
  let place: { readonly x: number; readonly y: number } = { x: 0, y: 0 };
  for (const [first, end] of tagRanges(lines)) {
    place = nearestOrder(lines, first, end, place, freeStart, tour, work);
  }
  return tour;
}
