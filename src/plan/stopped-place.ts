/**
 * Finds where an interrupted plot stopped: the connection was lost, or the program ended while the board kept running.
 * A board that still has its step counters reports its position, and whether the pen is down.
 *
 *    received ────── may have been sent ──────┐    pen down: on a stroke
 *       o━━━━━━━━━━━━━━━━━━━━━━━━━━━━━━━━━━━━━┿╌╌  pen up: lifted on a stroke by a pause, travelling to the next stroke,
 *                            (x, y)                or going home, after the last stroke or before a change of pens
 *
 * A board draws everything that it has received, so it did not stop before `received`. From there on, the line may pass
 * its position several times. The first pass counts: a part drawn twice does less harm than a missing one, and no more
 * is drawn twice than what may have been sent after `received`.
 */
import type { StrokeSet } from "../drawing/stroke-set.js";
import { nearestShare } from "../geometry/polyline.js";
import type { MachineProfile } from "../machines/profile.js";
import type { MotionSettings } from "../settings/motion.js";
import { pointOfPlace, strokeLengthMm } from "./place-on-drawing.js";
import { leavesLineMm } from "./shapers.js";
import type { Place } from "./trajectory.js";

/**
 * If the pen is down this close to a stroke's start, the carriage may still be on its way to it, because of rounding or
 * because the pen came down during the travel (pen-flight.ts); mm.
 */
const LANDING_MM = 0.15;
/** Error of a position that is rounded to whole steps, mm. */
const STEP_MM = 0.01;
/** A place nearer than this to the end of a stroke counts as its end, mm. */
const END_MM = 0.05;

/** Rounding of a position to whole steps of both motors. */
const ROUNDED_STEPS = 2;
/** Allowance for arithmetic, and for the difference between mm along the plan and along the drawing, mm. */
const SLACK_MM = 0.02;

/** Max distance of the carriage from the drawing while the pen is down: rounding, merged blocks, steps and shaping; mm. */
export function leavesDrawingMm(
  motion: MotionSettings,
  { springs, stepsPerMm }: Pick<MachineProfile, "springs" | "stepsPerMm">,
): number {
  const ownCornersMm = Object.values(motion.layers ?? {}).map(({ cornerMm }) => cornerMm ?? 0);
  const roundedMm = Math.max(motion.draw.cornerMm, ...ownCornersMm) + ROUNDED_STEPS / stepsPerMm;
  return roundedMm + (motion.fit?.toleranceMm ?? 0) + leavesLineMm(motion, springs ?? null) + SLACK_MM;
}

interface Point {
  readonly x: number;
  readonly y: number;
}

const HOME: Point = { x: 0, y: 0 };

export interface PenPlace extends Point {
  readonly up: boolean;
}

/** How the carriage may have moved after the received place. */
export interface SinceThen {
  /** How far, mm, including travel. */
  readonly aheadMm: number;
  /** Max distance of the carriage from the drawing (`leavesDrawingMm`). */
  readonly nearMm: number;
  /** Strokes before which it goes home. */
  readonly stops?: readonly number[];
  /** How far before a stroke the pen may begin to come down (`landingMm`). */
  readonly landingMm?: number;
}

/** The first place from `received` on that fits the pen; if everything is drawn, the end. Null if there is none. */
export function stoppedPlace(
  strokes: StrokeSet,
  received: Place,
  pen: PenPlace,
  { aheadMm, nearMm, stops = [], landingMm = 0 }: SinceThen,
): Place | null {
  const count = strokes.offsets.length - 1;
  const startOf = (stroke: number): Point => pointOfPlace(strokes, { stroke, alongMm: 0 });
  const endOf = (stroke: number): Point => pointOfPlace(strokes, { stroke, alongMm: Infinity });
  const goesHomeBefore = (stroke: number): boolean => stroke === count || stops.includes(stroke);
  const isBetween = (from: Point, to: Point): boolean => nearest(from, to, pen).awayMm <= nearMm;

  // mm and places along the plan differ slightly from those along the drawing.
  let fromMm = received.alongMm - 2 * nearMm;
  // On its way to the stroke. At the end of the stroke before, the pen may still be down.
  const start = { stroke: received.stroke, alongMm: 0 };
  const cameFromHome = received.stroke === 0 || goesHomeBefore(received.stroke);
  const cameFrom = cameFromHome ? HOME : endOf(received.stroke - 1);
  if (fromMm < 0 && isBetween(cameFrom, pointOfPlace(strokes, start))) return start;

  let leftMm = received.alongMm + aheadMm;
  for (let stroke = received.stroke; stroke < count && leftMm > 0; stroke++) {
    const lengthMm = strokeLengthMm(strokes, stroke);
    const alongMm = firstPass(strokes, stroke, [fromMm, leftMm], pen, nearMm);
    const mayLand = !pen.up && fromMm < 0;
    if (mayLand && isLanding(strokes, stroke, pen, { landingMm, nearMm, alongMm })) {
      return { stroke, alongMm: 0 };
    }
    // A pen that is up at the end of a stroke was lifted to travel on.
    if (alongMm !== null && !(pen.up && alongMm >= lengthMm - END_MM)) return { stroke, alongMm };
    leftMm -= lengthMm;
    const [end, next] = [endOf(stroke), stroke + 1];
    const goal = goesHomeBefore(next) ? HOME : startOf(next);
    if (pen.up && distance(end, pen) <= leftMm && isBetween(end, goal)) {
      return next === count ? { stroke, alongMm: lengthMm } : { stroke: next, alongMm: 0 };
    }
    leftMm -= distance(end, goal);
    fromMm = -2 * nearMm;
  }
  return null;
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
  const start = pointOfPlace(strokes, { stroke, alongMm: 0 });
  const awayMm = distance(start, pen);
  const before = stroke === 0 ? null : pointOfPlace(strokes, { stroke: stroke - 1, alongMm: Infinity });
  const travelMm = before ? nearest(before, start, pen).awayMm : Infinity;
  if (awayMm > LANDING_MM) return awayMm <= landingMm && travelMm <= nearMm;
  if (alongMm === null) return true;
  return travelMm <= distance(pointOfPlace(strokes, { stroke, alongMm }), pen) + STEP_MM;
}

/**
 * Where a stroke first passes within `nearMm` of a point, mm along the stroke, between two places; null if it does not.
 * Of a pass, the first point counts at which the distance no longer falls.
 */
function firstPass(
  { xy, offsets }: StrokeSet,
  stroke: number,
  [fromMm, toMm]: readonly [number, number],
  point: Point,
  nearMm: number,
): number | null {
  const last = offsets[stroke + 1] - 1;
  const at = (i: number): Point => ({ x: xy[2 * i], y: xy[2 * i + 1] });
  let startMm = 0;
  let passMm: number | null = null;
  // A dot is a piece of zero length.
  for (let i = offsets[stroke]; i < Math.max(last, offsets[stroke] + 1) && startMm <= toMm; i++) {
    const [from, to] = [at(i), at(Math.min(i + 1, last))];
    const lengthMm = distance(from, to);
    const { share, awayMm } = nearest(from, to, point);
    const alongMm = startMm + share * lengthMm;
    // At the start of a piece the distance was already reached at the end of the piece before.
    if (passMm !== null && share === 0) return passMm;
    if (awayMm <= nearMm && alongMm >= fromMm && alongMm <= toMm) {
      if (share < 1) return alongMm;
      passMm = alongMm;
    } else if (passMm !== null) return passMm;
    startMm += lengthMm;
  }
  return passMm;
}

const distance = (a: Point, b: Point): number => Math.hypot(a.x - b.x, a.y - b.y);

/** The nearest point of a segment as a share of its length, and its distance. */
function nearest(from: Point, to: Point, { x, y }: Point): { share: number; awayMm: number } {
  const share = nearestShare(from.x, from.y, to.x, to.y, x, y);
  const awayMm = Math.hypot(from.x + share * (to.x - from.x) - x, from.y + share * (to.y - from.y) - y);
  return { share, awayMm };
}
