/**
 * The next long piece of a fitted run: by least squares over two pieces of h seconds each, of which the first is used
 * (a receding horizon: the second keeps the first from spoiling what comes after).
 *
 *   from place X, velocity W:   q(u) = X + W u + a₁ φ₁(u) + a₂ φ₂(u)       0 ≤ u ≤ 2 h
 *   φ₁ = u²/2, after h: h u − h²/2          φ₂ = 0, after h: (u − h)²/2
 *
 *   minimise  Σ ‖q(uᵢ) − p(τ + uᵢ)‖²  over eight instants of the plan p, where being beside the line counts fully
 *   and being early or late on it by ALONG² of that:   ‖d‖² = (d·n)² + ALONG² (d·t)²
 *
 * With N = n nᵀ + ALONG² t tᵀ that is a symmetric system of 2 × 2 blocks
 *
 *   | Σφ₁²N    Σφ₁φ₂N | |a₁|   | Σφ₁N r |
 *   | Σφ₁φ₂N   Σφ₂²N  | |a₂| = | Σφ₂N r |        r = p − X − W u
 */
import type { BlockColumns } from "./block-columns.js";

/** Instants looked at, in each of the two pieces. */
const LOOKS = 4;

/** How much being early or late on the line weighs against being beside it. */
const ALONG = 0.06;

const U = Float64Array.from({ length: 2 * LOOKS }, (_, i) => (i + 1) / LOOKS);
const PHI1 = U.map((u) => (u <= 1 ? (u * u) / 2 : u - 0.5));
const PHI2 = U.map((u) => (u <= 1 ? 0 : ((u - 1) * (u - 1)) / 2));

/** Where a piece begins: τ in block `k` of the plan, and the place and velocity there, which may be beside the plan's. */
export interface PieceStart {
  k: number;
  tau: number;
  x: number;
  y: number;
  vx: number;
  vy: number;
}

export class SteadyPiece {
  /** The first piece's acceleration. */
  ax = 0;
  ay = 0;
  /** Largest distance beside the line over both pieces, mm. */
  beside = 0;
  private readonly along2: number;
  private readonly rx = new Float64Array(2 * LOOKS);
  private readonly ry = new Float64Array(2 * LOOKS);
  /** Unit normals of the line. */
  private readonly nx = new Float64Array(2 * LOOKS);
  private readonly ny = new Float64Array(2 * LOOKS);

  /** @param mayShift whether pieces may be early or late on the line */
  constructor(mayShift: boolean) {
    this.along2 = mayShift ? ALONG * ALONG : 1;
  }

  /** Finds the piece of `h` seconds from `start`; the plan must go on for 2 h at least. */
  solve(from: BlockColumns, start: PieceStart, h: number): void {
    const { along2, rx, ry, nx, ny } = this;
    const { startS, x, y, vx, vy, ax, ay } = from;
    const last = from.count - 1;
    let i = start.k;
    let p1 = 0;
    let p2 = 0;
    let p3 = 0;
    let q1 = 0;
    let q2 = 0;
    let q3 = 0;
    let r1 = 0;
    let r2 = 0;
    let r3 = 0;
    let bx = 0;
    let by = 0;
    let cx = 0;
    let cy = 0;
    for (let s = 0; s < 2 * LOOKS; s++) {
      const u = U[s]! * h;
      const t = start.tau + u;
      while (i < last && startS[i + 1]! <= t) i++;
      const d = t - startS[i]!;
      const wx = vx[i]! + d * ax[i]!;
      const wy = vy[i]! + d * ay[i]!;
      const dx = x[i]! + (d * (vx[i]! + wx)) / 2 - start.x - u * start.vx;
      const dy = y[i]! + (d * (vy[i]! + wy)) / 2 - start.y - u * start.vy;
      const w = Math.sqrt(wx * wx + wy * wy);
      // At rest the line has no direction: then only the place counts, both ways alike.
      const ux = w > 0 ? -wy / w : 0;
      const uy = w > 0 ? wx / w : 0;
      rx[s] = dx;
      ry[s] = dy;
      nx[s] = ux;
      ny[s] = uy;
      const across = (1 - along2) * (ux * dx + uy * dy);
      const ex = along2 * dx + across * ux;
      const ey = along2 * dy + across * uy;
      const n1 = along2 + (1 - along2) * ux * ux;
      const n2 = (1 - along2) * ux * uy;
      const n3 = along2 + (1 - along2) * uy * uy;
      const f = PHI1[s]!;
      const ff = f * f;
      p1 += ff * n1;
      p2 += ff * n2;
      p3 += ff * n3;
      bx += f * ex;
      by += f * ey;
      if (s < LOOKS) continue;
      const g = PHI2[s]!;
      const fg = f * g;
      const gg = g * g;
      q1 += fg * n1;
      q2 += fg * n2;
      q3 += fg * n3;
      r1 += gg * n1;
      r2 += gg * n2;
      r3 += gg * n3;
      cx += g * ex;
      cy += g * ey;
    }
    // a₂ eliminated: (P − Q R⁻¹ Q) a₁ = b − Q R⁻¹ c, with G = Q R⁻¹.
    const det = 1 / (r1 * r3 - r2 * r2);
    const g11 = (q1 * r3 - q2 * r2) * det;
    const g12 = (q2 * r1 - q1 * r2) * det;
    const g21 = (q2 * r3 - q3 * r2) * det;
    const g22 = (q3 * r1 - q2 * r2) * det;
    const m1 = p1 - g11 * q1 - g12 * q2;
    const m2 = p2 - g11 * q2 - g12 * q3;
    const m3 = p3 - g21 * q2 - g22 * q3;
    const sx = bx - g11 * cx - g12 * cy;
    const sy = by - g21 * cx - g22 * cy;
    const inverse = 1 / (m1 * m3 - m2 * m2);
    const a1x = (sx * m3 - sy * m2) * inverse;
    const a1y = (sy * m1 - sx * m2) * inverse;
    const tx = cx - q1 * a1x - q2 * a1y;
    const ty = cy - q2 * a1x - q3 * a1y;
    const a2x = (tx * r3 - ty * r2) * det;
    const a2y = (ty * r1 - tx * r2) * det;
    let beside = 0;
    for (let s = 0; s < 2 * LOOKS; s++) {
      const f = PHI1[s]!;
      const g = PHI2[s]!;
      const off = Math.abs(nx[s]! * (rx[s]! - a1x * f - a2x * g) + ny[s]! * (ry[s]! - a1y * f - a2y * g));
      if (!(off <= beside)) beside = off;
    }
    this.ax = a1x / (h * h);
    this.ay = a1y / (h * h);
    this.beside = beside;
  }
}
