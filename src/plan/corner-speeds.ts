/**
 * How fast one corner's curve may be entered and left: the fastest for what lies before and behind it.
 *
 *   s = sin(φ/2)     φ the turn
 *   L       mm       longest tangent on either side           A  mm/s²
 *   most    mm/s     greatest speed on either side, at most √(A L/s)
 *   v0, v1  mm/s     speeds where the curve begins and ends
 *   q       mm/s     |v1 u1 − v0 u0|: under |a| = A the curve takes q/A, and its tangents are v0 q/2A and v1 q/2A
 *
 * A pen that speeds up along a straight from speed z at its beginning has z² + 2 A x after x mm. Measured from the vertex, of
 * which the curve's tangent falls short, entry at v0 therefore needs
 *
 *     v0² + v0 q ≤ F      F  the speed² that acceleration all the way to the vertex would reach
 *     v1² + v1 q ≤ B      B  the same for braking, from behind
 *
 * and what the corner leaves for the straights beyond it is v1² − v1 q (forwards) and v0² − v0 q (backwards).
 * For a given q the greatest speeds are  v = min(most, 2 A L/q, root of v² + v q = F or B).  They fall as q rises, so the
 * fastest corner is the smallest q for which they turn by no more than q:  (v0 − v1)² + 4 s² v0 v1 ≤ q².
 */
export class CornerSpeeds {
  /** s of each corner, 0 where the way goes straight on. */
  sine = new Float64Array(0);
  /** L of each corner, mm; 0 at the ends and where the way goes straight on. */
  tangent = new Float64Array(0);
  most = new Float64Array(0);
  /** v0, v1 and q: what `solve` finds. */
  vIn = new Float64Array(0);
  vOut = new Float64Array(0);
  change = new Float64Array(0);

  reserve(points: number): void {
    if (this.sine.length >= points) return;
    const size = Math.max(points, 2 * this.sine.length);
    this.sine = new Float64Array(size);
    this.tangent = new Float64Array(size);
    this.most = new Float64Array(size);
    this.vIn = new Float64Array(size);
    this.vOut = new Float64Array(size);
    this.change = new Float64Array(size);
  }

  /** Sets v0, v1 and q of corner i. F and B are above 0. */
  solve(i: number, F: number, B: number, accel: number): void {
    const most = this.most[i]!;
    const s = this.sine[i]!;
    const change = 2 * s * most;
    const through = most * (most + change);
    if (through <= F && through <= B) {
      this.vIn[i] = this.vOut[i] = most;
      this.change[i] = change;
    } else if (s === 0) {
      this.vIn[i] = this.vOut[i] = Math.min(most, Math.sqrt(Math.min(F, B)));
      this.change[i] = 0;
    } else this.search(i, F, B, accel);
  }

  /**
   * Newton's steps from a guess, kept between a q too small and one large enough; halvings where another limit takes
   * over and they would go to and fro.
   */
  private search(corner: number, F: number, B: number, accel: number): void {
    const s = this.sine[corner]!;
    const most = this.most[corner]!;
    const reach = 2 * accel * this.tangent[corner]!;
    const c = 1 - 2 * s * s;
    let low = 0;
    let high = 2 * most;
    let q = guess(Math.min(F, B), most, reach, c);
    if (!(q > low && q < high)) q = 2 * s * most;
    let before = Infinity;
    let v0 = most;
    let v1 = most;
    let used = q;
    for (let i = 0; i < 60; i++) {
      v0 = v1 = most;
      let slope0 = 0;
      let slope1 = 0;
      if (most * q >= reach) {
        v0 = v1 = reach / q;
        slope0 = slope1 = -v0 / q;
      }
      if (v0 * (v0 + q) > F) {
        const root = Math.sqrt(q * q + 4 * F);
        v0 = (2 * F) / (q + root);
        slope0 = -v0 / root;
      }
      if (v1 * (v1 + q) > B) {
        const root = Math.sqrt(q * q + 4 * B);
        v1 = (2 * B) / (q + root);
        slope1 = -v1 / root;
      }
      used = q;
      const turned = Math.sqrt((v0 - v1) * (v0 - v1) + 4 * s * s * v0 * v1);
      const excess = turned - q;
      if (Math.abs(excess) <= SAME * most) break;
      if (excess > 0) low = q;
      else high = q;
      const isSlow = Math.abs(excess) > before / 2;
      before = isSlow ? Infinity : Math.abs(excess);
      q -= excess / ((slope0 * (v0 - c * v1) + slope1 * (v1 - c * v0)) / turned - 1);
      if (isSlow || !(q > low && q < high)) q = (low + high) / 2;
    }
    this.vIn[corner] = v0;
    this.vOut[corner] = v1;
    this.change[corner] = used;
  }
}

/** Share of a speed that is rounding. */
const SAME = 2e-15;

/**
 * The q of a corner that is slowed down on one side only, to the root v of v² + v q = E; on the other side it is as fast as its
 * tangent allows, w = R/q with R = 2 A L, or else as fast as it may be, w = m. With cos φ = c the turn is q² = v² + w² − 2 c v w.
 * Both equations give v = (E + w² − q²)/(q + 2 c w), and that put into the first one a cubic: of z = q²/R with b = E/R, or of
 * y = q/m with b = E/m².
 */
function guess(E: number, m: number, R: number, c: number): number {
  let b = E / R;
  const least = R / (m * m);
  let p1 = 2 * (b - 2 * b * c * c + c);
  let p2 = 2 * b * c + 1 - b * b;
  let p3 = 2 * (b + c);
  if (1 + least * (p1 - least * (p2 + least * p3)) > 0) {
    return Math.sqrt(R * rootOf(1, p1, p2, p3, 1 / (b + 1)));
  }
  b = E / (m * m);
  const p0 = (1 + b) * (1 + b) - 4 * b * c * c;
  p1 = 2 * c * (1 - b);
  p2 = 1 + 2 * b;
  p3 = 2 * c;
  return m * rootOf(p0, p1, p2, p3, Math.sqrt(p0));
}

/**
 * The least positive root of p0 + p1 z − p2 z² − p3 z³, which is somewhere near z: first as if z³ were z² times that, then by two of
 * Halley's steps.
 */
function rootOf(p0: number, p1: number, p2: number, p3: number, z: number): number {
  z = (2 * p0) / (Math.sqrt(Math.max(0, p1 * p1 + 4 * p0 * (p2 + p3 * z))) - p1);
  for (let i = 0; i < 2; i++) {
    const value = p0 + z * (p1 - z * (p2 + z * p3));
    const slope = p1 - z * (2 * p2 + 3 * p3 * z);
    const bend = p2 + 3 * p3 * z;
    z -= (value * slope) / (slope * slope + value * bend);
  }
  return z;
}
