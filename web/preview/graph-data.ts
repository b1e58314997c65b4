/** Speed and acceleration over time, sampled for a graph of a given width. */
import { stateAt, type Trajectory } from "../../src/index.js";

interface GraphData {
  readonly tS: Float64Array;
  readonly speedMmPerS: Float64Array;
  readonly accelMmPerS2: Float64Array;
}

/** A point of the graph shows the maximum of this many samples, so that peaks are not lost. */
const SAMPLES_PER_POINT = 4;

/** `count` points from `fromS` to `toS`. O(count log blocks). */
export const graphData = (trajectory: Trajectory, fromS: number, toS: number, count: number): GraphData => {
  const tS = new Float64Array(count);
  const speedMmPerS = new Float64Array(count);
  const accelMmPerS2 = new Float64Array(count);
  const state = stateAt(trajectory, fromS);
  const step = (toS - fromS) / Math.max(1, count - 1);
  for (let i = 0; i < count; i++) {
    tS[i] = fromS + i * step;
    for (let k = 0; k < SAMPLES_PER_POINT; k++) {
      stateAt(trajectory, Math.min(toS, tS[i] + (k / SAMPLES_PER_POINT) * step), state);
      speedMmPerS[i] = Math.max(speedMmPerS[i], Math.hypot(state.vx, state.vy));
      accelMmPerS2[i] = Math.max(accelMmPerS2[i], Math.hypot(state.ax, state.ay));
    }
  }
  return { tS, speedMmPerS, accelMmPerS2 };
};
