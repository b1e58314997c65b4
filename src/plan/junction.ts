/** Mode `junction`: vertices passed at a corner speed, straight segments between; the fastest to plan. */
import type { BlockColumns } from "./block-columns.js";
import { limitJunctions } from "./corner.js";
import { capSegments, type RunLimits } from "./limits.js";
import { lookAhead } from "./look-ahead.js";
import type { RunPath } from "./run-path.js";
import { writeTrapezoids } from "./trapezoid.js";

/** Writes one run from rest to rest. */
export function writeJunctionRun(path: RunPath, limits: RunLimits, out: BlockColumns): void {
  capSegments(path, limits);
  limitJunctions(path, limits.accel, limits.corner);
  lookAhead(path.v2, path.length, path.segmentCount, limits.accel);
  writeTrapezoids(path, limits.accel, out);
}
