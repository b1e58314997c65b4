/** Mode `junction`: straight segments, with a corner speed at each vertex. The fastest mode to plan. */
import type { BlockColumns } from "./block-columns.js";
import { limitJunctions } from "./corner.js";
import { capSegments, type RunLimits } from "./limits.js";
import type { RunPath } from "./run-path.js";
import { newStraight, writeStraight } from "./trapezoid.js";

/** Writes one run from rest to rest. */
export function writeJunctionRun(path: RunPath, limits: RunLimits, out: BlockColumns): void {
  const { segmentCount: n, x, y, ux, uy, length, drawn, v2, cap2 } = path;
  capSegments(path, limits);
  limitJunctions(path, limits.accel, limits.corner);
  lookAhead(v2, length, n, limits.accel);
  const straight = newStraight();
  straight.alongMm = path.startAlong;
  for (let i = 0; i < n; i++) {
    straight.x = x[i];
    straight.y = y[i];
    straight.ux = ux[i];
    straight.uy = uy[i];
    straight.length = length[i];
    straight.v0 = Math.sqrt(v2[i]);
    straight.v1 = Math.sqrt(v2[i + 1]);
    straight.cap2 = cap2[i];
    straight.alongPerMm = drawn[i] / length[i];
    writeStraight(straight, limits.accel, out);
    straight.alongMm += drawn[i];
  }
}

/**
 * Exact look-ahead: the highest speeds at the vertices under |a| ≤ A along the path.
 *
 * Method: v² changes by at most 2 A ℓ over a segment of length ℓ. A backward pass lowers each vertex so that
 * the pen can brake for what follows. A forward pass lowers it to what the pen can reach. Both lower a limit only
 * as far as necessary, so no other allowed profile is faster anywhere. Linear, no backtracking.
 *
 *   v2   in: max speed² at each vertex, (mm/s)²; out: the planned speed²
 *
 *   v² ^   limit ....      ....          backward:  v²ᵢ   ≤ v²ᵢ₊₁ + 2 A ℓᵢ
 *      |     ___:   :_____:   :          forward:   v²ᵢ₊₁ ≤ v²ᵢ   + 2 A ℓᵢ
 *      |    /   \  /      \             (straight lines over path length)
 *      +---------------------------> s
 */
function lookAhead(v2: Float64Array, length: Float64Array, segmentCount: number, accel: number): void {
  const twoA = 2 * accel;
  let next = v2[segmentCount];
  for (let i = segmentCount - 1; i >= 0; i--) {
    const reachable = next + twoA * length[i];
    if (v2[i] > reachable) v2[i] = reachable;
    next = v2[i];
  }
  let previous = v2[0];
  for (let i = 0; i < segmentCount; i++) {
    const reachable = previous + twoA * length[i];
    if (v2[i + 1] > reachable) v2[i + 1] = reachable;
    previous = v2[i + 1];
  }
}
