/**
 * The pen at the end of a swinging gantry: each axis is a spring of natural frequency f and damping ratio ζ
 * between the carriage u and the pen x.
 *
 *   x″ = ω² (u − x) + 2ζω (u′ − x′)      ω = 2πf
 *
 * While u has constant acceleration a, the difference d = x − u obeys d″ + 2ζω d′ + ω² d = −a, which has an exact
 * solution: a decaying swing around −a/ω². When the carriage's velocity jumps, d′ jumps by the opposite amount.
 */
import type { Springs } from "../../machines/profile.js";
import { blockState, newMotionState, type Trajectory } from "../trajectory.js";

/** The swing of one axis. */
export class SpringAxis {
  /** x − u, mm, and its rate of change, mm/s. */
  d = 0;
  rate = 0;
  private readonly omega: number;
  private readonly decay: number;
  private readonly swing: number;

  constructor(hz: number, damping: number) {
    this.omega = 2 * Math.PI * hz;
    this.decay = damping * this.omega;
    this.swing = this.omega * Math.sqrt(1 - damping * damping);
  }

  /** Advances by `t` seconds, under constant acceleration of the carriage. */
  advance(t: number, accel: number): void {
    const centre = -accel / (this.omega * this.omega);
    const from = this.d - centre;
    const other = (this.rate + this.decay * from) / this.swing;
    const left = Math.exp(-this.decay * t);
    const [sin, cos] = [Math.sin(this.swing * t), Math.cos(this.swing * t)];
    const d = left * (from * cos + other * sin);
    this.rate = -this.decay * d + left * this.swing * (other * cos - from * sin);
    this.d = centre + d;
  }
}

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
