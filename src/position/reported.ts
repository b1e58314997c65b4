/**
 * The position of a plot whose connection was lost, or whose program ended, while the board kept running. A board that
 * still has its step counters reports where the carriage is, and whether the pen is down.
 *
 *    received ────── may have been sent ──────┐    pen down: on a stroke
 *       o━━━━━━━━━━━━━━━━━━━━━━━━━━━━━━━━━━━━━┿╌╌  pen up: lifted on a stroke by a pause, travelling to the next stroke,
 *                            (x, y)                or going home, after the last stroke or before a change of pens
 *
 * A board draws everything that it has received, so it did not stop before `received`. From there on, the line may pass
 * its position several times. The first pass where the carriage can be counts: a part drawn twice does less harm than a
 * missing one, and no more is drawn twice than what may have been sent after `received`.
 */
import type { StrokeSet } from "../drawing/stroke-set.js";
import { passesOf, type Pass } from "../geometry/passes.js";
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
/** So short a piece is not seen if it is drawn twice, or left out at the end of a stroke; mm. */
const UNSEEN_MM = 0.05;

/** A received position is computed from times, so that of a stroke's start may be this far after it; mm. */
const AT_START_MM = 1e-6;

/** Rounding of a position to whole steps of both motors. */
const ROUNDED_STEPS = 2;
/** The same at the end of a command: half a step of each, √½ together. */
const ROUNDED_AT_END_STEPS = 0.71;
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

/** Max distance from a straight line of the drawing, away from its corners, at the end of a command; mm. */
export const maxOffLineMm = (
  motion: MotionSettings,
  { springs, stepsPerMm }: Pick<MachineProfile, "springs" | "stepsPerMm">,
): number => ROUNDED_AT_END_STEPS / stepsPerMm + maxShapingErrorMm(motion, springs ?? null);

interface Point {
  readonly x: number;
  readonly y: number;
}

const HOME: Point = { x: 0, y: 0 };

interface Travel {
  readonly from: Point;
  readonly to: Point;
}

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
  /** Max distance of the carriage from a straight line of the drawing, away from its corners (`maxOffLineMm`). */
  readonly offLineMm: number;
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
  since: MotionSince,
): StrokePosition | null {
  const { aheadMm, nearMm, offLineMm, stops = [] } = since;
  const count = strokes.offsets.length - 1;
  const startOf = (stroke: number): Point => pointAt(strokes, { stroke, alongMm: 0 });
  const endOf = (stroke: number): Point => pointAt(strokes, { stroke, alongMm: Infinity });
  const goesHomeBefore = (stroke: number): boolean =>
    stroke === 0 || stroke === count || stops.includes(stroke);
  const travelTo = (stroke: number): Travel => ({
    from: goesHomeBefore(stroke) ? HOME : endOf(stroke - 1),
    to: startOf(stroke),
  });

  // On its way to the stroke, at a stop by way of home. At the end of the stroke before, the pen may still be down.
  const isAtStart = received.alongMm < AT_START_MM;
  if (isAtStart) {
    const { stroke } = received;
    const ways = [travelTo(stroke)];
    if (stroke > 0 && stops.includes(stroke)) ways.push({ from: endOf(stroke - 1), to: HOME });
    const isOn = (way: Travel): boolean =>
      pen.up ? awayFromLine(way, pen) <= nearMm : distance(way.from, pen) <= offLineMm;
    if (ways.some(isOn)) return received;
  }

  // mm and positions along the plan differ slightly from those along the drawing.
  let fromMm = received.alongMm - 2 * nearMm;
  let leftMm = received.alongMm + aheadMm;
  for (let stroke = received.stroke; stroke < count && leftMm > 0; stroke++) {
    const lengthMm = strokeLengthMm(strokes, stroke);
    const passes = passesOf(pointsOf(strokes, stroke), pen.x, pen.y).filter(
      ({ alongMm, awayMm }) => awayMm <= nearMm && alongMm >= fromMm && alongMm <= leftMm,
    );
    const pass = firstPass(passes, since);
    const mayTravel = stroke > received.stroke || isAtStart;
    if (mayTravel && !pen.up && isLowering(travelTo(stroke), pen, pass, since)) return { stroke, alongMm: 0 };
    leftMm -= lengthMm;
    const next = stroke + 1;
    const travel = { from: endOf(stroke), to: goesHomeBefore(next) ? HOME : startOf(next) };
    const besideMm = awayFromLine(travel, pen);
    // A pen that is up at the end of a stroke, or on the line to the next one, was lifted to travel on.
    const isLeaving =
      pass !== null &&
      pen.up &&
      (pass.alongMm >= lengthMm - UNSEEN_MM || (besideMm <= offLineMm && pass.awayMm > offLineMm));
    if (pass && !isLeaving) return { stroke, alongMm: pass.alongMm };
    if (pen.up && distance(travel.from, pen) <= leftMm && besideMm <= nearMm) {
      return next === count ? { stroke, alongMm: lengthMm } : { stroke: next, alongMm: 0 };
    }
    leftMm -= distance(travel.from, travel.to);
    fromMm = -2 * nearMm;
  }
  return null;
}

/**
 * The first of these passes of a stroke; beside a corner, the side where the carriage is, and the first one in doubt. It
 * leaves a straight side only to round the corner. There, the side that it comes from or goes to is clearly nearer. Where
 * it is still far from the next side, a plot that resumed on that side would leave a gap between the two lines.
 *
 *   ━━━━━━━━━━━━━━━━━━━╮  a pass
 *              ━━━━━o━━╯  the next one: here is the carriage
 */
function firstPass(passes: readonly Pass[], { nearMm, offLineMm }: MotionSince): Pass | null {
  let found: Pass | null = null;
  for (const pass of passes) {
    if (found !== null) {
      // The side after the one on which the first pass ends; `at` and `until` count points from the stroke's start.
      const isNextSide = Math.ceil(pass.at) === Math.floor(found.until) + 2;
      const apartMm = pass.alongMm - found.alongMm;
      const isOnSide = pass.awayMm <= offLineMm && found.awayMm > offLineMm;
      const isNearer = pass.awayMm <= UNSEEN_MM && found.awayMm > pass.awayMm + 2 * offLineMm;
      const isRounding = apartMm <= 2 * nearMm && isNearer;
      if (!isNextSide || apartMm <= UNSEEN_MM || !(isOnSide || isRounding)) return found;
    }
    found = pass;
  }
  return found;
}

/**
 * Whether the pen is down while the carriage is still travelling to the stroke. A stroke may lead back along the travel:
 * then a position near its start may be on either, and the nearer of the two counts.
 *
 * @param pass where on the stroke the carriage may be instead, if anywhere
 */
function isLowering(
  travel: Travel,
  pen: ReportedPen,
  pass: Pass | null,
  { lowerAheadMm = 0, nearMm, offLineMm }: MotionSince,
): boolean {
  const [aheadMm, besideMm] = [distance(travel.to, pen), awayFromLine(travel, pen)];
  const mayBe = aheadMm <= LOWERING_MM || (aheadMm <= lowerAheadMm + nearMm && besideMm <= nearMm);
  return mayBe && (pass === null || besideMm <= pass.awayMm + offLineMm);
}

const distance = (a: Point, b: Point): number => Math.hypot(a.x - b.x, a.y - b.y);

/** Whether a point is at most `nearMm` from a straight way. */
export const isBetween = (from: Point, to: Point, point: Point, nearMm: number): boolean =>
  awayFromLine({ from, to }, point) <= nearMm;

/** A straight line passes each point once. */
const awayFromLine = ({ from, to }: Travel, { x, y }: Point): number =>
  passesOf([from.x, from.y, to.x, to.y], x, y)[0].awayMm;
