/**
 * The position of a plot whose connection was lost, or whose program ended, while the board kept running. A board that
 * still has its step counters reports where the carriage is, and whether the pen is down.
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
import { passesOf } from "../geometry/passes.js";
import type { MachineProfile } from "../machines/profile.js";
import { maxShapingErrorMm } from "../plan/shaping/shapers.js";
import type { StrokePosition } from "../plan/trajectory.js";
import type { MotionSettings } from "../settings/motion.js";
import { pointAt, pointsOf, strokeLengthMm } from "./on-drawing.js";

/**
 * If the pen is down this close to a stroke's start, the carriage may still be on its way to it, because of rounding or
 * because the pen came down during the travel (pen-flight.ts); mm.
 */
const LOWERING_MM = 0.15;
/** Error of a position that is rounded to whole steps, mm. */
const STEP_MM = 0.01;
/** A position nearer than this to the end of a stroke counts as its end, mm. */
const END_MM = 0.05;

/** Rounding of a position to whole steps of both motors. */
const ROUNDED_STEPS = 2;
/** Allowance for arithmetic, and for the difference between mm along the plan and along the drawing, mm. */
const SLACK_MM = 0.02;

/** Max distance of the carriage from the drawing while the pen is down: rounding, merged blocks, steps and shaping; mm. */
export function maxOffDrawingMm(
  motion: MotionSettings,
  { springs, stepsPerMm }: Pick<MachineProfile, "springs" | "stepsPerMm">,
): number {
  const ownCornersMm = Object.values(motion.layers ?? {}).map(({ cornerMm }) => cornerMm ?? 0);
  const roundedMm = Math.max(motion.draw.cornerMm, ...ownCornersMm) + ROUNDED_STEPS / stepsPerMm;
  return roundedMm + (motion.fit?.toleranceMm ?? 0) + maxShapingErrorMm(motion, springs ?? null) + SLACK_MM;
}

interface Point {
  readonly x: number;
  readonly y: number;
}

const HOME: Point = { x: 0, y: 0 };

/** The carriage and the pen, as the board reports them. */
export interface ReportedPen extends Point {
  readonly up: boolean;
}

/** How the carriage may have moved after the received position. */
export interface MotionSince {
  /** How far, mm, including travel. */
  readonly aheadMm: number;
  /** Max distance of the carriage from the drawing (`maxOffDrawingMm`). */
  readonly nearMm: number;
  /** Strokes before which it goes home. */
  readonly stops?: readonly number[];
  /** How far before a stroke the pen may begin to come down (`lowerAheadMm`). */
  readonly lowerAheadMm?: number;
}

/** The first position from `received` on that fits the pen; if everything is drawn, the end. Null if there is none. */
export function reportedPosition(
  strokes: StrokeSet,
  received: StrokePosition,
  pen: ReportedPen,
  { aheadMm, nearMm, stops = [], lowerAheadMm = 0 }: MotionSince,
): StrokePosition | null {
  const count = strokes.offsets.length - 1;
  const startOf = (stroke: number): Point => pointAt(strokes, { stroke, alongMm: 0 });
  const endOf = (stroke: number): Point => pointAt(strokes, { stroke, alongMm: Infinity });
  const goesHomeBefore = (stroke: number): boolean => stroke === count || stops.includes(stroke);
  const isBetween = (from: Point, to: Point): boolean => awayFromLine(from, to, pen) <= nearMm;

  // mm and positions along the plan differ slightly from those along the drawing.
  let fromMm = received.alongMm - 2 * nearMm;
  // On its way to the stroke. At the end of the stroke before, the pen may still be down.
  const start = { stroke: received.stroke, alongMm: 0 };
  const cameFromHome = received.stroke === 0 || goesHomeBefore(received.stroke);
  const cameFrom = cameFromHome ? HOME : endOf(received.stroke - 1);
  if (fromMm < 0 && isBetween(cameFrom, pointAt(strokes, start))) return start;

  let leftMm = received.alongMm + aheadMm;
  for (let stroke = received.stroke; stroke < count && leftMm > 0; stroke++) {
    const lengthMm = strokeLengthMm(strokes, stroke);
    const isPossible = (mm: number): boolean => mm >= fromMm && mm <= leftMm;
    const pass = passesOf(pointsOf(strokes, stroke), pen.x, pen.y).find(
      ({ alongMm, awayMm }) => awayMm <= nearMm && isPossible(alongMm),
    );
    const onStroke = pass ? { stroke, alongMm: pass.alongMm } : null;
    const mayBeLowering = !pen.up && fromMm < 0;
    if (mayBeLowering && isLoweringBefore(strokes, stroke, pen, { lowerAheadMm, nearMm, onStroke })) {
      return { stroke, alongMm: 0 };
    }
    // A pen that is up at the end of a stroke was lifted to travel on.
    if (onStroke && !(pen.up && onStroke.alongMm >= lengthMm - END_MM)) return onStroke;
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
 * @param onStroke where on the stroke the carriage may be instead, if anywhere
 */
function isLoweringBefore(
  strokes: StrokeSet,
  stroke: number,
  pen: ReportedPen,
  {
    lowerAheadMm,
    nearMm,
    onStroke,
  }: { lowerAheadMm: number; nearMm: number; onStroke: StrokePosition | null },
): boolean {
  const start = pointAt(strokes, { stroke, alongMm: 0 });
  const awayMm = distance(start, pen);
  const before = stroke === 0 ? null : pointAt(strokes, { stroke: stroke - 1, alongMm: Infinity });
  const travelMm = before ? awayFromLine(before, start, pen) : Infinity;
  if (awayMm > LOWERING_MM) return awayMm <= lowerAheadMm && travelMm <= nearMm;
  if (!onStroke) return true;
  return travelMm <= distance(pointAt(strokes, onStroke), pen) + STEP_MM;
}

const distance = (a: Point, b: Point): number => Math.hypot(a.x - b.x, a.y - b.y);

/** A straight line passes each point once. */
const awayFromLine = (from: Point, to: Point, { x, y }: Point): number =>
  passesOf([from.x, from.y, to.x, to.y], x, y)[0].awayMm;
