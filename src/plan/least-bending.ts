/**
 * The line that bends least between bounds: how far to move each point of a polyline to its left.
 *
 *   y     mm     the points' moves, low ≤ y ≤ high; fixed where low = high, as both ends must be
 *   φ     rad    the polyline's turn at each point, to the left
 *   ℓ     mm     lengths of its segments
 *
 *   tᵢ = φᵢ + (yᵢ₊₁ − yᵢ)/ℓᵢ − (yᵢ − yᵢ₋₁)/ℓᵢ₋₁       turn afterwards, to first order
 *   Σ wᵢ tᵢ²      wᵢ = (ℓᵢ₋₁ + ℓᵢ)/2 / min(ℓᵢ₋₁, ℓᵢ)²     is made least: ∫ κ² ds, with κ as the shorter segment has it
 *
 * Method: alternating directions (Boyd et al. 2011, section 5.2) with over-relaxation. In turns the problem without
 * bounds, a symmetric system of five diagonals with the same factors each time, and the bounds. A few rounds come near
 * enough, since within bounds distant points hardly matter to each other. Linear, and the same backwards as forwards.
 */

const ROUNDS = 4;
/** Weight of the bounds, as a share of the diagonal. */
const BOUND = 0.3;
const RELAXATION = 1.8;

export class LeastBending {
  y = new Float64Array(0);
  low = new Float64Array(0);
  high = new Float64Array(0);
  turn = new Float64Array(0);
  private weight = new Float64Array(0);
  private perLength = new Float64Array(0);
  /** The system as L D Lᵀ: 1/D, and the two diagonals of L, each value in its column's place. */
  private inverse = new Float64Array(0);
  private below1 = new Float64Array(0);
  private below2 = new Float64Array(0);
  private right = new Float64Array(0);
  /** Weight of the bounds at each point, 0 where it is fixed. */
  private bound = new Float64Array(0);
  private dual = new Float64Array(0);
  private halfway = new Float64Array(0);

  reserve(points: number): void {
    if (this.y.length > points) return;
    const size = Math.max(points + 1, 2 * this.y.length);
    this.y = new Float64Array(size);
    this.low = new Float64Array(size);
    this.high = new Float64Array(size);
    this.turn = new Float64Array(size);
    this.weight = new Float64Array(size);
    this.perLength = new Float64Array(size);
    this.inverse = new Float64Array(size);
    this.below1 = new Float64Array(size);
    this.below2 = new Float64Array(size);
    this.right = new Float64Array(size);
    this.bound = new Float64Array(size);
    this.dual = new Float64Array(size);
    this.halfway = new Float64Array(size);
  }

  /** Sets `y` from `low`, `high` and `turn` of the n + 1 points between n segments; `turn` is used up. */
  solve(n: number, length: Float64Array): void {
    this.begin(n, length);
    this.factor(n);
    for (let round = 0; round < ROUNDS; round++) this.improve(n);
  }

  /** Weights; the first y is what is fixed, and 0; and what the fixed points do to the turns is done. */
  private begin(n: number, length: Float64Array): void {
    const { y, low, high, turn, weight, perLength, dual } = this;
    weight[0] = weight[n] = 0;
    for (let i = 0; i < n; i++) {
      perLength[i] = 1 / length[i]!;
      y[i] = low[i] === high[i] ? low[i]! : 0;
      dual[i] = 0;
      if (i === 0) continue;
      const before = length[i - 1]!;
      const after = length[i]!;
      const shorter = Math.min(before, after);
      weight[i] = (before + after) / (2 * shorter * shorter);
    }
    y[n] = low[n]!;
    for (let i = 1; i < n; i++) {
      turn[i]! += (y[i + 1]! - y[i]!) * perLength[i]! - (y[i]! - y[i - 1]!) * perLength[i - 1]!;
    }
  }

  private factor(n: number): void {
    const { low, high, turn, weight, perLength, inverse, below1, below2, right, bound } = this;
    // Of this point's column and of the two before: D L of the first diagonal, and the second one of the system.
    let [first, first0] = [0, 0];
    let [second, second0, second00] = [0, 0, 0];
    for (let i = 0; i <= n; i++) {
      [first0, second00, second0] = [first, second0, second];
      if (low[i] === high[i]) {
        first = second = below1[i] = below2[i] = right[i] = bound[i] = 0;
        inverse[i] = 1;
        continue;
      }
      const a = perLength[i - 1]!;
      const c = perLength[i]!;
      const own = weight[i]! * (a + c);
      const before = weight[i - 1]! * a;
      const after = weight[i + 1]! * c;
      const diagonal = before * a + own * (a + c) + after * c;
      const isNext = low[i + 1] !== high[i + 1];
      const isAfterNext = i + 2 <= n && low[i + 2] !== high[i + 2];
      bound[i] = BOUND * diagonal;
      right[i] = own * turn[i]! - before * turn[i - 1]! - after * turn[i + 1]!;
      const l1 = i > 0 ? below1[i - 1]! : 0;
      const l2 = i > 1 ? below2[i - 2]! : 0;
      const d = diagonal + bound[i]! - l1 * first0 - l2 * second00;
      first = (isNext ? -own * c - after * (c + perLength[i + 1]!) : 0) - l1 * second0;
      second = isAfterNext ? after * perLength[i + 1]! : 0;
      inverse[i] = 1 / d;
      below1[i] = first / d;
      below2[i] = second / d;
    }
  }

  private improve(n: number): void {
    const { y, low, high, inverse, below1, below2, right, bound, dual, halfway } = this;
    // The first and the last point are fixed, with 0 in the system.
    let s1 = 0;
    let s2 = 0;
    let by1 = 0;
    let by2 = 0;
    let by2Next = 0;
    for (let i = 1; i < n; i++) {
      const s = right[i]! + bound[i]! * (y[i]! - dual[i]!) - by1 * s1 - by2 * s2;
      halfway[i] = s;
      s2 = s1;
      s1 = s;
      by1 = below1[i]!;
      by2 = by2Next;
      by2Next = below2[i]!;
    }
    let x1 = 0;
    let x2 = 0;
    for (let i = n - 1; i > 0; i--) {
      const x = halfway[i]! * inverse[i]! - below1[i]! * x1 - below2[i]! * x2;
      x2 = x1;
      x1 = x;
      if (bound[i] === 0) continue;
      const free = RELAXATION * x + (1 - RELAXATION) * y[i]! + dual[i]!;
      const kept = Math.max(low[i]!, Math.min(high[i]!, free));
      dual[i] = free - kept;
      y[i] = kept;
    }
  }
}
