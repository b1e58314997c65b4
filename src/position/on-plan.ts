/** Positions and times of a plan: what is drawn at a time, when a position is drawn, when the carriage is at a point. */
import type { StrokeSet } from "../drawing/stroke-set.js";
import { firstWhere } from "../geometry/binary-search.js";
import { likeliestPass, passesOf } from "../geometry/passes.js";
import {
  newMotionState,
  SAME_TIME_S,
  stateAt,
  type StrokePosition,
  type Trajectory,
} from "../plan/trajectory.js";
import { strokeLengthMm } from "./on-drawing.js";

/** The first place still to be drawn at `planS`, where the carriage is at rest; null if everything is drawn. */
export function nextPosition(trajectory: Trajectory, planS: number): StrokePosition | null {
  const { runs } = trajectory;
  for (let run = 0; run < runs.count; run++) {
    if (runs.stroke[run] < 0 || runs.startS[run] < planS - SAME_TIME_S) continue;
    const block = runs.firstBlock[run];
    const isDot = runs.firstBlock[run + 1] === block;
    return { stroke: runs.stroke[run], alongMm: isDot ? 0 : trajectory.alongMm[block] };
  }
  return null;
}

/** The end of a plan's last stroke: for a stop when only the travel home is left. Null for a plan without strokes. */
export function endOfPlan(strokes: StrokeSet, { runs }: Trajectory): StrokePosition | null {
  const stroke = runs.stroke.reduce((last, one) => Math.max(last, one), -1);
  return stroke < 0 ? null : { stroke, alongMm: strokeLengthMm(strokes, stroke) };
}

/** Interval between the points of a plan that are compared with a point: the line between them bends by micrometres. */
const SAMPLE_S = 0.002;

/** A part of a plan in which the carriage was. Times in seconds along the plan. */
export interface PlanSpan {
  readonly trajectory: Trajectory;
  readonly fromS: number;
  readonly toS: number;
  /** When it was probably there. It may be before or after the span. */
  readonly estimateS: number;
}

/** When the carriage is at a point. */
export interface PlanPass<S extends PlanSpan = PlanSpan> {
  readonly span: S;
  readonly planS: number;
  /** The distance of the plan from the point, mm. */
  readonly awayMm: number;
}

/**
 * The time in one of these spans at which the carriage is nearest to a point. If there are several, because the path
 * crosses itself or the carriage rests there, the time nearest to the estimate. Null without a span.
 */
export function passOf<S extends PlanSpan>(
  spans: readonly S[],
  { x, y }: { readonly x: number; readonly y: number },
): PlanPass<S> | null {
  const state = newMotionState();
  const passes = spans.flatMap((span): PlanPass<S>[] => {
    const { trajectory, fromS, toS, estimateS } = span;
    const count = Math.max(1, Math.ceil((toS - fromS) / SAMPLE_S));
    const stepS = (toS - fromS) / count;
    const xy = new Float64Array(2 * (count + 1));
    for (let i = 0; i <= count; i++) {
      stateAt(trajectory, fromS + i * stepS, state);
      xy[2 * i] = state.x;
      xy[2 * i + 1] = state.y;
    }
    return passesOf(xy, x, y).map(({ at, until, awayMm }) => {
      const planS = Math.min(Math.max(fromS + at * stepS, estimateS), fromS + until * stepS);
      return { span, planS, awayMm };
    });
  });
  return likeliestPass(passes, ({ span, planS }) => Math.abs(planS - span.estimateS));
}

/** Finds the time of a place in a trajectory, fast enough for frequent progress reports. */
export class PositionTimes {
  private readonly runOfStroke = new Map<number, number>();

  constructor(private readonly trajectory: Trajectory) {
    const { runs } = trajectory;
    for (let run = 0; run < runs.count; run++) {
      if (runs.stroke[run] >= 0) this.runOfStroke.set(runs.stroke[run], run);
    }
  }

  /** Seconds from a place to the end; 0 if this trajectory does not draw the stroke. */
  leftFrom(place: StrokePosition): number {
    const atS = this.timeOf(place);
    return atS === null ? 0 : this.trajectory.totalS - atS;
  }

  /** The time at which the pen is at a place, s; null if this trajectory does not draw the stroke. */
  timeOf(place: StrokePosition): number | null {
    const run = this.runOfStroke.get(place.stroke);
    if (run === undefined) return null;
    const { alongMm, startS, durationS, runs } = this.trajectory;
    const [first, end] = [runs.firstBlock[run], runs.firstBlock[run + 1]];
    if (first === end) return runs.startS[run];
    const k = firstWhere(first + 1, end, (i) => alongMm[i] > place.alongMm) - 1;
    const spanMm = k + 1 < end ? alongMm[k + 1] - alongMm[k] : 0;
    const share = spanMm > 0 ? Math.min(1, Math.max(0, (place.alongMm - alongMm[k]) / spanMm)) : 0;
    return startS[k] + share * durationS[k];
  }
}
