/** Positions in the drawing: a stroke, and mm along it. Their points on the paper, and the nearest one to a point. */
import type { StrokeSet } from "../drawing/stroke-set.js";
import { likeliestPass, passesOf } from "../geometry/passes.js";
import type { StrokePosition } from "../plan/trajectory.js";

/** A place moved along the drawing by whole strokes or by mm; it stays within the drawing. */
export function movedPosition(
  strokes: StrokeSet,
  place: StrokePosition,
  by: { readonly strokes?: number | undefined; readonly mm?: number | undefined },
): StrokePosition {
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
export function pointAt({ xy, offsets }: StrokeSet, place: StrokePosition): { x: number; y: number } {
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

interface Point {
  readonly x: number;
  readonly y: number;
}

/** A stroke's points: x, y, x, y … */
export const pointsOf = ({ xy, offsets }: StrokeSet, stroke: number): Float64Array =>
  xy.subarray(2 * offsets[stroke], 2 * offsets[stroke + 1]);

/**
 * The place of the same stroke that is nearest to (x, y), at most `withinMm` along the stroke from `place`, and the
 * distance. If several are as near, the one nearest along the stroke. Null if there is none.
 *
 * @param heading the pen's velocity: a part of the stroke that runs against it does not count. So at a narrow tip, the
 *   result is not on the other side
 */
export function nearestOnStroke(
  strokes: StrokeSet,
  { stroke, alongMm }: StrokePosition,
  { x, y }: Point,
  withinMm: number,
  heading: Point = STILL,
): { readonly place: StrokePosition; readonly awayMm: number } | null {
  const xy = pointsOf(strokes, stroke);
  const runsAgainst = (from: number): boolean => {
    const i = Math.min(Math.max(0, from), xy.length / 2 - 2);
    return (xy[2 * i + 2] - xy[2 * i]) * heading.x + (xy[2 * i + 3] - xy[2 * i + 1]) * heading.y < 0;
  };
  const passes = passesOf(xy, x, y).filter(
    (pass) =>
      Math.abs(pass.alongMm - alongMm) <= withinMm &&
      // A pass at a point is on two pieces.
      !(runsAgainst(Math.floor(pass.at)) && runsAgainst(Math.ceil(pass.at) - 1)),
  );
  const found = likeliestPass(passes, (pass) => Math.abs(pass.alongMm - alongMm));
  return found && { place: { stroke, alongMm: found.alongMm }, awayMm: found.awayMm };
}

const STILL: Point = { x: 0, y: 0 };
