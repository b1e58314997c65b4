/** A walk along a planned run beside a moving pen: where on the line it is nearest, and how far from it that is. */
import type { FitSource } from "./fit-source.js";

/** A place is found when the next step to it would be less than this, s. */
const FOUND_S = 3e-4;

/** From one look to the next the walk goes on by at most so many times the pen's time. */
const FARTHEST = 4;

export class PlanWalk {
  /** Where on the plan it is: at the instant τ, in block k. */
  k = 0;
  tau = 0;
  /** Distance to the left of the line, mm, in the middle and at the end of the piece followed last. */
  middle = 0;
  end = 0;

  constructor(private readonly source: FitSource) {}

  /**
   * Follows a piece of `h` seconds from (x, y) at (vx, vy) under (ax, ay), with 2 `half` looks at it, from where the walk is.
   * False where that is not the way of the plan, or farther than `most` mm from it.
   */
  follow(
    x: number,
    y: number,
    vx: number,
    vy: number,
    ax: number,
    ay: number,
    h: number,
    half: number,
    most: number,
  ): boolean {
    const { blocks } = this.source;
    const { startS, clockS } = blocks;
    const last = blocks.count - 1;
    const dt = h / (2 * half);
    const most2 = most * most;
    let { k, tau } = this;
    for (let look = 1; look <= 2 * half; look++) {
      const u = look * dt;
      const px = x + u * (vx + (u * ax) / 2);
      const py = y + u * (vy + (u * ay) / 2);
      const before = tau;
      tau += dt;
      let d2 = 0;
      let v2 = 0;
      let left = 0;
      // Where it would be by its own clock, and once more where the line is nearest to that.
      for (let twice = false; ; twice = true) {
        if (tau > clockS) tau = clockS;
        while (k < last && startS[k + 1]! <= tau) k++;
        while (k > 0 && startS[k]! > tau) k--;
        const d = tau - startS[k]!;
        const wx = blocks.vx[k]! + d * blocks.ax[k]!;
        const wy = blocks.vy[k]! + d * blocks.ay[k]!;
        const dx = px - blocks.x[k]! - (d * (blocks.vx[k]! + wx)) / 2;
        const dy = py - blocks.y[k]! - (d * (blocks.vy[k]! + wy)) / 2;
        d2 = dx * dx + dy * dy;
        v2 = wx * wx + wy * wy;
        left = wx * dy - wy * dx;
        if (twice || !(v2 > 0)) break;
        const step = (dx * wx + dy * wy) / v2;
        tau += step;
        if (step < FOUND_S && step > -FOUND_S) break;
      }
      if (!(tau >= before && tau - before <= FARTHEST * dt)) return false;
      if (!(d2 <= most2) && !(d2 <= 1.2 * most2 && left * left <= most2 * v2)) return false;
      if (look === half) this.middle = v2 > 0 ? left / Math.sqrt(v2) : 0;
      else if (look === 2 * half) this.end = v2 > 0 ? left / Math.sqrt(v2) : 0;
    }
    this.k = k;
    this.tau = tau;
    return true;
  }
}
