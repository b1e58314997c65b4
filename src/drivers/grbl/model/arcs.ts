/**
 * Finds the arcs in a polyline: runs of segments that a single G2 or G3 can draw. From its first point, each run is made as
 * long as possible, by doubling and then halving the step, so that the time is n log n.
 *
 *        ·──·            an arc passes each point within POINT_MM, each segment within CHORD_MM,
 *      ·      ·          turns where the polyline turns, and ends exactly on points
 *     ·        ·
 *
 * A circle through both ends has one free number: how far its centre is from their chord. The least squares of the points
 * between them give it.
 */
import type { Arc } from "./arc-cut.js";

/** The points of a run on the controller's axes, mm. */
export interface ArcPath {
  readonly segmentCount: number;
  /** As drawn. */
  readonly x: Float64Array;
  readonly y: Float64Array;
  /** The same on whole steps. An arc begins and ends on those. */
  readonly stepX: Float64Array;
  readonly stepY: Float64Array;
  /** Max speed² of each segment, which does not change within an arc; (mm/s)². */
  readonly cap2: Float64Array;
}

/** An arc in place of the segments from point `first` to point `last`. */
export interface FoundArc extends Arc {
  readonly first: number;
  readonly last: number;
}

const POINT_MM = 0.01;
/** The gap between curves and their chords, by default. */
const CHORD_MM = 0.02;
/** The pen is never farther from the polyline, however coarse the steps are. */
const MOST_MM = 0.05;
/** Fewer lines are as short to send. */
const MIN_SEGMENTS = 3;
const MIN_RADIUS_MM = 0.25;
/** A larger circle is nearly straight. */
const MAX_RADIUS_MM = 500;
/** A third of a turn and a little: far from a full circle, whose start and end are the same. */
const MAX_SWEEP = 2.1;
/** How long one line may draw: a host that stops in its middle does not know how far the Grbl has come. */
const MAX_S = 0.3;
/** A vertex may turn by twice what the arc turns there, and this; or it is a corner; rad. */
const CORNER = 0.1;
/** Both radii of an arc as written. A Grbl accepts 0.005 mm, but the lines are rounded, and so is its own start. */
const MAX_RADII_MM = 0.0015;

/** @param roundingMm how far a point may be from whole steps */
export function arcsOf(path: ArcPath, roundingMm: number): FoundArc[] {
  const arcs: FoundArc[] = [];
  const { segmentCount } = path;
  let first = 0;
  while (first + MIN_SEGMENTS <= segmentCount) {
    let best = arcBetween(path, first, first + MIN_SEGMENTS, roundingMm);
    if (!best) {
      first++;
      continue;
    }
    let tooFar = segmentCount + 1;
    for (let step = MIN_SEGMENTS; best.last < segmentCount; step *= 2) {
      const last = Math.min(segmentCount, best.last + step);
      const longer = arcBetween(path, first, last, roundingMm);
      if (!longer) {
        tooFar = last;
        break;
      }
      best = longer;
    }
    while (tooFar - best.last > 1) {
      const last = Math.floor((best.last + tooFar) / 2);
      const longer = arcBetween(path, first, last, roundingMm);
      if (longer) best = longer;
      else tooFar = last;
    }
    arcs.push(best);
    first = best.last;
  }
  return arcs;
}

/** Null if there is none near enough. */
function arcBetween(path: ArcPath, first: number, last: number, roundingMm: number): FoundArc | null {
  const arc = fitted(path, first, last);
  return arc && follows(path, arc, roundingMm) ? arc : null;
}

/** The circle through both ends that is nearest to the points between them. */
function fitted({ x, y, stepX, stepY }: ArcPath, first: number, last: number): FoundArc | null {
  const [startX, startY] = [stepX[first], stepY[first]];
  const [chordX, chordY] = [stepX[last] - startX, stepY[last] - startY];
  const half = Math.hypot(chordX, chordY) / 2;
  if (half === 0) return null;
  const [ux, uy] = [chordX / (2 * half), chordY / (2 * half)];
  // In the frame of the chord, from its middle: `v` to its left. A centre at (0, k) is as far from both ends as from (t, v)
  // if 2 k v = t² + v² − half².
  let [left, product, square] = [0, 0, 0];
  for (let k = first + 1; k < last; k++) {
    const [dx, dy] = [x[k] - startX, y[k] - startY];
    const t = dx * ux + dy * uy - half;
    const v = dy * ux - dx * uy;
    left += v;
    product += v * (t * t + v * v - half * half);
    square += v * v;
  }
  if (square === 0) return null;
  const centre = product / (2 * square);
  const radius = Math.hypot(half, centre);
  if (!(radius >= MIN_RADIUS_MM && radius <= MAX_RADIUS_MM)) return null;
  const i = asWritten(chordX / 2 - uy * centre);
  const j = asWritten(chordY / 2 + ux * centre);
  if (Math.abs(Math.hypot(chordX - i, chordY - j) - Math.hypot(i, j)) > MAX_RADII_MM) return null;
  return { first, last, i, j, clockwise: left > 0 };
}

/** Whether the arc stays near the polyline from its start to its end, and the polyline near the arc. */
function follows(path: ArcPath, { first, last, i, j, clockwise }: FoundArc, roundingMm: number): boolean {
  const { x, y, stepX, stepY, cap2 } = path;
  // The ends of an arc are on whole steps, and so are the moves that the Grbl makes of it.
  const mostMm = MOST_MM - roundingMm;
  const pointMm = Math.min(mostMm, POINT_MM + roundingMm);
  const chordMm = Math.min(mostMm, CHORD_MM + roundingMm);
  const [centreX, centreY] = [stepX[first] + i, stepY[first] + j];
  const radius = Math.hypot(i, j);
  const sense = clockwise ? -1 : 1;
  const maxMm = Math.min(MAX_S * Math.sqrt(cap2[first]), MAX_SWEEP * radius);
  // From the centre, and along the previous segment.
  let [rx, ry] = [x[first] - centreX, y[first] - centreY];
  let [beforeX, beforeY, turnBefore] = [0, 0, 0];
  let sweep = 0;
  for (let k = first + 1; k <= last; k++) {
    if (cap2[k - 1] !== cap2[first]) return false;
    const [qx, qy] = [x[k] - centreX, y[k] - centreY];
    if (Math.abs(Math.hypot(qx, qy) - radius) > pointMm) return false;
    const turn = sense * Math.atan2(rx * qy - ry * qx, rx * qx + ry * qy);
    if (turn <= 0) return false;
    sweep += turn;
    if (sweep * radius > maxMm) return false;
    const [dx, dy] = [qx - rx, qy - ry];
    const share = Math.min(1, Math.max(0, -(rx * dx + ry * dy) / (dx * dx + dy * dy)));
    const nearest = Math.hypot(rx + share * dx, ry + share * dy);
    if (radius - nearest > chordMm) return false;
    if (k > first + 1) {
      const corner =
        sense * Math.atan2(beforeX * dy - beforeY * dx, beforeX * dx + beforeY * dy) - turnBefore - turn;
      if (corner > CORNER || corner < -turnBefore - turn - CORNER) return false;
    }
    [rx, ry, beforeX, beforeY, turnBefore] = [qx, qy, dx, dy, turn];
  }
  return true;
}

/** Lines have three decimals. */
const asWritten = (mm: number): number => Math.round(1_000 * mm) / 1_000;
