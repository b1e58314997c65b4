/**
 * The highest entry and exit speed of one corner's curve that the path before and after it allows.
 *
 *   s = sin(φ/2)     φ the turn angle
 *   L       mm       longest tangent on either side           A  mm/s²
 *   maxSpeed mm/s    speed limit on both sides, at most √(A L/s)
 *   v0, v1  mm/s     speeds at the start and end of the curve
 *   q       mm/s     |v1 u1 − v0 u0|: under |a| = A the curve takes q/A, with tangents v0 q/2A, v1 q/2A
 *
 * On a straight that starts at speed z, the speed² after x mm of acceleration is z² + 2 A x. The curve begins
 * one tangent before the vertex. Measured at the vertex, the limits for entry and exit are therefore
 *
 *     v0² + v0 q ≤ F      F  the speed² reached by accelerating all the way to the vertex
 *     v1² + v1 q ≤ B      B  the same for braking, computed backwards
 *
 * The next straight then starts at speed² v1² − v1 q, measured at the vertex; the previous one, computed
 * backwards, at v0² − v0 q.
 *
 * For a given q the highest speeds are min(maxSpeed, 2 A L/q, root of v² + v q = F or B). They fall as q
 * rises, so the fastest corner has the smallest q for which the velocity change is at most q:
 *   (v0 − v1)² + 4 s² v0 v1 ≤ q².
 */
export class CornerSpeeds {
  /** s of each corner; 0 where the path is straight. */
  sine = new Float64Array(0);
  /** L of each corner, mm; 0 at the ends and where the path is straight. */
  tangent = new Float64Array(0);
  maxSpeed = new Float64Array(0);
  /** v0, v1 and q: the results of `solve`. */
  vIn = new Float64Array(0);
  vOut = new Float64Array(0);
  change = new Float64Array(0);

  reserve(points: number): void {
    if (this.sine.length >= points) return;
    const size = Math.max(points, 2 * this.sine.length);
    this.sine = new Float64Array(size);
    this.tangent = new Float64Array(size);
    this.maxSpeed = new Float64Array(size);
    this.vIn = new Float64Array(size);
    this.vOut = new Float64Array(size);
    this.change = new Float64Array(size);
  }

  /** Sets v0, v1 and q of corner i. F and B must be positive. */
  solve(i: number, F: number, B: number, accel: number): void {
    const maxSpeed = this.maxSpeed[i];
    const s = this.sine[i];
    const change = 2 * s * maxSpeed;
    const through = maxSpeed * (maxSpeed + change);
    if (through <= F && through <= B) {
      this.vIn[i] = this.vOut[i] = maxSpeed;
      this.change[i] = change;
    } else if (s === 0) {
      this.vIn[i] = this.vOut[i] = Math.min(maxSpeed, Math.sqrt(Math.min(F, B)));
      this.change[i] = 0;
    } else this.search(i, F, B, accel);
  }

  /**
   * Newton's method inside a bracket of q. Where it converges slowly, it bisects instead: another limit takes
   * over there, and Newton's steps would oscillate.
   */
  private search(corner: number, F: number, B: number, accel: number): void {
    const s = this.sine[corner];
    const maxSpeed = this.maxSpeed[corner];
    const reach = 2 * accel * this.tangent[corner];
    const c = 1 - 2 * s * s;
    let low = 0;
    let high = 2 * maxSpeed;
    let q = guess(Math.min(F, B), maxSpeed, reach, c);
    if (!(q > low && q < high)) q = 2 * s * maxSpeed;
    let before = Infinity;
    let v0 = maxSpeed;
    let v1 = maxSpeed;
    let used = q;
    for (let i = 0; i < 60; i++) {
      v0 = v1 = maxSpeed;
      let slope0 = 0;
      let slope1 = 0;
      if (maxSpeed * q >= reach) {
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
      if (Math.abs(excess) <= ROUNDING * maxSpeed + ACCURACY * q) break;
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

/** Relative differences of speed below this are rounding errors. */
const ROUNDING = 2e-15;

/** Relative accuracy of q, and so of |a| in the curve. */
const ACCURACY = 1e-9;

/**
 * A first estimate of q for a corner that is limited on one side only.
 *
 *   v² + v q = E                      the limited side
 *   w = R/q, R = 2 A L, or w = m      the other side: the speed that its tangent allows, or the speed limit
 *   q² = v² + w² − 2 c v w            the velocity change, with c = cos φ
 *
 * The first and last equation give v = (E + w² − q²)/(q + 2 c w). Substituting this into the first gives a
 * cubic: for w = R/q in z = q²/R, with b = E/R; for w = m in y = q/m, with b = E/m².
 */
function guess(E: number, m: number, R: number, c: number): number {
  let b = E / R;
  const min = R / (m * m);
  let p1 = 2 * (b - 2 * b * c * c + c);
  let p2 = 2 * b * c + 1 - b * b;
  let p3 = 2 * (b + c);
  if (1 + min * (p1 - min * (p2 + min * p3)) > 0) {
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
 * The smallest positive root of p0 + p1 z − p2 z² − p3 z³, from an estimate z: one step with z³ replaced by
 * z² times the estimate, then two steps of Halley's method.
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
