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
 * Method: ADMM, the alternating direction method of multipliers (Boyd et al. 2011, section 5.2), with
 * over-relaxation. Each round solves the problem without bounds, a symmetric five-diagonal system whose factors stay
 * the same, and then applies the bounds. A few rounds are accurate enough, because distant points hardly affect each
 * other. Linear time. The result does not depend on the direction of the polyline.
 */

const ROUNDS = 6;
/** Penalty weight of the bounds, as a share of the diagonal. */
const PENALTY_SHARE = 0.3;
const RELAXATION = 1.8;

/**
 * Fields of the points in `rows`, one row per point. V8 checks an array at each access: with an array per field, a
 * million points take 60 ms in place of 46.
 */
const FIELDS = 9;
/** The half-solved system; between rounds, its next right-hand side. */
const HALFWAY = 0;
/** Carried from one round to the next. */
const CARRY = 1;
/** The system L D Lᵀ: 1/D, and the two subdiagonals of L by column. */
const INVERSE = 2;
const BELOW1 = 3;
const BELOW2 = 4;
/** The right-hand side, and the penalty weight of the bounds; both 0 for a fixed point. */
const RIGHT = 5;
const PENALTY = 6;
const LOW = 7;
const HIGH = 8;

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
  private rows = new Float64Array(0);

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
    this.rows = new Float64Array(FIELDS * size);
  }

  /** Sets `y` from `low`, `high` and `turn` of the n + 1 points between n segments. */
  solve(n: number, length: Float64Array): void {
    this.weigh(n, length);
    this.factor(n);
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
      weight[i] = Math.max(a, c);
      bending[i] = weight[i] * (turn[i] + (y2 - y1) * c - (y1 - y0) * a);
      y0 = y1;
      y1 = y2;
    }
  }

  /** Fills the rows: the factors of the system, and the state before the first round. */
  private factor(n: number): void {
    const { low, high, weight, bending, perLength, isFree, rows } = this;
    // Of the previous points: the subdiagonals of L, and these times D (first, second).
    let below1 = 0;
    let below2 = 0;
    let below2Before = 0;
    let first1 = 0;
    let second1 = 0;
    let second2 = 0;
    for (let i = 0; i < n; i++) {
      let d = 1;
      let first = 0;
      let second = 0;
      let right = 0;
      let penalty = 0;
      if (isFree[i] === 1) {
        const a = perLength[i - 1];
        const c = perLength[i];
        const own = weight[i] * (a + c);
        const before = weight[i - 1] * a;
        const after = weight[i + 1] * c;
        const diagonal = before * a + own * (a + c) + after * c;
        right = bending[i] * (a + c) - bending[i - 1] * a - bending[i + 1] * c;
        penalty = PENALTY_SHARE * diagonal;
        d = diagonal + penalty - below2Before * second2 - below1 * first1;
        // The last point is fixed, so these read no segment beyond it.
        if (isFree[i + 1] === 1) first = -own * c - after * (c + perLength[i + 1]) - below1 * second1;
        if (i + 2 < n && isFree[i + 2] === 1) second = after * perLength[i + 1];
      }
      below2Before = below2;
      below1 = first / d;
      below2 = second / d;
      first1 = first;
      second2 = second1;
      second1 = second;
      const r = FIELDS * i;
      rows[r + HALFWAY] = rows[r + RIGHT] = right;
      rows[r + CARRY] = 0;
      rows[r + INVERSE] = 1 / d;
      rows[r + BELOW1] = below1;
      rows[r + BELOW2] = below2;
      rows[r + PENALTY] = penalty;
      rows[r + LOW] = low[i];
      rows[r + HIGH] = high[i];
    }
  }

  private substituteForward(n: number): void {
    const { rows } = this;
    // The first point is fixed, with 0 in the system.
    let s1 = rows[FIELDS + HALFWAY];
    let s2 = 0;
    for (let r = 2 * FIELDS; r < n * FIELDS; r += FIELDS) {
      const s = rows[r + HALFWAY] - rows[r - 2 * FIELDS + BELOW2] * s2 - rows[r - FIELDS + BELOW1] * s1;
      rows[r + HALFWAY] = s;
      s2 = s1;
      s1 = s;
    }
  }

  /**
   * Substitutes backward, then clamps each point to its bounds. CARRY is the scaled dual variable, the sum of what
   * earlier rounds clamped off, plus (1 − RELAXATION) times the previous y. Afterwards HALFWAY is the next
   * right-hand side.
   */
  private substituteBackward(n: number): void {
    const { y, rows } = this;
    let x1 = 0;
    let x2 = 0;
    for (let i = n - 1; i > 0; i--) {
      const r = FIELDS * i;
      const x = rows[r + HALFWAY] * rows[r + INVERSE] - rows[r + BELOW2] * x2 - rows[r + BELOW1] * x1;
      x2 = x1;
      x1 = x;
      const low = rows[r + LOW];
      const high = rows[r + HIGH];
      const free = RELAXATION * x + rows[r + CARRY];
      // Clamped. With Math.min and Math.max, branches that the processor often guesses wrong, planning a million
      // segments takes 5 % longer in `scurve`.
      const bounded = (Math.abs(free - low) - Math.abs(free - high) + (low + high)) / 2;
      y[i] = bounded;
      rows[r + CARRY] = free - RELAXATION * bounded;
      rows[r + HALFWAY] = rows[r + RIGHT] + rows[r + PENALTY] * (2 * bounded - free);
    }
  }
}
