/**
 * Orders lines within each layer for less pen-up travel.
 *
 * If the file's order has less travel than the result, the file's order is used.
 */
import { distance, type Lines } from "../geometry/polyline.js";
import { improveTour } from "./best-order.js";
import { nearestOrder, type PenPlace } from "./nearest.js";
import type { PrepareSettings } from "../settings/prepare.js";
import { fileTour, tagRanges, travelOf, type Tour } from "./tour.js";
import type { Work } from "./work.js";

/**
 * Lines of one tag (layer) must be contiguous. The tags stay in the same order.
 *
 * @param asDrawnMm the travel of the lines in their current order
 */
export function orderLines(lines: Lines, asDrawnMm: number, settings: OrderSettings, work: Work): Tour {
  if (settings.order === "none") return fileTour(lines);
  const tour = fileTour(lines);
  let travelMm = nearestTour(lines, tour, !settings.reloop, work);
  if (settings.order === "best") {
    improveTour(lines, tour, !settings.reloop, settings.orderS, work);
    travelMm = travelOf(lines, tour);
  }
  return travelMm <= asDrawnMm ? tour : fileTour(lines);
}

type OrderSettings = Pick<PrepareSettings, "order" | "orderS" | "reloop">;

/** Returns the travel, from home and back. */
function nearestTour(lines: Lines, tour: Tour, freeStart: boolean, work: Work): number {
  let place: PenPlace = { x: 0, y: 0, travelMm: 0 };
  for (const [first, end] of tagRanges(lines)) {
    place = nearestOrder(lines, first, end, place, freeStart, tour, work);
  }
  return place.travelMm + distance(place.x, place.y, 0, 0);
}
