/**
 * Finds the line with the least bending within bounds: how far to move each point of a polyline to the left.
 *
 *   y     mm     offset of each point, low ≤ y ≤ high; both ends must have low = high
 *   φ     rad    the polyline's turn at each point, to the left
 *   ℓ     mm     lengths of its segments
 *
 *   tᵢ = φᵢ + (yᵢ₊₁ − yᵢ)/ℓᵢ − (yᵢ − yᵢ₋₁)/ℓᵢ₋₁       new turn, to first order
 *   E = ½ Σ wᵢ tᵢ²      wᵢ = 1 / min(ℓᵢ₋₁, ℓᵢ)        minimised: ∫ κ² ds with κ = wᵢ tᵢ
 *
 * Method: gradient descent with momentum (Nesterov 1983). Each round moves every point down the slope of E and back
 * into its bounds. A few rounds are accurate enough, because distant points hardly affect each other. Linear time.
 * The result does not depend on the direction of the polyline.
 */

const ROUNDS = 6;
/**
 * Step down the slope, as a share of the way to the point's own minimum. Each turn depends on three points, so the
 * descent is stable below 4/9, with any momentum.
 */
const STEP = 0.44;
/** Share of a point's last move that is added to it before the next step. */
const MOMENTUM = 0.6;

export class LeastBending {
  y = new Float64Array(0);
  low = new Float64Array(0);
  high = new Float64Array(0);
  turn = new Float64Array(0);
  /** y plus its momentum, where the next step begins. */
  private ahead = new Float64Array(0);
  private weight = new Float64Array(0);
  /** 1/ℓ of each segment. */
  private perLength = new Float64Array(0);
  /** mm that a point moves for each unit of slope: STEP / (∂²E/∂y²). */
  private step = new Float64Array(0);

  reserve(points: number): void {
    if (this.y.length > points) return;
    const size = Math.max(points + 1, 2 * this.y.length);
    this.y = new Float64Array(size);
    this.low = new Float64Array(size);
    this.high = new Float64Array(size);
    this.turn = new Float64Array(size);
    this.ahead = new Float64Array(size);
    this.weight = new Float64Array(size);
    this.perLength = new Float64Array(size);
    this.step = new Float64Array(size);
  }

  /** Sets `y` from `low`, `high` and `turn` of the n + 1 points between n segments. */
  solve(n: number, length: Float64Array): void {
    const { y, low, high, ahead } = this;
    this.weigh(n, length);
    for (let i = 0; i <= n; i++) y[i] = ahead[i] = clamped(0, low[i], high[i]);
    for (let round = 0; round < ROUNDS; round++) this.descend(n);
  }

  private weigh(n: number, length: Float64Array): void {
    const { weight, perLength, step } = this;
    weight[0] = weight[n] = 0;
    perLength[0] = 1 / length[0];
    // No segment follows the last point.
    perLength[n] = 0;
    for (let i = 1; i < n; i++) {
      perLength[i] = 1 / length[i];
      weight[i] = Math.max(perLength[i - 1], perLength[i]);
    }
    for (let i = 1; i < n; i++) {
      const a = perLength[i - 1];
      const c = perLength[i];
      step[i] = STEP / (weight[i - 1] * a * a + weight[i] * (a + c) * (a + c) + weight[i + 1] * c * c);
    }
  }

  private descend(n: number): void {
    const { y, low, high, turn, ahead, weight, perLength, step } = this;
    // Carried along the line, from before this round: points i and i + 1, their segment's slope, 1/ℓ on both sides of
    // point i, and κ of points i − 1 and i.
    let y1 = ahead[1];
    let y2 = ahead[2];
    let slope = (y2 - y1) * perLength[1];
    let a = perLength[0];
    let c = perLength[1];
    let before = 0;
    let own = weight[1] * (turn[1] + slope - (y1 - ahead[0]) * a);
    for (let i = 1; i < n; i++) {
      const y3 = ahead[i + 2];
      const next = perLength[i + 1];
      const nextSlope = (y3 - y2) * next;
      const after = weight[i + 1] * (turn[i + 1] + nextSlope - slope);
      const down = (own - before) * a + (own - after) * c;
      const moved = clamped(y1 + step[i] * down, low[i], high[i]);
      ahead[i] = moved + MOMENTUM * (moved - y[i]);
      y[i] = moved;
      y1 = y2;
      y2 = y3;
      slope = nextSlope;
      a = c;
      c = next;
      before = own;
      own = after;
    }
  }
}

export const clamped = (a: number, low: number, high: number): number =>
  a < low ? low : a > high ? high : a;
