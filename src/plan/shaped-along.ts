/**
 * Where on the drawing a shaped motion is: where the planned motion was, one mean delay ago. The carriage itself
 * leaves the line (it has to, to keep the pen on it), so its own place is no measure for that.
 */
import { blockAlong, type Trajectory } from "./trajectory.js";

/** Sets `alongMm` of every block. */
export function fillAlong(shaped: Trajectory, planned: Trajectory, delayS: number): void {
  const { runs, startS, alongMm } = shaped;
  for (let run = 0; run < runs.count; run++) {
    let k = planned.runs.firstBlock[run];
    const last = planned.runs.firstBlock[run + 1] - 1;
    for (let i = runs.firstBlock[run]; i < runs.firstBlock[run + 1]; i++) {
      const tS = startS[i] - delayS;
      while (k < last && planned.startS[k + 1] <= tS) k++;
      alongMm[i] = blockAlong(planned, k, Math.min(planned.durationS[k], tS - planned.startS[k]));
    }
  }
}
