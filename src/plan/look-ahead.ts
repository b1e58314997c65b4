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
export function lookAhead(v2: Float64Array, length: Float64Array, segmentCount: number, accel: number): void {
  const twoA = 2 * accel;
  let next = v2[segmentCount];
  for (let i = segmentCount - 1; i >= 0; i--) {
    const reachable = next + twoA * length[i];
    if (v2[i] > reachable) v2[i] = reachable;
    next = v2[i]!;
  }
  let previous = v2[0];
  for (let i = 0; i < segmentCount; i++) {
    const reachable = previous + twoA * length[i];
    if (v2[i + 1] > reachable) v2[i + 1] = reachable;
    previous = v2[i + 1]!;
  }
}
