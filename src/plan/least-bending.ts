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
import { greater, lesser } from "./branchless.js";

const ROUNDS = 4;
/** Weight of the bounds, as a share of the diagonal. */
const BOUND = 0.3;
const RELAXATION = 1.8;

/**
 * What is known of each point, beside each other in memory: the solution's first half; 1/D, and the two diagonals of L in their
 * column; what one round hands to the next; the right side; the weight of the bounds, 0 where the point is fixed; the bounds.
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

export class LeastBending {
  y = new Float64Array(0);
  low = new Float64Array(0);
  high = new Float64Array(0);
  turn = new Float64Array(0);
  private weight = new Float64Array(0);
  private perLength = new Float64Array(0);
  private rows = new Float64Array(0);

  reserve(points: number): void {
    if (this.y.length > points) return;
    const size = Math.max(points + 1, 2 * this.y.length);
    this.y = new Float64Array(size);
    this.low = new Float64Array(size);
    this.high = new Float64Array(size);
    this.turn = new Float64Array(size);
    this.weight = new Float64Array(size);
    this.perLength = new Float64Array(size);
    this.rows = new Float64Array(FIELDS * size);
  }

  /** Sets `y` from `low`, `high` and `turn` of the n + 1 points between n segments; `turn` is used up. */
  solve(n: number, length: Float64Array): void {
    this.begin(n, length);
    this.factor(n);
    for (let round = 1; round < ROUNDS; round++) {
      this.goBack(n);
      this.goForth(n);
    }
    this.finish(n);
  }

  /** Weights; and what points that are fixed elsewhere than on the line do to the turns. */
  private begin(n: number, length: Float64Array): void {
    const { low, high, turn, weight, perLength } = this;
    weight[0] = weight[n] = perLength[n] = 0;
    let before = length[0]!;
    let a = 1 / before;
    let y0 = low[0]!;
    let y1 = low[1] === high[1] ? low[1]! : 0;
    perLength[0] = a;
    for (let i = 1; i < n; i++) {
      const after = length[i]!;
      const c = 1 / after;
      const most = greater(a, c);
      weight[i] = ((before + after) / 2) * most * most;
      perLength[i] = c;
      const y2 = low[i + 1] === high[i + 1] ? low[i + 1]! : 0;
      turn[i]! += (y2 - y1) * c - (y1 - y0) * a;
      before = after;
      a = c;
      y0 = y1;
      y1 = y2;
    }
  }

  /** The system's factors; and the first way forth, on which no point has moved yet. */
  private factor(n: number): void {
    const { low, high, turn, weight, perLength, rows } = this;
    // D L's first diagonal in the column before, the second one's in the two before; L's likewise; the solution's first half.
    let first1 = 0;
    let [second1, second2] = [0, 0];
    let below1 = 0;
    let [below2, below2Before] = [0, 0];
    let [s1, s2] = [0, 0];
    for (let i = 1, r = FIELDS; i < n; i++, r += FIELDS) {
      const a = perLength[i - 1]!;
      const c = perLength[i]!;
      const e = perLength[i + 1]!;
      const isFree = low[i] !== high[i];
      const own = weight[i]! * (a + c);
      const before = weight[i - 1]! * a;
      const after = weight[i + 1]! * c;
      const diagonal = before * a + own * (a + c) + after * c;
      const held = BOUND * diagonal;
      const right = own * turn[i]! - before * turn[i - 1]! - after * turn[i + 1]!;
      let d = diagonal + held - below2Before * second2 - below1 * first1;
      let first = (low[i + 1] !== high[i + 1] ? -own * c - after * (c + e) : 0) - below1 * second1;
      let second = low[i + 2] !== high[i + 2] ? after * e : 0;
      let s = right - below2Before * s2 - below1 * s1;
      if (!isFree) {
        d = 1;
        first = second = s = 0;
      }
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
      rows[r + RIGHT] = isFree ? right : 0;
      rows[r + HELD] = isFree ? held : 0;
      rows[r + LOW] = low[i]!;
      rows[r + HIGH] = high[i]!;
    }
  }

  /**
   * Solves the system's second half, and brings each point within its bounds: from where it would be, over-relaxed and with all
   * that was cut off before (the dual variable), to y. HALFWAY is the next right side then.
   */
  private goBack(n: number): void {
    const { rows } = this;
    let x1 = 0;
    let x2 = 0;
    for (let r = FIELDS * (n - 1); r > 0; r -= FIELDS) {
      const x = rows[r + HALFWAY]! * rows[r + INVERSE]! - rows[r + BELOW2]! * x2 - rows[r + BELOW1]! * x1;
      x2 = x1;
      x1 = x;
      const low = rows[r + LOW]!;
      const high = rows[r + HIGH]!;
      const free = RELAXATION * x + rows[r + CARRY]!;
      // The nearest place within bounds, without a branch: which one it is changes from point to point.
      const y = (Math.abs(free - low) - Math.abs(free - high) + (low + high)) / 2;
      rows[r + CARRY] = free - RELAXATION * y;
      rows[r + HALFWAY] = rows[r + RIGHT]! + rows[r + HELD]! * (2 * y - free);
    }
  }

  /** Solves the first half. */
  private goForth(n: number): void {
    const { rows } = this;
    // The first and the last point are fixed, with 0 in the system.
    let s1 = 0;
    let s2 = 0;
    let below1 = 0;
    let below2 = 0;
    let below2Before = 0;
    for (let r = FIELDS; r < FIELDS * n; r += FIELDS) {
      const s = rows[r + HALFWAY]! - below2Before * s2 - below1 * s1;
      rows[r + HALFWAY] = s;
      s2 = s1;
      s1 = s;
      below1 = rows[r + BELOW1]!;
      below2Before = below2;
      below2 = rows[r + BELOW2]!;
    }
  }

  /** As `goBack`, the last time. */
  private finish(n: number): void {
    const { rows, y } = this;
    y[0] = this.low[0]!;
    y[n] = this.low[n]!;
    let x1 = 0;
    let x2 = 0;
    for (let i = n - 1, r = FIELDS * i; i > 0; i--, r -= FIELDS) {
      const x = rows[r + HALFWAY]! * rows[r + INVERSE]! - rows[r + BELOW2]! * x2 - rows[r + BELOW1]! * x1;
      x2 = x1;
      x1 = x;
      const free = RELAXATION * x + rows[r + CARRY]!;
      const low = rows[r + LOW]!;
      const high = rows[r + HIGH]!;
      const within = greater(low, lesser(high, free));
      y[i] = within > high ? high : within;
    }
  }
}
