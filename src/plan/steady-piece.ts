/**
 * The next long piece of a fitted run: by least squares over two pieces of h seconds each, of which the first is used
 * (a receding horizon: the second keeps the first from spoiling what comes after).
 *
 *   from place X, velocity W:   q(u) = X + W u + a₁ φ₁(u) + a₂ φ₂(u)       0 ≤ u ≤ 2 h
 *   φ₁ = u²/2, after h: h u − h²/2          φ₂ = 0, after h: (u − h)²/2
 *
 *   minimise  Σ ‖q(uᵢ) − p(τ + uᵢ)‖²  over six instants of the plan p, where being beside the line counts fully
 *   and being early or late on it by ALONG² of that:   ‖d‖² = (d·n)² + ALONG² (d·t)²
 *
 * With N = n nᵀ + ALONG² t tᵀ that is a symmetric system of 2 × 2 blocks
 *
 *   | Σφ₁²N    Σφ₁φ₂N | |a₁|   | Σφ₁N r |
 *   | Σφ₁φ₂N   Σφ₂²N  | |a₂| = | Σφ₂N r |        r = p − X − W u
 */
import type { BlockColumns } from "./block-columns.js";

/** Instants looked at, in each of the two pieces: a third, two thirds and all of the way. */
const LOOKS = 3;

/** How much being early or late on the line weighs against being beside it. */
const ALONG = 0.06;

const U = Float64Array.from({ length: 2 * LOOKS }, (_, i) => (i + 1) / LOOKS);
const PHI1 = U.map((u) => (u <= 1 ? (u * u) / 2 : u - 0.5));
const PHI2 = U.map((u) => (u <= 1 ? 0 : ((u - 1) * (u - 1)) / 2));
const SUM11 = PHI1.reduce((sum, f) => sum + f * f, 0);
const SUM12 = PHI1.reduce((sum, f, s) => sum + f * PHI2[s]!, 0);
const SUM22 = PHI2.reduce((sum, g) => sum + g * g, 0);

/** (mm/s)²: of no account beside any speed². */
const AT_REST = 1e-30;

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
  /** Normals of the line, as long as its velocity, and how far along them it is from start and velocity; 1/|n|². */
  private readonly nr = new Float64Array(2 * LOOKS);
  private readonly nx = new Float64Array(2 * LOOKS);
  private readonly ny = new Float64Array(2 * LOOKS);
  private readonly per = new Float64Array(2 * LOOKS);

  /** @param mayShift whether pieces may be early or late on the line */
  constructor(mayShift: boolean) {
    this.along2 = mayShift ? ALONG * ALONG : 1;
  }

  /** Finds the piece of `h` seconds from `start`; the plan must go on for 2 h at least. */
  solve(from: BlockColumns, start: PieceStart, h: number): void {
    const { along2, nr, nx, ny, per } = this;
    const { startS, x, y, vx, vy, ax, ay } = from;
    const { tau, x: x0, y: y0, vx: vx0, vy: vy0 } = start;
    const last = from.count - 1;
    const beside2 = 1 - along2;
    let i = start.k;
    // N = ALONG² I + (1 − ALONG²) n nᵀ: sums of the second part only, and n₂² = 1 − n₁².
    let p1 = 0;
    let p2 = 0;
    let q1 = 0;
    let q2 = 0;
    let r1 = 0;
    let r2 = 0;
    let bx = 0;
    let by = 0;
    let cx = 0;
    let cy = 0;
    for (let s = 0; s < 2 * LOOKS; s++) {
      const u = U[s]! * h;
      const t = tau + u;
      while (i < last && startS[i + 1]! <= t) i++;
      const d = t - startS[i]!;
      const wx0 = vx[i]!;
      const wy0 = vy[i]!;
      const wx = wx0 + d * ax[i]!;
      const wy = wy0 + d * ay[i]!;
      const dx = x[i]! + (d * (wx0 + wx)) / 2 - x0 - u * vx0;
      const dy = y[i]! + (d * (wy0 + wy)) / 2 - y0 - u * vy0;
      // At rest the line has no direction; any will do.
      const per2 = 1 / (wx * wx + wy * wy + AT_REST);
      const off = wx * dy - wy * dx;
      nr[s] = off;
      nx[s] = -wy;
      ny[s] = wx;
      per[s] = per2;
      const across = beside2 * off * per2;
      const ex = along2 * dx - across * wy;
      const ey = along2 * dy + across * wx;
      const n1 = wy * wy * per2;
      const n2 = -wx * wy * per2;
      const f = PHI1[s]!;
      const ff = f * f;
      p1 += ff * n1;
      p2 += ff * n2;
      bx += f * ex;
      by += f * ey;
      if (s < LOOKS) continue;
      const g = PHI2[s]!;
      const fg = f * g;
      const gg = g * g;
      q1 += fg * n1;
      q2 += fg * n2;
      r1 += gg * n1;
      r2 += gg * n2;
      cx += g * ex;
      cy += g * ey;
    }
    const both = 1 + along2;
    p1 = along2 * SUM11 + beside2 * p1;
    p2 *= beside2;
    const p3 = both * SUM11 - p1;
    q1 = along2 * SUM12 + beside2 * q1;
    q2 *= beside2;
    const q3 = both * SUM12 - q1;
    r1 = along2 * SUM22 + beside2 * r1;
    r2 *= beside2;
    const r3 = both * SUM22 - r1;
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
    let most = 0;
    for (let s = 0; s < 2 * LOOKS; s++) {
      const f = PHI1[s]!;
      const g = PHI2[s]!;
      const off = nr[s]! - nx[s]! * (a1x * f + a2x * g) - ny[s]! * (a1y * f + a2y * g);
      const off2 = off * off * per[s]!;
      if (!(off2 <= most)) most = off2;
    }
    this.ax = a1x / (h * h);
    this.ay = a1y / (h * h);
    this.beside = Math.sqrt(most);
  }

  /** How far to the left of the line the pen is in the middle of the piece that was solved last, about, if (ax, ay) is its acceleration. */
  leftHalfway(h: number, ax: number, ay: number): number {
    return (this.left(0, h, ax, ay) + this.left(1, h, ax, ay)) / 2;
  }

  /** And at its end. */
  leftAtEnd(h: number, ax: number, ay: number): number {
    return this.left(LOOKS - 1, h, ax, ay);
  }

  private left(look: number, h: number, ax: number, ay: number): number {
    const left = h * h * PHI1[look]! * (this.nx[look]! * ax + this.ny[look]! * ay) - this.nr[look]!;
    return left * Math.sqrt(this.per[look]!);
  }
}
