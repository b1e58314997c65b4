/**
 * The line of least bending between bounds: how far to move each point of a polyline to its left.
 *
 *   y     mm     the points' offsets, low ≤ y ≤ high; fixed where low = high, which both ends must be
 *   φ     rad    the polyline's turn at each point, to the left
 *   ℓ     mm     lengths of its segments
 *
 *   tᵢ = φᵢ + (yᵢ₊₁ − yᵢ)/ℓᵢ − (yᵢ − yᵢ₋₁)/ℓᵢ₋₁       new turn, to first order
 *   Σ wᵢ tᵢ²      wᵢ = (ℓᵢ₋₁ + ℓᵢ)/2 / min(ℓᵢ₋₁, ℓᵢ)²     is minimised: ∫ κ² ds, κ by the shorter segment
 *
 * Method: alternating directions (Boyd et al. 2011, section 5.2) with over-relaxation. Each round solves the
 * problem without bounds, a symmetric five-diagonal system whose factors stay the same, and then applies the
 * bounds. A few rounds are accurate enough, since between bounds distant points hardly affect each other.
 * Linear time; the result does not depend on the direction of the polyline.
 */

const ROUNDS = 4;
/** Penalty weight of the bounds, as a share of the diagonal. */
const BOUND = 0.3;
const RELAXATION = 1.8;

/**
 * The fields of each point, adjacent in memory: the half-solved system; 1/D and the two subdiagonals of L in
 * this column; the value carried from one round to the next; the right-hand side; the weight of the bounds, 0
 * for a fixed point; the bounds.
 */
const FIELDS = 9;
const HALFWAY = 0;
const INVERSE = 1;
const BELOW1 = 2;
const BELOW2 = 3;
const CARRY = 4;
const RIGHT = 5;
const HELD = 6;
const LOW = 7;
const HIGH = 8;
/**
 * Before factoring, the same slots hold: the weight; weight × turn; 1 for a free point and 0 for a fixed one;
 * 1/ℓ.
 */
const WEIGHT = HALFWAY;
const BENDING = INVERSE;
const FREE = BELOW1;
const PER_LENGTH = BELOW2;

export class LeastBending {
  y = new Float64Array(0);
  low = new Float64Array(0);
  high = new Float64Array(0);
  turn = new Float64Array(0);
  private rows = new Float64Array(0);

  reserve(points: number): void {
    if (this.y.length > points) return;
    const size = Math.max(points + 1, 2 * this.y.length);
    this.y = new Float64Array(size);
    this.low = new Float64Array(size);
    this.high = new Float64Array(size);
    this.turn = new Float64Array(size);
    this.rows = new Float64Array(FIELDS * size);
  }

  /** Sets `y` from `low`, `high` and `turn` of the n + 1 points between n segments. */
  solve(n: number, length: Float64Array): void {
    this.begin(n, length);
    this.factor(n, this.rows);
    for (let round = 1; round < ROUNDS; round++) {
      this.goBack(n);
      this.goForth(n);
    }
    this.finish(n);
  }

  /**
   * Fills the rows with weights and turns. Points that are fixed away from the line contribute to the turns.
   */
  private begin(n: number, length: Float64Array): void {
    const { low, high, turn, rows } = this;
    let before = length[0];
    let a = 1 / before;
    let free1 = isFree(low[1], high[1]);
    let y0 = low[0];
    let y1 = (1 - free1) * low[1];
    rows[WEIGHT] = rows[BENDING] = rows[FREE] = 0;
    rows[PER_LENGTH] = a;
    let r = FIELDS;
    for (let i = 1; i < n; i++, r += FIELDS) {
      const after = length[i];
      const c = 1 / after;
      const max = Math.max(a, c);
      const weight = ((before + after) / 2) * max * max;
      const low2 = low[i + 1];
      const high2 = high[i + 1];
      const free2 = isFree(low2, high2);
      const y2 = (1 - free2) * low2;
      rows[r + WEIGHT] = weight;
      rows[r + BENDING] = weight * (turn[i] + (y2 - y1) * c - (y1 - y0) * a);
      rows[r + FREE] = free1;
      rows[r + PER_LENGTH] = c;
      rows[r + FIELDS + LOW] = low2;
      rows[r + FIELDS + HIGH] = high2;
      before = after;
      a = c;
      free1 = free2;
      y0 = y1;
      y1 = y2;
    }
    rows[FIELDS + LOW] = low[1]!;
    rows[FIELDS + HIGH] = high[1]!;
    rows[r + WEIGHT] =
      rows[r + BENDING] =
      rows[r + FREE] =
      rows[r + PER_LENGTH] =
      rows[r + FIELDS + FREE] =
        0;
  }

  /**
   * Factors the system, and does the first forward substitution, where no point has moved yet. Multiplying by
   * 0 or 1 is faster here than branching, because fixed and free points alternate often. Nothing is read
   * before the loop: V8 may compile this function during its first run, and would discard that code at values
   * it has not seen yet.
   */
  private factor(n: number, rows: Float64Array): void {
    // D times L's first subdiagonal in the previous column, and the second one in the previous two; the same
    // for L; the half-solved system.
    let first1 = 0;
    let second1 = 0;
    let second2 = 0;
    let below1 = 0;
    let below2 = 0;
    let below2Before = 0;
    let s1 = 0;
    let s2 = 0;
    // Of the previous point and of the current point.
    let weight0 = 0;
    let weight1 = 0;
    let bending0 = 0;
    let bending1 = 0;
    let free1 = 0;
    let a = 0;
    for (let r = 0; r < FIELDS * n; r += FIELDS) {
      const next = r + FIELDS;
      const c = rows[r + PER_LENGTH];
      const free2 = rows[next + FREE];
      const weight2 = rows[next + WEIGHT];
      const bending2 = rows[next + BENDING];
      const e = rows[next + PER_LENGTH];
      const free3 = rows[next + FIELDS + FREE];
      const around = a + c;
      const own = weight1 * around;
      const before = weight0 * a;
      const after = weight2 * c;
      const right = free1 * (bending1 * around - bending0 * a - bending2 * c);
      const diagonal = before * a + own * around + after * c;
      const held = free1 * BOUND * diagonal;
      const d = free1 * (diagonal + held - below2Before * second2 - below1 * first1 - 1) + 1;
      const first = free1 * (free2 * (-own * c - after * (c + e)) - below1 * second1);
      const second = free1 * free3 * after * e;
      const s = free1 * (right - below2Before * s2 - below1 * s1);
      const inverse = 1 / d;
      below2Before = below2;
      below1 = first * inverse;
      below2 = second * inverse;
      first1 = first;
      second2 = second1;
      second1 = second;
      s2 = s1;
      s1 = s;
      rows[r + HALFWAY] = s;
      rows[r + INVERSE] = inverse;
      rows[r + BELOW1] = below1;
      rows[r + BELOW2] = below2;
      rows[r + CARRY] = 0;
      rows[r + RIGHT] = right;
      rows[r + HELD] = held;
      weight0 = weight1;
      weight1 = weight2;
      bending0 = bending1;
      bending1 = bending2;
      free1 = free2;
      a = c;
    }
  }

  /**
   * Backward substitution, then clamps each point to its bounds: y is the over-relaxed solution plus
   * everything clamped off before (the dual variable). Afterwards HALFWAY holds the next right-hand side.
   */
  private goBack(n: number): void {
    const { rows } = this;
    let x1 = 0;
    let x2 = 0;
    for (let r = FIELDS * (n - 1); r > 0; r -= FIELDS) {
      const x = rows[r + HALFWAY] * rows[r + INVERSE] - rows[r + BELOW2] * x2 - rows[r + BELOW1] * x1;
      x2 = x1;
      x1 = x;
      const low = rows[r + LOW];
      const high = rows[r + HIGH];
      const free = RELAXATION * x + rows[r + CARRY];
      const y = Math.min(high, Math.max(low, free));
      rows[r + CARRY] = free - RELAXATION * y;
      rows[r + HALFWAY] = rows[r + RIGHT] + rows[r + HELD] * (2 * y - free);
    }
  }

  /** Forward substitution. */
  private goForth(n: number): void {
    const { rows } = this;
    // The first and the last point are fixed, with 0 in the system.
    let s1 = 0;
    let s2 = 0;
    let below1 = 0;
    let below2 = 0;
    let below2Before = 0;
    for (let r = FIELDS; r < FIELDS * n; r += FIELDS) {
      const s = rows[r + HALFWAY] - below2Before * s2 - below1 * s1;
      rows[r + HALFWAY] = s;
      s2 = s1;
      s1 = s;
      below1 = rows[r + BELOW1]!;
      below2Before = below2;
      below2 = rows[r + BELOW2]!;
    }
  }

  /** The last `goBack`, which writes the result. */
  private finish(n: number): void {
    const { rows, y } = this;
    y[0] = this.low[0]!;
    y[n] = this.low[n]!;
    let x1 = 0;
    let x2 = 0;
    for (let i = n - 1, r = FIELDS * i; i > 0; i--, r -= FIELDS) {
      const x = rows[r + HALFWAY] * rows[r + INVERSE] - rows[r + BELOW2] * x2 - rows[r + BELOW1] * x1;
      x2 = x1;
      x1 = x;
      const free = RELAXATION * x + rows[r + CARRY];
      const low = rows[r + LOW];
      const high = rows[r + HIGH];
      y[i] = Math.min(high, Math.max(low, free));
    }
  }
}

function isFree(low: number, high: number): number {
  return low === high ? 0 : 1;
}
