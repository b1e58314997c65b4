/** Mode `junction`: straight segments, with a corner speed at each vertex. The fastest mode to plan. */
import type { BlockColumns } from "./block-columns.js";
import { limitJunctions } from "./corner.js";
import { capSegments, type RunLimits } from "./limits.js";
import { lookAhead } from "./look-ahead.js";
import type { RunPath } from "./run-path.js";
import { newStraight, writeStraight } from "./trapezoid.js";

/** Writes one run from rest to rest. */
export function writeJunctionRun(path: RunPath, limits: RunLimits, out: BlockColumns): void {
  const { segmentCount: n, x, y, ux, uy, length, v2, cap2 } = path;
  capSegments(path, limits);
  limitJunctions(path, limits.accel, limits.corner);
  lookAhead(v2, length, n, limits.accel);
  const straight = newStraight();
  straight.alongMm = path.startAlong;
  for (let i = 0; i < n; i++) {
    straight.x = x[i]!;
    straight.y = y[i]!;
    straight.ux = ux[i]!;
    straight.uy = uy[i]!;
    straight.length = length[i]!;
    straight.v0 = Math.sqrt(v2[i]);
    straight.v1 = Math.sqrt(v2[i + 1]);
    straight.cap2 = cap2[i]!;
    writeStraight(straight, limits.accel, out);
    straight.alongMm += length[i];
  }
}
