/**
 * Finds where an interrupted plot really stopped. The journal is up to half a second old, but a board that still has
 * its step counters reports the position, and whether the pen is down.
 *
 *    journal ──drawn since──┐         pen down: on a stroke, so the plot resumes from exactly that point
 *       o━━━━━━━━━━━━━━━━━━━┿╌╌╌╌     pen up: travelling to a stroke, which is drawn next, or going home,
 *                         (x, y)       after the last stroke or before a change of pens
 *
 * The first match after the journal's place is used: a part drawn twice does less harm than a missing one. For the same
 * reason a pen that is up on a stroke counts as lifted there by a stop, and the plot resumes from the journal's place.
 */
import type { StrokeSet } from "../drawing/stroke-set.js";
import { nearestShare } from "../geometry/polyline.js";
import { pointOfPlace, strokeLengthMm } from "./place-on-drawing.js";
import type { Place } from "./trajectory.js";

/** Tolerance for rounded corners, merged blocks and whole steps, mm. */
const NEAR_MM = 0.08;

/**
 * If the pen is down this close to a stroke's start, the carriage may still be on its way to it, because of rounding or
 * because the pen came down during the travel (pen-flight.ts); mm.
 */
const LANDING_MM = 0.15;
/** Error of a position that is rounded to whole steps, mm. */
const STEP_MM = 0.01;
/** A place nearer than this to the end of a stroke counts as its end, mm. */
const END_MM = 0.05;
/** A carriage that was stopped at once may be this far before the place that its pen reached (swung-place.ts), mm. */
const SWING_MM = 1;
/** Max distance of the carriage from the drawing: `leavesMm` by shaping (shapers.ts), plus NEAR_MM for all else. */
const nearMmOf = (leavesMm: number): number => NEAR_MM + leavesMm;

interface Point {
  readonly x: number;
  readonly y: number;
}

export interface PenPlace extends Point {
  readonly up: boolean;
}

/** How the carriage may have moved since the journal's entry. */
export interface SinceThen {
  /** How far, mm, including travel. */
  readonly aheadMm: number;
  /** Strokes before which it goes home. */
  readonly stops?: readonly number[];
  /** Max deviation from the line by shaping (`leavesLineMm`). */
  readonly leavesMm?: number;
  /** How far before a stroke the pen may begin to come down (`landingMm`). */
  readonly landingMm?: number;
}

/** If nothing matches, the journal's place; if everything is drawn, the end of the last stroke. */
export const stoppedPlace = (strokes: StrokeSet, journal: Place, pen: PenPlace, since: SinceThen): Place =>
  firstMatch(strokes, journal, pen, since) ?? journal;

/** The first place after `journal` that fits the pen; null if there is none, or if the journal's place may be right. */
function firstMatch(
  strokes: StrokeSet,
  journal: Place,
  pen: PenPlace,
  { aheadMm, stops = [], leavesMm = 0, landingMm = 0 }: SinceThen,
): Place | null {
  const nearMm = nearMmOf(leavesMm);
  const { xy, offsets } = strokes;
  const count = offsets.length - 1;
  const goesHomeAfter = (stroke: number): boolean => stroke + 1 === count || stops.includes(stroke + 1);
  if (pen.up && isSettingOut(strokes, journal, pen, nearMm)) return null;
  let leftMm = aheadMm + journal.alongMm;
  for (let stroke = journal.stroke; stroke < count && leftMm > 0; stroke++) {
    const fromMm = stroke === journal.stroke ? journal.alongMm : 0;
    const lengthMm = strokeLengthMm(strokes, stroke);
    if (pen.up) {
      const alongMm = alongOf(strokes, stroke, fromMm - SWING_MM, pen, nearMm);
      // At its end, the pen is lifted to travel on. Before that, it may have been lifted by a stop.
      if (alongMm !== null && (alongMm === 0 || alongMm < lengthMm - END_MM)) return null;
    } else {
      const alongMm = alongOf(strokes, stroke, fromMm, pen, nearMm);
      const isBefore = fromMm === 0 && isLanding(strokes, stroke, pen, { landingMm, nearMm, alongMm });
      if (isBefore) return { stroke, alongMm: 0 };
      if (alongMm !== null) return { stroke, alongMm };
    }
    leftMm -= lengthMm;
    const next = 2 * offsets[stroke + 1];
    const [endX, endY] = [xy[next - 2], xy[next - 1]];
    const isWithinReach = Math.hypot(pen.x - endX, pen.y - endY) <= leftMm;
    const isTravellingTo = (x: number, y: number): boolean =>
      pen.up && isWithinReach && nearest(endX, endY, x, y, pen).awayMm <= nearMm;
    const isLast = stroke + 1 === count;
    if (goesHomeAfter(stroke) && isTravellingTo(0, 0)) {
      return isLast ? { stroke, alongMm: lengthMm } : { stroke: stroke + 1, alongMm: 0 };
    }
    if (isLast) break;
    const [nextX, nextY] = [xy[next], xy[next + 1]];
    if (isTravellingTo(nextX, nextY)) return { stroke: stroke + 1, alongMm: 0 };
    leftMm -= Math.hypot(nextX - endX, nextY - endY);
  }
  return null;
}

/**
 * Whether a pen that is up may be on its way to the journal's place, from home or from the stroke before. At home itself
 * it may also be back from the plot, but then drivers do not tell where it is: it may have been moved there by hand.
 */
function isSettingOut(strokes: StrokeSet, journal: Place, pen: PenPlace, nearMm: number): boolean {
  const { xy, offsets } = strokes;
  const { x, y } = pointOfPlace(strokes, journal);
  const isTravellingFrom = (fromX: number, fromY: number): boolean =>
    nearest(fromX, fromY, x, y, pen).awayMm <= nearMm;
  if (isTravellingFrom(0, 0)) return true;
  const start = 2 * offsets[journal.stroke];
  return journal.alongMm === 0 && journal.stroke > 0 && isTravellingFrom(xy[start - 2], xy[start - 1]);
}

/**
 * Whether the pen is down while the carriage is still travelling to the stroke. A stroke may lead back along the travel:
 * then a position near its start may be on either, and the nearer of the two counts.
 *
 * @param alongMm where on the stroke the carriage may be instead, if anywhere
 */
function isLanding(
  strokes: StrokeSet,
  stroke: number,
  pen: PenPlace,
  { landingMm, nearMm, alongMm }: { landingMm: number; nearMm: number; alongMm: number | null },
): boolean {
  const { xy, offsets } = strokes;
  const start = 2 * offsets[stroke];
  const awayMm = Math.hypot(xy[start] - pen.x, xy[start + 1] - pen.y);
  const travel = [xy[start - 2], xy[start - 1], xy[start], xy[start + 1]] as const;
  const travelMm = stroke === 0 ? Infinity : nearest(...travel, pen).awayMm;
  if (awayMm > LANDING_MM) return awayMm <= landingMm && travelMm <= nearMm;
  if (alongMm === null) return true;
  const { x, y } = pointOfPlace(strokes, { stroke, alongMm });
  return travelMm <= Math.hypot(x - pen.x, y - pen.y) + STEP_MM;
}

/**
 * The same if the server ended while the board kept running. The board has played everything that it received. So it
 * stopped after `sent`, the place up to which commands had been sent at the journal's last entry, and earlier places
 * where the line crosses itself are excluded. Null if the pen is up, or if nothing matches because not everything that
 * was sent has arrived.
 */
export function placeBehindSent(
  strokes: StrokeSet,
  sent: Place,
  pen: PenPlace,
  since: Omit<SinceThen, "stops">,
): Place | null {
  if (pen.up) return null;
  const fromHere = { ...sent, alongMm: Math.max(0, sent.alongMm - nearMmOf(since.leavesMm ?? 0)) };
  return firstMatch(strokes, fromHere, pen, since);
}

/** Where a stroke first passes within `nearMm` of a point after `fromMm`, mm along the stroke; null if it does not. */
function alongOf(
  { xy, offsets }: StrokeSet,
  stroke: number,
  fromMm: number,
  point: Point,
  nearMm: number,
): number | null {
  let startMm = 0;
  let passMm: number | null = null;
  let gapMm = nearMm;
  const last = offsets[stroke + 1] - 1;
  // A dot is a piece of zero length.
  for (let i = offsets[stroke]; i < Math.max(last, offsets[stroke] + 1); i++) {
    const j = Math.min(i + 1, last);
    const piece = [xy[2 * i], xy[2 * i + 1], xy[2 * j], xy[2 * j + 1]] as const;
    const lengthMm = Math.hypot(piece[2] - piece[0], piece[3] - piece[1]);
    const { share, awayMm } = nearest(...piece, point);
    const isAfter = startMm + share * lengthMm >= fromMm - nearMm;
    if (isAfter && awayMm <= gapMm) {
      passMm = startMm + share * lengthMm;
      gapMm = awayMm;
    } else if (passMm !== null) return passMm;
    startMm += lengthMm;
  }
  return passMm;
}

/** The nearest point of a segment as a share of its length, and its distance. */
function nearest(
  x0: number,
  y0: number,
  x1: number,
  y1: number,
  { x, y }: Point,
): { share: number; awayMm: number } {
  const share = nearestShare(x0, y0, x1, y1, x, y);
  return { share, awayMm: Math.hypot(x0 + share * (x1 - x0) - x, y0 + share * (y1 - y0) - y) };
}
