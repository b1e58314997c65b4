/**
 * How far a shaped pen leaves its line on a machine that swings 10 % slower or faster than it was measured. Where corners
 * come in the rhythm of the swing, what the shaper leaves adds up from corner to corner.
 */
import type { Springs } from "../../machines/profile.js";
import { DEFAULT_MOTION } from "../../settings/motion.js";
import type { BlockColumns } from "../block-columns.js";
import type { RunLimits } from "../limits.js";
import { SpringAxis } from "./spring-axis.js";

const FACTORS = [0.9, 1.1];
/**
 * The limit, as a multiple of how far the default's acceleration bends the softer axis: the least with which smooth curves
 * keep their speed, see docs/motion.md.
 */
const BENDS = 1.6;
/** A rhythm needs some periods: shorter runs are not looked at. */
const PERIODS = 4;
/** At rest the pen has no direction, mm/s. */
const SLOWEST = 1;

/** The default's acceleration, at which nothing is slowed any more, mm/s². */
export const CALM_ACCEL = DEFAULT_MOTION.draw.accelMmPerS2;

export class WrongSprings {
  private readonly limitMm: number;
  private readonly shortestS: number;

  constructor(private readonly springs: Springs) {
    const softHz = Math.min(springs.xHz, springs.yHz);
    this.limitMm = (BENDS * CALM_ACCEL) / (2 * Math.PI * softHz) ** 2;
    this.shortestS = PERIODS / softHz;
  }

  /**
   * How far wrong springs move the pen across the line of a shaped run, as a share of the limit: the blocks from `first`
   * on, in the stretched frame of these limits.
   */
  sway(blocks: BlockColumns, first: number, { stretchX, stretchY }: RunLimits): number {
    const { count, clockS, startS, durationS, vx, vy, ax, ay } = blocks;
    if (first === count || clockS - startS[first] < this.shortestS) return 0;
    const right = this.axes(1);
    let maxMm = 0;
    const wrong = FACTORS.map((factor) => this.axes(factor));
    for (let k = first; k < count; k++) {
      const dt = durationS[k];
      const [accelX, accelY] = [ax[k] / stretchX, ay[k] / stretchY];
      right.x.advance(dt, accelX);
      right.y.advance(dt, accelY);
      const endVx = vx[k] / stretchX + dt * accelX;
      const endVy = vy[k] / stretchY + dt * accelY;
      const speed = Math.sqrt(endVx * endVx + endVy * endVy);
      for (const { x, y } of wrong) {
        x.advance(dt, accelX);
        y.advance(dt, accelY);
        if (speed < SLOWEST) continue;
        const across = ((x.d - right.x.d) * endVy - (y.d - right.y.d) * endVx) / speed;
        maxMm = Math.max(maxMm, Math.abs(across));
      }
    }
    return maxMm / this.limitMm;
  }

  private axes(factor: number): { readonly x: SpringAxis; readonly y: SpringAxis } {
    const { xHz, yHz, damping } = this.springs;
    return { x: new SpringAxis(factor * xHz, damping), y: new SpringAxis(factor * yHz, damping) };
  }
}
