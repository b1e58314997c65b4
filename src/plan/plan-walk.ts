/** A walk along a planned run beside a moving pen: where on the line it is nearest, and how far from it that is. */
import type { FitSource } from "./fit-source.js";

/** A place is found when the next step to it would be less than this, s: on so short a way the line hardly bends. */
const FOUND_S = 1e-3;

/** From one look to the next the walk goes on by at most so many times the pen's time. */
const FARTHEST = 4;

export class PlanWalk {
  /** Where the pen is, mm, and where on the plan the walk is: at the instant τ, in block k. */
  x = 0;
  y = 0;
  k = 0;
  tau = 0;
  /** Distance to the left of the line, mm, in the middle and at the end of the piece followed last. */
  middle = 0;
  end = 0;

  /** @param most how far from the line the pen may be, mm */
  constructor(
    private readonly source: FitSource,
    private readonly most: number,
  ) {}

  /**
   * Follows piece j, of `h[j]` seconds, at the end of which velocity j has become velocity j + 1, with 2 `half` looks at it, from
   * where pen and walk are. False where that is not the way of the plan, or too far from it.
   */
  follow(j: number, h: Float64Array, vx: Float64Array, vy: Float64Array, half: number): boolean {
    const { x, y, most } = this;
    const d = h[j]!;
    const vx0 = vx[j]!;
    const vy0 = vy[j]!;
    const ax = (vx[j + 1]! - vx0) / d;
    const ay = (vy[j + 1]! - vy0) / d;
    const { blocks } = this.source;
    const { startS, clockS } = blocks;
    const last = blocks.count - 1;
    const dt = d / (2 * half);
    const most2 = most * most;
    let { k, tau } = this;
    for (let look = 1; look <= 2 * half; look++) {
      const u = look * dt;
      const px = x + u * (vx0 + (u * ax) / 2);
      const py = y + u * (vy0 + (u * ay) / 2);
      const before = tau;
      tau += dt;
      let v2 = 0;
      let left = 0;
      let isFar = false;
      // Where it would be by its own clock, and once more where the line is nearest to that.
      for (let twice = false; ; twice = true) {
        if (tau > clockS) tau = clockS;
        while (k < last && startS[k + 1]! <= tau) k++;
        while (k > 0 && startS[k]! > tau) k--;
        const t = tau - startS[k]!;
        const wx = blocks.vx[k]! + t * blocks.ax[k]!;
        const wy = blocks.vy[k]! + t * blocks.ay[k]!;
        const dx = px - blocks.x[k]! - (t * (blocks.vx[k]! + wx)) / 2;
        const dy = py - blocks.y[k]! - (t * (blocks.vy[k]! + wy)) / 2;
        v2 = wx * wx + wy * wy;
        left = wx * dy - wy * dx;
        if (twice || !(v2 > 0)) {
          const d2 = dx * dx + dy * dy;
          isFar = !(d2 <= most2) && !(d2 <= 1.2 * most2 && left * left <= most2 * v2);
          break;
        }
        const step = (dx * wx + dy * wy) / v2;
        tau += step;
        if (step < FOUND_S && step > -FOUND_S) {
          isFar = !(left * left <= most2 * v2);
          break;
        }
      }
      if (isFar || !(tau >= before && tau - before <= FARTHEST * dt)) return false;
      if (look === half) this.middle = v2 > 0 ? left / Math.sqrt(v2) : 0;
      else if (look === 2 * half) this.end = v2 > 0 ? left / Math.sqrt(v2) : 0;
    }
    this.k = k;
    this.tau = tau;
    this.x = x + (d * (vx0 + vx[j + 1]!)) / 2;
    this.y = y + (d * (vy0 + vy[j + 1]!)) / 2;
    return true;
  }
}
