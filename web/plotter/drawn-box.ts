/** The box of what will be drawn, mm from home, for "Trace the frame". */
import type { Trajectory } from "../../src/index.js";
import type { BoxMm } from "../../src/schema/index.js";

/**
 * The box around the ends of all blocks with the pen down. Exact for straight lines; for curves within the tolerance of
 * their flattening. A run ends where the next one begins. Null if there is nothing to draw.
 */
export const boxOfDrawn = ({ runs, x, y, blockCount, endX, endY }: Trajectory): BoxMm | null => {
  let [minX, minY, maxX, maxY] = [Infinity, Infinity, -Infinity, -Infinity];
  const take = (px: number, py: number): void => {
    minX = Math.min(minX, px);
    maxX = Math.max(maxX, px);
    minY = Math.min(minY, py);
    maxY = Math.max(maxY, py);
  };
  for (let r = 0; r < runs.count; r++) {
    if (runs.stroke[r] < 0) continue;
    for (let b = runs.firstBlock[r]; b <= runs.firstBlock[r + 1]; b++) {
      if (b < blockCount) take(x[b], y[b]);
      else take(endX, endY);
    }
  }
  return minX > maxX ? null : { xMm: minX, yMm: minY, widthMm: maxX - minX, heightMm: maxY - minY };
};
