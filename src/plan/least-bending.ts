/**
 * Finds the line with the least bending within bounds: how far to move each point of a polyline to the left.
 *
 *   y     mm     offset of each point, low ≤ y ≤ high; fixed where low = high; both ends must be fixed
 *   φ     rad    the polyline's turn at each point, to the left
 *   ℓ     mm     lengths of its segments
 *
 *   tᵢ = φᵢ + (yᵢ₊₁ − yᵢ)/ℓᵢ − (yᵢ − yᵢ₋₁)/ℓᵢ₋₁       new turn, to first order
 *   Σ wᵢ tᵢ²      wᵢ = 1 / min(ℓᵢ₋₁, ℓᵢ)     minimised: ∫ κ² ds over curves as long as the shorter segment
 *
 * Method: ADMM, the alternating direction method of multipliers (Boyd et al. 2011, section 5.2), with over-relaxation. Each round solves the
 * problem without bounds, a symmetric five-diagonal system whose factors stay the same, and then applies the
 * bounds. A few rounds are accurate enough, because distant points hardly affect each other. Linear time. The
 * result does not depend on the direction of the polyline.
 */

import { clamped, greater } from "./choose.js";

const ROUNDS = 6;
/** Penalty weight of the bounds, as a share of the diagonal. */
const BOUND_WEIGHT = 0.3;
const RELAXATION = 1.8;

export class LeastBending {
  y = new Float64Array(0);
  low = new Float64Array(0);
  high = new Float64Array(0);
  turn = new Float64Array(0);
  /** w, and w times the turn. */
  private weight = new Float64Array(0);
  private bending = new Float64Array(0);
  /** 1/ℓ of each segment; 1 for each point that is not fixed. */
  private perLength = new Float64Array(0);
  private isFree = new Uint8Array(0);
  /** The system L D Lᵀ: 1/D, and the two subdiagonals of L by column. */
  private inverse = new Float64Array(0);
  private below1 = new Float64Array(0);
  private below2 = new Float64Array(0);
  /** The right-hand side, and the weight of the bounds; both 0 for a fixed point. */
  private right = new Float64Array(0);
  private boundWeight = new Float64Array(0);
  /** The half-solved system, and the values carried from one round to the next. */
  private halfway = new Float64Array(0);
  private carry = new Float64Array(0);

  reserve(points: number): void {
    if (this.y.length > points) return;
    const size = Math.max(points + 1, 2 * this.y.length);
    this.y = new Float64Array(size);
    this.low = new Float64Array(size);
    this.high = new Float64Array(size);
    this.turn = new Float64Array(size);
    this.weight = new Float64Array(size);
    this.bending = new Float64Array(size);
    this.perLength = new Float64Array(size);
    this.isFree = new Uint8Array(size);
    this.inverse = new Float64Array(size);
    this.below1 = new Float64Array(size);
    this.below2 = new Float64Array(size);
    this.right = new Float64Array(size);
    this.boundWeight = new Float64Array(size);
    this.halfway = new Float64Array(size);
    this.carry = new Float64Array(size);
  }

  /** Sets `y` from `low`, `high` and `turn` of the n + 1 points between n segments. */
  solve(n: number, length: Float64Array): void {
    this.weigh(n, length);
    this.factor(n);
    this.halfway.set(this.right.subarray(0, n));
    this.carry.fill(0, 0, n);
    for (let round = 0; round < ROUNDS; round++) {
      this.substituteForward(n);
      this.substituteBackward(n);
    }
    this.y[0] = this.low[0];
    this.y[n] = this.low[n];
  }

  /** Fills weights and turns. Points that are fixed away from the line contribute to the turns. */
  private weigh(n: number, length: Float64Array): void {
    const { low, high, turn, weight, bending, perLength, isFree } = this;
    weight[0] = bending[0] = weight[n] = bending[n] = 0;
    isFree[0] = 0;
    isFree[1] = low[1] === high[1] ? 0 : 1;
    perLength[0] = 1 / length[0];
    let y0 = low[0];
    let y1 = isFree[1] === 1 ? 0 : low[1];
    for (let i = 1; i < n; i++) {
      isFree[i + 1] = low[i + 1] === high[i + 1] ? 0 : 1;
      perLength[i] = 1 / length[i];
      const a = perLength[i - 1];
      const c = perLength[i];
      const y2 = isFree[i + 1] === 1 ? 0 : low[i + 1];
      weight[i] = greater(a, c);
      bending[i] = weight[i] * (turn[i] + (y2 - y1) * c - (y1 - y0) * a);
      y0 = y1;
      y1 = y2;
    }
  }

  private factor(n: number): void {
    const { weight, bending, perLength, isFree, inverse, below1, below2, right, boundWeight } = this;
    // D times the first subdiagonal of L in the previous column, and the second one in the previous two.
    let first1 = 0;
    let second1 = 0;
    let second2 = 0;
    for (let i = 0; i < n; i++) {
      let d = 1;
      let first = 0;
      let second = 0;
      right[i] = boundWeight[i] = 0;
      if (isFree[i] === 1) {
        const a = perLength[i - 1];
        const c = perLength[i];
        const own = weight[i] * (a + c);
        const before = weight[i - 1] * a;
        const after = weight[i + 1] * c;
        const diagonal = before * a + own * (a + c) + after * c;
        right[i] = bending[i] * (a + c) - bending[i - 1] * a - bending[i + 1] * c;
        boundWeight[i] = BOUND_WEIGHT * diagonal;
        d = diagonal + boundWeight[i] - (i > 1 ? below2[i - 2] * second2 : 0) - below1[i - 1] * first1;
        // The last point is fixed, so these read no segment beyond it.
        if (isFree[i + 1] === 1) first = -own * c - after * (c + perLength[i + 1]) - below1[i - 1] * second1;
        if (i + 2 < n && isFree[i + 2] === 1) second = after * perLength[i + 1];
      }
      inverse[i] = 1 / d;
      below1[i] = first * inverse[i];
      below2[i] = second * inverse[i];
      first1 = first;
      second2 = second1;
      second1 = second;
    }
  }

  private substituteForward(n: number): void {
    const { halfway, below1, below2 } = this;
    // The first point is fixed, with 0 in the system.
    let s1 = halfway[1];
    let s2 = 0;
    for (let i = 2; i < n; i++) {
      const s = halfway[i] - below2[i - 2] * s2 - below1[i - 1] * s1;
      halfway[i] = s;
      s2 = s1;
      s1 = s;
    }
  }

  /**
   * Substitutes backward, then clamps each point to its bounds. `carry` is the scaled dual variable, the sum of what
   * earlier rounds clamped off, plus (1 − RELAXATION) times the previous y. Afterwards `halfway` holds the next
   * right-hand side.
   */
  private substituteBackward(n: number): void {
    const { y, low, high, inverse, below1, below2, right, boundWeight, halfway, carry } = this;
    let x1 = 0;
    let x2 = 0;
    for (let i = n - 1; i > 0; i--) {
      const x = halfway[i] * inverse[i] - below2[i] * x2 - below1[i] * x1;
      x2 = x1;
      x1 = x;
      const free = RELAXATION * x + carry[i];
      const bounded = clamped(free, low[i], high[i]);
      y[i] = bounded;
      carry[i] = free - RELAXATION * bounded;
      halfway[i] = right[i] + boundWeight[i] * (2 * bounded - free);
    }
  }
}
