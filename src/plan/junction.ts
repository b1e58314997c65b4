/** Mode `junction`: vertices passed at a corner speed, straight segments between; the fastest to plan. */
import type { BlockColumns } from "./block-columns.js";
import { limitJunctions } from "./corner.js";
import { capSegments, type RunLimits } from "./limits.js";
import { lookAhead } from "./look-ahead.js";
import type { RunPath } from "./run-path.js";
import { writeStraight, type Straight } from "./straight.js";
import { writeTrapezoids } from "./trapezoid.js";

/** Writes one run from rest to rest. */
export function writeJunctionRun(path: RunPath, limits: RunLimits, out: BlockColumns): void {
  capSegments(path, limits);
  limitJunctions(path, limits.accel, limits.corner);
  lookAhead(path.v2, path.length, path.segmentCount, limits.accel);
  if (limits.floorS > 0) writeFloored(path, limits, out);
  else writeTrapezoids(path, limits.accel, out);
}

/** As `writeTrapezoids`, with no phase shorter than the floor where that can be helped. */
function writeFloored(path: RunPath, limits: RunLimits, out: BlockColumns): void {
  const { segmentCount: n, x, y, ux, uy, length, v2, cap2 } = path;
  const straight: Straight = { x: 0, y: 0, ux: 0, uy: 0, alongMm: path.startAlong, alongPerMm: 1, length: 0 };
  for (let i = 0; i < n; i++) {
    straight.x = x[i]!;
    straight.y = y[i]!;
    straight.ux = ux[i]!;
    straight.uy = uy[i]!;
    straight.length = length[i]!;
    const [v0, v1, most] = [Math.sqrt(v2[i]!), Math.sqrt(v2[i + 1]!), Math.sqrt(cap2[i]!)];
    writeStraight(straight, v0, v1, most, limits.accel, limits.floorS, out);
    straight.alongMm += length[i]!;
  }
}
