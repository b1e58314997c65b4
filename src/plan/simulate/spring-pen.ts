/** The pen at the end of a swinging gantry: each axis is a spring between the carriage and the pen (spring-axis.ts). */
import type { Springs } from "../../machines/profile.js";
import { SpringAxis } from "../shaping/spring-axis.js";
import { blockState, newMotionState, type Trajectory } from "../trajectory.js";

export interface PenPoint {
  readonly tS: number;
  readonly x: number;
  readonly y: number;
  /** −1 unless the pen is down. */
  readonly stroke: number;
  /** mm along the stroke, from the plan. */
  readonly alongMm: number;
}

/**
 * Calls `onPoint` about every `stepS` seconds of motion, and after each wait. Jerk is approximated by steps of
 * acceleration.
 */
export function swingPen(
  trajectory: Trajectory,
  { xHz, yHz, damping }: Springs,
  stepS: number,
  onPoint: (pen: PenPoint) => void,
): void {
  const axisX = new SpringAxis(xHz, damping);
  const axisY = new SpringAxis(yHz, damping);
  const state = newMotionState();
  const { runs, startS, durationS, ax, ay, jx, jy } = trajectory;
  let [lastVx, lastVy] = [0, 0];
  let tS = 0;
  const waitUntil = (untilS: number): void => {
    axisX.rate += lastVx;
    axisY.rate += lastVy;
    lastVx = lastVy = 0;
    axisX.advance(untilS - tS, 0);
    axisY.advance(untilS - tS, 0);
    tS = untilS;
    onPoint({ tS, x: state.x + axisX.d, y: state.y + axisY.d, stroke: -1, alongMm: 0 });
  };
  for (let run = 0; run < runs.count; run++) {
    for (let k = runs.firstBlock[run]; k < runs.firstBlock[run + 1]; k++) {
      if (startS[k] > tS) waitUntil(startS[k]);
      const steps = Math.max(1, Math.ceil(durationS[k] / stepS));
      const dt = durationS[k] / steps;
      blockState(trajectory, k, 0, state);
      axisX.rate += lastVx - state.vx;
      axisY.rate += lastVy - state.vy;
      for (let i = 1; i <= steps; i++) {
        const middle = (i - 0.5) * dt;
        axisX.advance(dt, ax[k] + (jx ? middle * jx[k] : 0));
        axisY.advance(dt, ay[k] + (jy ? middle * jy[k] : 0));
        blockState(trajectory, k, i * dt, state);
        tS = startS[k] + i * dt;
        const { alongMm } = state;
        onPoint({ tS, x: state.x + axisX.d, y: state.y + axisY.d, stroke: runs.stroke[run], alongMm });
      }
      [lastVx, lastVy] = [state.vx, state.vy];
    }
  }
}
