import type { Place, Trajectory } from "./trajectory.js";

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
    let low = runs.firstBlock[run];
    let high = runs.firstBlock[run + 1];
    if (low === high) return runs.startS[run];
    const lastBlock = high - 1;
    while (high - low > 1) {
      const middle = (low + high) >> 1;
      if (alongMm[middle] <= place.alongMm) low = middle;
      else high = middle;
    }
    const spanMm = low < lastBlock ? alongMm[low + 1] - alongMm[low] : 0;
    const share = spanMm > 0 ? Math.min(1, Math.max(0, (place.alongMm - alongMm[low]) / spanMm)) : 0;
    return startS[low] + share * durationS[low];
  }
}
