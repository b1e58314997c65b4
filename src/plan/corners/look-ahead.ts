/**
 * Look-ahead: the highest speeds at the corners of a run under |a| ≤ A.
 *
 *   v    speed at a corner, mm/s             s   sin(φ/2) of a corner that is a curve, otherwise 0
 *   ℓ    length of a segment, mm             '   values of the next corner
 *
 * On a straight, v² changes by at most 2 A per mm. A curve takes v² s/A of the segment on either side (blend-rule.ts),
 * and v does not change there. This leaves ℓ − v² s/A − v'² s'/A, so
 *
 *     to brake         v² (1 + 2 s)   ≤  v'² (1 − 2 s') + 2 A ℓ
 *     to accelerate    v'² (1 + 2 s') ≤  v² (1 − 2 s)   + 2 A ℓ
 *
 *   v² ^   limit ....      ....          A backward pass lowers each corner's speed so that the pen can brake for
 *      |     ___:   :_____:   :          what follows. A forward pass lowers it to what the pen can reach. Linear,
 *      |    /   \  /      \              no backtracking. The picture is for s = 0: there no other allowed profile
 *      +---------------------------> s   is faster anywhere.
 *
 * After the forward pass the pen can still brake: where it lowers v' it makes the second line an equation, and
 * the first then says v² s + v'² s' ≤ A ℓ, which is true because curves do not overlap.
 */
import type { RunPath } from "../run-path.js";

/** Lowers `path.v2`, the max speed² at each corner, to the planned speed². */
export function lookAhead({ segmentCount: n, length, v2, sine }: RunPath, accel: number): void {
  const twoA = 2 * accel;
  let left = 0;
  for (let i = n - 1; i >= 0; i--) {
    const reachable = (left + twoA * length[i]) / (1 + 2 * sine[i]);
    if (v2[i] > reachable) v2[i] = reachable;
    left = v2[i] * (1 - 2 * sine[i]);
  }
  left = 0;
  for (let i = 1; i <= n; i++) {
    const reachable = (left + twoA * length[i - 1]) / (1 + 2 * sine[i]);
    if (v2[i] > reachable) v2[i] = reachable;
    left = v2[i] * (1 - 2 * sine[i]);
  }
}
