/** Places on the strokes themselves: how long a stroke is, where a place lies, and which place is near a point. */
import type { StrokeSet } from "../drawing/stroke-set.js";
import { nearestShare } from "../geometry/polyline.js";
import type { Place } from "./trajectory.js";

/** A place moved along the drawing by whole strokes or by mm; it stays within the drawing. */
export function movedPlace(
  strokes: StrokeSet,
  place: Place,
  by: { readonly strokes?: number | undefined; readonly mm?: number | undefined },
): Place {
  const last = strokes.offsets.length - 2;
  let { stroke, alongMm } = place;
  if (by.strokes) {
    // The first step back from the middle of a stroke goes to its beginning.
    const back = by.strokes < 0 && alongMm > 0 ? 1 : 0;
    stroke = Math.min(last, Math.max(0, stroke + by.strokes + back));
    alongMm = 0;
  }
  alongMm += by.mm ?? 0;
  while (alongMm < 0 && stroke > 0) alongMm += strokeLengthMm(strokes, --stroke);
  while (stroke < last && alongMm > strokeLengthMm(strokes, stroke)) {
    alongMm -= strokeLengthMm(strokes, stroke++);
  }
  return { stroke, alongMm: Math.min(Math.max(0, alongMm), strokeLengthMm(strokes, stroke)) };
}

/** The segment from point `i` of a stroke to the next one. */
function segmentAt(xy: Float64Array, i: number) {
  const [x, y] = [xy[2 * i], xy[2 * i + 1]];
  const [dx, dy] = [xy[2 * i + 2] - x, xy[2 * i + 3] - y];
  return { x, y, dx, dy, lengthMm: Math.hypot(dx, dy) };
}

export function strokeLengthMm({ xy, offsets }: StrokeSet, stroke: number): number {
  let lengthMm = 0;
  for (let i = offsets[stroke]; i + 1 < offsets[stroke + 1]; i++) lengthMm += segmentAt(xy, i).lengthMm;
  return lengthMm;
}

/** The point of the drawing at a place, mm. */
export function pointOfPlace({ xy, offsets }: StrokeSet, place: Place): { x: number; y: number } {
  let leftMm = place.alongMm;
  const end = offsets[place.stroke + 1] - 1;
  for (let i = offsets[place.stroke]; i < end; i++) {
    const { x, y, dx, dy, lengthMm } = segmentAt(xy, i);
    if (leftMm <= lengthMm && lengthMm > 0) {
      return { x: x + (dx * leftMm) / lengthMm, y: y + (dy * leftMm) / lengthMm };
    }
    leftMm -= lengthMm;
  }
  return { x: xy[2 * end], y: xy[2 * end + 1] };
}

/** A pen's position, mm, and velocity, mm/s. */
interface Moving {
  readonly x: number;
  readonly y: number;
  readonly vx: number;
  readonly vy: number;
}

/**
 * Corrects a place to the point of the same stroke that is nearest to (x, y). This is needed because mm along the plan
 * and mm along the drawing differ slightly where the plan rounds a corner.
 *
 * The search follows the stroke while the distance falls, for at most `withinMm`. A search over the whole stroke could
 * find the other side of a narrow tip. If the stroke's direction at the result is opposite to (vx, vy), the result is
 * on the other side too; then the given place is returned.
 */
export function snappedPlace(
  { xy, offsets }: StrokeSet,
  place: Place,
  { x, y, vx, vy }: Moving,
  withinMm: number,
): Place {
  const { stroke, alongMm } = place;
  const [first, end] = [offsets[stroke], offsets[stroke + 1] - 1];
  if (first >= end) return place;
  let i = first;
  let fromMm = 0;
  while (i + 1 < end && fromMm + segmentAt(xy, i).lengthMm < alongMm) fromMm += segmentAt(xy, i++).lengthMm;
  // `step`: the direction of the search, +1 or −1; 0 at first.
  for (let step = 0; ;) {
    const { x: fromX, y: fromY, dx, dy, lengthMm } = segmentAt(xy, i);
    const dot = (x - fromX) * dx + (y - fromY) * dy;
    const footMm = lengthMm > 0 ? dot / lengthMm : step;
    const next = footMm > lengthMm ? 1 : footMm < 0 ? -1 : 0;
    const nearestMm = fromMm + Math.min(lengthMm, Math.max(0, footMm));
    const isThere = next === 0 || next === -step || i + next < first || i + next >= end;
    if (isThere || Math.abs(nearestMm - alongMm) >= withinMm) {
      if (dx * vx + dy * vy < 0) return place;
      const byMm = Math.min(withinMm, Math.max(-withinMm, nearestMm - alongMm));
      return { stroke, alongMm: alongMm + byMm };
    }
    step = next;
    fromMm += step > 0 ? lengthMm : -segmentAt(xy, i - 1).lengthMm;
    i += step;
  }
}

/**
 * The place nearest to (x, y) on the same stroke, and the distance to it. At most `withinMm` along the stroke from
 * `place`; infinitely far if there is none.
 */
export function nearestPlace(
  { xy, offsets }: StrokeSet,
  { stroke, alongMm }: Place,
  { x, y }: { readonly x: number; readonly y: number },
  withinMm: number,
): { readonly place: Place; readonly awayMm: number } {
  let [nearestMm, awayMm] = [alongMm, Infinity];
  let fromMm = 0;
  for (let i = offsets[stroke]; i + 1 < offsets[stroke + 1] && fromMm <= alongMm + withinMm; i++) {
    const { x: fromX, y: fromY, dx, dy, lengthMm } = segmentAt(xy, i);
    const share = nearestShare(fromX, fromY, fromX + dx, fromY + dy, x, y);
    const pieceMm = Math.hypot(fromX + share * dx - x, fromY + share * dy - y);
    const onMm = fromMm + share * lengthMm;
    if (pieceMm < awayMm && Math.abs(onMm - alongMm) <= withinMm) [nearestMm, awayMm] = [onMm, pieceMm];
    fromMm += lengthMm;
  }
  return { place: { stroke, alongMm: nearestMm }, awayMm };
}
