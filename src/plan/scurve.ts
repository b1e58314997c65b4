/**
 * Mode `scurve`: |j| ≤ J at every instant, acceleration continuous, in native constant-jerk blocks.
 *
 * Two ways, and each run takes the faster one:
 *
 *   third-order.ts   S-curves on the straights, third-order corners: for straight lines and sharp corners
 *   smooth.ts        a blend plan averaged over w = 2 A'/J seconds: for curves, where the averaging costs w once
 *
 * The average leaves the blend's line by up to A' w²/24 = A'³/6J². Half of δ is given to that and what is
 * left to the blend, so A' = min(A, ∛(3 J² δ)). As J grows, w falls to 0, A' is A, and the mode becomes `blend`.
 */
import { BlendPlanner } from "./blend.js";
import { BlockColumns } from "./block-columns.js";
import type { RunLimits } from "./limits.js";
import type { RunPath } from "./run-path.js";
import { Smoother } from "./smooth.js";
import { ThirdOrderPlanner } from "./third-order.js";

export class SCurvePlanner {
  private readonly thirdOrder = new ThirdOrderPlanner();
  private readonly blend = new BlendPlanner();
  private readonly blended = new BlockColumns(0, false);
  private readonly smoother = new Smoother();

  /** Writes one run from rest to rest; `out` has jerk columns. */
  write(path: RunPath, limits: RunLimits, out: BlockColumns): void {
    this.thirdOrder.prepare(path, limits);
    if (path.segmentCount === 1) return this.thirdOrder.write(path, limits, out);
    const accel = Math.min(limits.accel, Math.cbrt(3 * limits.jerk * limits.jerk * limits.corner));
    const window = (2 * accel) / limits.jerk;
    const corner = limits.corner - (accel * window * window) / 24;
    const { blended } = this;
    blended.clear();
    this.blend.write(path, { ...limits, accel, corner }, blended);
    const smoothedS = blended.clockS + window;
    if (this.thirdOrder.leastTime(path, limits) < smoothedS) {
      const { count, clockS } = out;
      this.thirdOrder.write(path, limits, out);
      if (out.clockS - clockS <= smoothedS) return;
      out.count = count;
      out.clockS = clockS;
    }
    this.smoother.write(blended, path.end(), window, out);
  }
}
