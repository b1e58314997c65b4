/**
 * The time cost of an isolated corner: seconds lost compared with a pen that turns at speed V as if direction
 * were free. Computed for each rule, together with the minimum for any motion that stays within δ of the
 * drawing.
 *
 *   y ^  \   φ turn         s = sin(φ/2), c = cos(φ/2); both sides are long, the pen comes and goes at V
 *     |   \     /           y along the bisector, into the corner's inside; x across it
 *     |    \ • /  apex at   A point of the bisector is y c from the sides: a path that passes within δ
 *     +-----V----> x        crosses it at y ≤ δ/c, and comes along the side at σ ≤ δ outside of it.
 *
 * The bound uses only that, |a| ≤ A and |v| ≤ V, and ignores the rest of the corridor, so nothing can be
 * faster. The average of two motions satisfies the same convex limits, so some symmetric motion is optimal,
 * with velocity along x at the bisector. With u the direction of approach and n its normal towards the
 * inside, the half before it loses
 *
 *     V λ = ∫ (V − v·u) dt − s y        c y = ∫ v·n dt − σ ≤ δ
 *
 * For any μ ≥ 0 a lower bound (Lagrangian duality) is the minimum of ∫ ℓ(v) dt − μ (δ + σ) + σ s/c, where ℓ =
 * V − v·u + (μ − s/c) v·n. For μ ≥ s/c that is minimal at σ = δ. Since ℓ ≥ 0 and dt ≥ |dv|/A, the rest is a
 * shortest path through the disc of velocities from V u to the x axis with weight ℓ/A. It is computed on a
 * polar grid, for the best of many μ.
 */
interface CornerCase {
  /** V mm/s, A mm/s², δ mm, φ rad. */
  readonly speed: number;
  readonly accel: number;
  readonly deviation: number;
  readonly turn: number;
}

/** Brake to the corner's speed, jump, speed up again. */
export function junctionLoss({ speed, accel, deviation, turn }: CornerCase): number {
  const c = Math.cos(turn / 2);
  const v = Math.min(speed, Math.sqrt((accel * deviation * c) / (1 - c)));
  return (speed - v) ** 2 / (accel * speed);
}

/** Brake to the parabola's speed; the parabola takes 2 v s/A and replaces 2 v² s/A mm; speed up again. */
export function blendLoss({ speed, accel, deviation, turn }: CornerCase): number {
  const s = Math.sin(turn / 2);
  const v = Math.min(speed, Math.sqrt(2 * accel * deviation) / s);
  return (speed - v) ** 2 / (accel * speed) + ((2 * v * s) / accel) * (1 - v / speed);
}

const RADII = 160;
const ANGLES = 40;

/** The minimum loss, s, within about 1 %; below 0 where the short cut saves more than the turn costs. */
export function leastLoss(corner: CornerCase): number {
  const { speed, accel, deviation, turn } = corner;
  const minMu = Math.tan(turn / 2);
  const scale = (speed * speed) / (2 * accel * deviation);
  const bound = (share: number): number => dualBound(corner, minMu + scale * share * share);
  // Concave in μ: ternary search.
  let [low, high] = [0, 2];
  for (let i = 0; i < 24; i++) {
    const [a, b] = [low + (high - low) / 3, high - (high - low) / 3];
    if (bound(a) < bound(b)) low = a;
    else high = b;
  }
  return bound((low + high) / 2);
}

/** For one μ, both halves. */
function dualBound({ speed, accel, deviation, turn }: CornerCase, mu: number): number {
  const weight = mu - Math.tan(turn / 2);
  const step = turn / 2 / ANGLES;
  const stepCos = Math.cos(step);
  const radius = (i: number): number => (speed * i) / RADII;
  let at = Float64Array.from({ length: RADII + 1 }, (_, i) => (speed - radius(i)) ** 2 / 2 / accel);
  for (let k = 0; k < ANGLES; k++) {
    const next = new Float64Array(RADII + 1).fill(Infinity);
    const angle = (k + 0.5) * step;
    const perRho = Math.cos(angle) - weight * Math.sin(angle);
    for (let j = 0; j <= RADII; j++) {
      // Between neighbouring angles speed changes by less than this.
      for (let i = Math.max(0, j - 24); i <= Math.min(RADII, j + 24); i++) {
        const [r0, r1] = [radius(i), radius(j)];
        const distance = Math.sqrt(r0 * r0 + r1 * r1 - 2 * r0 * r1 * stepCos);
        const cost = speed - ((r0 + r1) / 2) * perRho;
        next[j] = Math.min(next[j], at[i] + (distance * cost) / accel);
      }
    }
    at = next;
  }
  return (2 * (Math.min(...at) - deviation * (2 * mu - Math.tan(turn / 2)))) / speed;
}
