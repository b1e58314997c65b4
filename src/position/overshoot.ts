/**
 * How far the pen of a swinging machine draws after its motors stopped at once. The pen is still on the paper, and
 * swings up to v/ω further (0.9 mm at 85 mm/s and 15 Hz).
 *
 *   drawing  ━━━━━━━━━━━━o━━━━━━━━>┊              o  where the pen was when the motors stopped
 *                        place     result         >  where it turns back, or leaves the line at a corner
 *
 * Resume from there, or the overshoot is drawn twice. The lift is ignored: a pen turns back after a quarter of a swing,
 * 10 to 25 ms, and a servo needs longer to clear the paper.
 */
import type { StrokeSet } from "../drawing/stroke-set.js";
import type { Springs } from "../machines/profile.js";
import { SpringAxis } from "../plan/shaping/spring-axis.js";
import {
  blockState,
  drawnAt,
  newMotionState,
  stateAt,
  type StrokePosition,
  type Trajectory,
} from "../plan/trajectory.js";
import { nearestOnStroke } from "./on-drawing.js";

const STEP_S = 0.0002;
/** A pen farther from the line than this does not draw it, mm. */
const NEAR_MM = 0.08;

/** A sudden stop of the motors. */
export interface SuddenStop {
  /** When, in time of the trajectory. */
  readonly planS: number;
  /** The place that the pen was drawing. */
  readonly place: StrokePosition;
  /** Where the carriage stopped, mm. Whole steps put it beside the trajectory. */
  readonly x: number;
  readonly y: number;
}

export function overshotPosition(
  strokes: StrokeSet,
  trajectory: Trajectory,
  { planS, place, x: stopX, y: stopY }: SuddenStop,
  springs: Springs,
): StrokePosition {
  const carriage = stateAt(trajectory, planS);
  if (carriage.stroke !== place.stroke) return place;
  const [axisX, axisY] = swingAt(trajectory, planS, springs);
  axisX.d += carriage.x - stopX;
  axisY.d += carriage.y - stopY;
  axisX.rate += carriage.vx;
  axisY.rate += carriage.vy;
  const untilS = 1 / (2 * Math.min(springs.xHz, springs.yHz));
  let [now, furthest] = [place, place];
  for (let s = 0; s < untilS; s += STEP_S) {
    axisX.advance(STEP_S, 0);
    axisY.advance(STEP_S, 0);
    const pen = { x: stopX + axisX.d, y: stopY + axisY.d };
    // At a corner the nearest place may pass from one side to the next, each up to NEAR_MM away.
    const reachMm = STEP_S * Math.hypot(axisX.rate, axisY.rate) + 2 * NEAR_MM;
    const nearest = nearestOnStroke(strokes, now, pen, reachMm);
    if (!nearest || nearest.awayMm > NEAR_MM) break;
    now = nearest.place;
    if (now.alongMm > furthest.alongMm) furthest = now;
  }
  return furthest;
}

/** The pen's swing about the carriage at an instant of a run. */
function swingAt(
  trajectory: Trajectory,
  planS: number,
  { xHz, yHz, damping }: Springs,
): readonly [SpringAxis, SpringAxis] {
  const { runs, startS, durationS } = trajectory;
  let run = 0;
  while (run + 1 < runs.count && runs.startS[run + 1] <= planS) run++;
  const axisX = new SpringAxis(xHz, damping);
  const axisY = new SpringAxis(yHz, damping);
  const first = runs.firstBlock[run];
  // A trajectory that brings the pen to rest begins in motion. If it is shaped, the pen is where the planned motion was
  // one mean delay earlier.
  const carriage = blockState(trajectory, first, 0, newMotionState());
  const pen = drawnAt(trajectory, startS[first]);
  axisX.d = pen.x - carriage.x;
  axisY.d = pen.y - carriage.y;
  axisX.rate = pen.vx - carriage.vx;
  axisY.rate = pen.vy - carriage.vy;
  for (let k = first; k < runs.firstBlock[run + 1] && startS[k] < planS; k++) {
    const s = Math.min(durationS[k], planS - startS[k]);
    axisX.advance(s, trajectory.ax[k]);
    axisY.advance(s, trajectory.ay[k]);
  }
  return [axisX, axisY];
}
