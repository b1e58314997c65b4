/**
 * Axes with different limits of acceleration. The planner knows one limit, |a| ≤ A. So a run is planned in a
 * frame that is stretched along the weaker axis until both axes have the same limit:
 *
 *   x' = x A/Ax      y' = y A/Ay      A = max(Ax, Ay)
 *
 *   |a'| ≤ A   means   (ax/Ax)² + (ay/Ay)² ≤ 1        so |ax| ≤ Ax, |ay| ≤ Ay, |a| ≤ A
 *
 * Straight lines stay straight, so corners, merging and filters need no change. A point within δ of the line in
 * the frame is also within δ on paper, because the frame never shortens a distance. Speed limits apply in the
 * machine's frame; `capSegments` converts them for each direction.
 */
import type { BlockColumns } from "./block-columns.js";
import type { RunLimits } from "./limits.js";
import { RunPath } from "./run-path.js";

export class AxisFrame {
  private readonly stretched = new RunPath();
  private stretchX = 1;
  private stretchY = 1;

  /** The path in the stretched frame. Valid until the next call. */
  of(path: RunPath, { stretchX, stretchY }: RunLimits): RunPath {
    const { stretched } = this;
    this.stretchX = stretchX;
    this.stretchY = stretchY;
    stretched.copyLayout(path);
    for (let i = 0; i <= path.segmentCount; i++) {
      stretched.x[i] = path.x[i] * stretchX;
      stretched.y[i] = path.y[i] * stretchY;
    }
    stretched.measure();
    return stretched;
  }

  /** Converts the blocks from `first` on, planned on the path of the last `of`, to the machine's frame. */
  restore(blocks: BlockColumns, first: number): void {
    const { stretchX, stretchY } = this;
    const { x, y, vx, vy, ax, ay, jx, jy } = blocks;
    for (let k = first; k < blocks.count; k++) {
      x[k] /= stretchX;
      y[k] /= stretchY;
      vx[k] /= stretchX;
      vy[k] /= stretchY;
      ax[k] /= stretchX;
      ay[k] /= stretchY;
      if (jx !== null && jy !== null) {
        jx[k] /= stretchX;
        jy[k] /= stretchY;
      }
    }
  }
}
