/**
 * During a shaped motion, the place on the drawing is where the planned motion was one mean delay earlier. It cannot
 * be measured along the carriage's path, because the carriage leaves the line so that the pen stays on it.
 */
import type { Trajectory } from "../trajectory.js";

/** Sets `alongMm` of every block; inside a planned block it is interpolated from the speeds at both ends. */
export function fillAlong(shaped: Trajectory, planned: Trajectory, delayS: number): void {
  const { runs, startS, alongMm } = shaped;
  const { durationS, vx, vy, ax, ay } = planned;
  for (let run = 0; run < runs.count; run++) {
    const first = planned.runs.firstBlock[run];
    const last = planned.runs.firstBlock[run + 1] - 1;
    let k = first - 1;
    let endS = -Infinity;
    let fromS = 0;
    let from = 0;
    let rate = 0;
    let change = 0;
    for (let i = runs.firstBlock[run]; i < runs.firstBlock[run + 1]; i++) {
      const tS = startS[i] - delayS;
      while (k < last && endS <= tS) {
        k++;
        fromS = planned.startS[k];
        endS = fromS + durationS[k];
        from = planned.alongMm[k];
        const d = durationS[k];
        const v0 = Math.sqrt(vx[k] * vx[k] + vy[k] * vy[k]);
        const x1 = vx[k] + d * ax[k];
        const y1 = vy[k] + d * ay[k];
        const v1 = Math.sqrt(x1 * x1 + y1 * y1);
        const span = k < last ? planned.alongMm[k + 1] - from : (d * (v0 + v1)) / 2;
        const perMm = v0 + v1 > 0 ? (2 * span) / ((v0 + v1) * d) : 0;
        rate = perMm * v0;
        change = (perMm * (v1 - v0)) / d;
      }
      const s = Math.min(endS, Math.max(fromS, tS)) - fromS;
      alongMm[i] = from + s * (rate + (s * change) / 2);
    }
  }
}
