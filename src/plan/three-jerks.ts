/**
 * Three pieces of constant jerk, h seconds each, that match place, velocity and acceleration at both ends:
 *
 *   j1 = C − B    j2 = B − 2 j1    j3 = Sa − j1 − j2, where
 *   Sa = Δa/h     B = (Δv − 3 a0 h)/h² − Sa/2     C = (Δp − 3 v0 h − 9 a0 h²/2)/h³ − Sa/6
 */
import { SLACK, type RunLimits } from "./limits.js";

/** The three jerks of one axis that lead from (v0, a0) over `dp` to (v1, a1) in time 3 h. */
export function solveAxis(
  h: number,
  dp: number,
  v0: number,
  v1: number,
  a0: number,
  a1: number,
  jerks: Float64Array,
): void {
  const sa = (a1 - a0) / h;
  const b = (v1 - v0 - 3 * a0 * h) / (h * h) - sa / 2;
  const c = (dp - 3 * v0 * h - 4.5 * a0 * h * h) / (h * h * h) - sa / 6;
  jerks[0] = c - b;
  jerks[1] = b - 2 * jerks[0];
  jerks[2] = sa - jerks[0] - jerks[1];
}

/** Whether three jerks of `h` seconds each, from velocity (vx, vy) and acceleration (ax, ay), keep the limits. */
export function keepsJerkLimits(
  vx: number,
  vy: number,
  ax: number,
  ay: number,
  px: Float64Array,
  py: Float64Array,
  h: number,
  limits: RunLimits,
): boolean {
  const { accel, speed, jerk } = limits;
  for (let i = 0; i < 3; i++) {
    const jx = px[i]!;
    const jy = py[i]!;
    if (jx * jx + jy * jy > (jerk * SLACK) ** 2) return false;
    // Between two of four places in a piece, speed is at most |j| (h/4)²/8 above the greater of theirs.
    const most = speed * SLACK - (Math.sqrt(jx * jx + jy * jy) * h * h) / 128;
    for (let q = 1; q <= 4; q++) {
      const u = (h * q) / 4;
      const wx = vx + u * (ax + (u * jx) / 2);
      const wy = vy + u * (ay + (u * jy) / 2);
      if (most < 0 || wx * wx + wy * wy > most * most) return false;
    }
    vx += h * (ax + (h * jx) / 2);
    vy += h * (ay + (h * jy) / 2);
    ax += h * jx;
    ay += h * jy;
    if (ax * ax + ay * ay > (accel * SLACK) ** 2) return false;
  }
  return true;
}
