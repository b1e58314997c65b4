/** The place in the drawing at a given time of a plan. */
import { SAME_TIME_S, stateAt, type Place, type Trajectory } from "./trajectory.js";

/** The first place still to be drawn at `planS`, where the carriage is at rest; null if everything is drawn. */
export function nextPlace(trajectory: Trajectory, planS: number): Place | null {
  const { runs } = trajectory;
  for (let run = 0; run < runs.count; run++) {
    if (runs.stroke[run] < 0 || runs.startS[run] < planS - SAME_TIME_S) continue;
    const block = runs.firstBlock[run];
    const isDot = runs.firstBlock[run + 1] === block;
    return { stroke: runs.stroke[run], alongMm: isDot ? 0 : trajectory.alongMm[block] };
  }
  return null;
}

/** The place being drawn at `planS`; between strokes, the next one to be drawn. */
export function placeAt(trajectory: Trajectory, planS: number): Place | null {
  const state = stateAt(trajectory, planS);
  return state.stroke >= 0 ? { stroke: state.stroke, alongMm: state.alongMm } : nextPlace(trajectory, planS);
}
