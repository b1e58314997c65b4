/** The place in the drawing at a given time of a plan, and the time of a place. */
import { firstWhere } from "../geometry/binary-search.js";
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

/** Finds the time of a place in a trajectory, fast enough for frequent progress reports. */
export class PlaceTimes {
  private readonly runOfStroke = new Map<number, number>();

  constructor(private readonly trajectory: Trajectory) {
    const { runs } = trajectory;
    for (let run = 0; run < runs.count; run++) {
      if (runs.stroke[run] >= 0) this.runOfStroke.set(runs.stroke[run], run);
    }
  }

  /** Seconds from a place to the end; 0 if this trajectory does not draw the stroke. */
  leftFrom(place: Place): number {
    const atS = this.timeOf(place);
    return atS === null ? 0 : this.trajectory.totalS - atS;
  }

  /** The time at which the pen is at a place, s; null if this trajectory does not draw the stroke. */
  timeOf(place: Place): number | null {
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
