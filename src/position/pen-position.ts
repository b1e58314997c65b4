/**
 * Where was the pen? A plot that stops has to go on from there: what is left out is missing on the paper, what is drawn
 * twice is only darker. So each answer is a position in the drawing before which everything is certainly drawn. What is
 * known decides which function gives it:
 *
 *   case       what happened                what is known                             function
 *   ---------  ---------------------------  ----------------------------------------  ------------------------------
 *   estimated  the connection or the        the plan's time up to which the board     estimatedPosition, below
 *              carriage's position is lost  has acknowledged its commands
 *   stopped    an emergency stop: the       the carriage's position, and between      stoppedPosition, below
 *              board forgets its queue      which times of the plan it stopped
 *   reported   the board played its queue,  the carriage's position, whether the pen  reportedPosition (reported.ts)
 *              and is connected again       is down, and an estimate in the journal
 *
 * A pause needs no answer: comeToRest (src/plan) plans where the pen comes to rest.
 *
 * The position of the carriage alone is ambiguous, because a line may pass the same point several times. So all cases look
 * for the passes of the point (src/geometry/passes.ts), on the plan or on a stroke, and choose one: the nearest to what
 * is expected, or the first that is possible.
 */
import type { StrokeSet } from "../drawing/stroke-set.js";
import type { Springs } from "../machines/profile.js";
import { drawnAt, stateAt, type StrokePosition, type Trajectory } from "../plan/trajectory.js";
import { nearestOnStroke } from "./on-drawing.js";
import { nextPosition, passOf, type PlanPass, type PlanSpan } from "./on-plan.js";
import { overshotPosition } from "./overshoot.js";

/** Max difference between mm along the plan and mm along the drawing, where the plan rounds a corner. */
const CORNER_MM = 0.5;
/** A carriage farther from the plan than this did not follow it: the machine refused or missed commands. */
const BESIDE_MM = 0.1;

interface Point {
  readonly x: number;
  readonly y: number;
}

/** The position being drawn at a time of a plan; between strokes, the next one to be drawn. Null: nothing is left. */
export function estimatedPosition(trajectory: Trajectory, planS: number): StrokePosition | null {
  const { stroke, alongMm } = stateAt(trajectory, planS);
  return stroke >= 0 ? { stroke, alongMm } : nextPosition(trajectory, planS);
}

/** The same for a known point of the carriage: within a stroke, the position nearest to the pen. */
export function drawnPosition(
  strokes: StrokeSet,
  trajectory: Trajectory,
  planS: number,
  { x, y }: Point,
): StrokePosition | null {
  const state = drawnAt(trajectory, planS);
  const { stroke, alongMm } = state;
  if (stroke < 0) return nextPosition(trajectory, planS);
  const place = { stroke, alongMm };
  // At the beginning there is no corner before it.
  if (alongMm === 0) return place;
  // In a shaped motion the carriage leaves the line, to keep the pen on it.
  const pen = trajectory.planned ? state : { x, y };
  const heading = { x: state.vx, y: state.vy };
  return nearestOnStroke(strokes, place, pen, CORNER_MM, heading)?.place ?? place;
}

/** Where a sudden stop left the pen; `pass`: when the carriage is there by the plan. */
export interface StoppedPosition<S extends PlanSpan> {
  readonly pass: PlanPass<S>;
  /** Null: nothing is left of that plan. */
  readonly place: StrokePosition | null;
}

/**
 * The position of a sudden stop of the motors with the carriage at `at`, in one of these parts of the plan. Null without
 * one. A pen that swings draws on past the stop.
 */
export function stoppedPosition<S extends PlanSpan>(
  strokes: StrokeSet,
  spans: readonly S[],
  at: Point,
  springs: Springs | null,
): StoppedPosition<S> | null {
  const pass = passOf(spans, at);
  if (!pass) return null;
  const { span, planS, awayMm } = pass;
  const { trajectory } = span;
  // Everything before the span is drawn, but not by a carriage that is elsewhere.
  const isBeside = awayMm > BESIDE_MM;
  const place = drawnPosition(strokes, trajectory, planS, isBeside ? stateAt(trajectory, planS) : at);
  if (!place || !springs || isBeside) return { pass, place };
  return { pass, place: overshotPosition(strokes, trajectory, { planS, place, ...at }, springs) };
}
