/**
 * Where the two knots between three pieces of constant acceleration should be that take the place of four:
 *
 *   old      |-----|--------|--------|-----|
 *   new      |--------|---------|----------|      first, second: shares of the second and third old piece
 *
 * For every place of the knots fewer-pieces.ts finds the velocities at them by least squares, and with these the distances d
 * from the plan's line. The knots go, by Gauss and Newton's method, to where those are smallest:
 *
 *   minimise  Σ wᵢ (dᵢ + Jᵢ Δ)²        Δ = (Δfirst, Δsecond),  wᵢ = |dᵢ| + BIG max |d|: the largest count most
 *
 * J is found by moving each knot a little, and after every step mended by what the step has shown (Broyden).
 */
import type { BlockColumns } from "./block-columns.js";
import { PLACES, type FewerPieces } from "./fewer-pieces.js";

/** Knots to begin with, and how far they are moved to find J. */
const FIRST = 0.4;
const SECOND = 0.6;
const LITTLE = 0.1;

/** Of each step, at most; of the squares of J, what holds it back; and of the largest distance, what all others count at least. */
const FARTHEST = 0.5;
const HELD = 0.003;
const BIG = 0.3;

/** The search goes on while the distance is below so many times what is allowed, until it is within the share GOOD of that. */
const HOPES = [3.5, 1.5, 1.1];
const GOOD = 0.75;

export class PieceKnots {
  first = FIRST;
  second = SECOND;
  private pieces!: BlockColumns;
  private i = 0;
  private later = 1;
  private floor = 0;
  /** Distances with the best knots so far, and how they change with each of the two. */
  private readonly left = new Float64Array(PLACES);
  private readonly j1 = new Float64Array(PLACES);
  private readonly j2 = new Float64Array(PLACES);
  private step1 = 0;
  private step2 = 0;

  constructor(private readonly fewer: FewerPieces) {}

  /**
   * Looks for the knots between three pieces for [i, i + 4) of `pieces`, which `fewer` has open, everything `later` times as
   * long, and none shorter than `floor` seconds. False where no knots bring them within `near` mm of the line.
   */
  search(pieces: BlockColumns, i: number, later: number, floor: number, near: number): boolean {
    const { fewer, left } = this;
    this.pieces = pieces;
    this.i = i;
    this.later = later;
    this.floor = floor;
    this.first = FIRST;
    this.second = SECOND;
    let best = this.fit(FIRST, SECOND, later);
    if (!(best < HOPES[0]! * near)) return false;
    left.set(fewer.left);
    if (best <= GOOD * near && fewer.boundThree(near) < near) return true;
    if (!this.tryOut(this.j1, LITTLE, 0) || !this.tryOut(this.j2, 0, LITTLE)) return false;
    for (let round = 1; round < HOPES.length; round++) {
      this.findStep(best);
      const far = this.fit(this.first + this.step1, this.second + this.step2, later);
      if (far === Infinity) break;
      this.mend();
      if (far < best) {
        best = far;
        this.first += this.step1;
        this.second += this.step2;
        left.set(fewer.left);
      }
      if (best <= GOOD * near) return true;
      if (!(best < HOPES[round]! * near)) return false;
    }
    return best < near;
  }

  /** Solves for the knots that were found, everything `later` times as long; returns what `boundThree` does. */
  solve(later: number, most: number): number {
    return this.fit(this.first, this.second, later) < Infinity ? this.fewer.boundThree(most) : Infinity;
  }

  /** How far three pieces with these knots are from the line; Infinity where one would be below the floor. */
  private fit(first: number, second: number, later: number): number {
    const { durationS, vx, vy, ax, ay } = this.pieces;
    const { i, floor } = this;
    const u = first * durationS[i + 1]!;
    const v = second * durationS[i + 2]!;
    const h1 = (durationS[i]! + u) * later;
    const h2 = (durationS[i + 1]! - u + v) * later;
    const h3 = (durationS[i + 2]! - v + durationS[i + 3]!) * later;
    if (!(h1 >= floor && h2 >= floor && h3 >= floor)) return Infinity;
    return this.fewer.fitThree(h1, h2, h3, vx[i + 1]! + u * ax[i + 1]!, vy[i + 1]! + u * ay[i + 1]!);
  }

  /** Puts how the distances change into `change`, for the one knot that is moved. */
  private tryOut(change: Float64Array, d1: number, d2: number): boolean {
    if (this.fit(this.first + d1, this.second + d2, this.later) === Infinity) return false;
    const { left, fewer } = this;
    const inverse = 1 / (d1 + d2);
    for (let p = 0; p < PLACES; p++) change[p] = (fewer.left[p]! - left[p]!) * inverse;
    return true;
  }

  private findStep(best: number): void {
    const { left, j1, j2 } = this;
    let a11 = 0;
    let a12 = 0;
    let a22 = 0;
    let b1 = 0;
    let b2 = 0;
    for (let p = 0; p < PLACES; p++) {
      const d = left[p]!;
      const g1 = j1[p]!;
      const g2 = j2[p]!;
      const w = Math.abs(d) + BIG * best;
      a11 += w * g1 * g1;
      a12 += w * g1 * g2;
      a22 += w * g2 * g2;
      b1 -= w * g1 * d;
      b2 -= w * g2 * d;
    }
    const held = HELD * (a11 + a22);
    a11 += held;
    a22 += held;
    const inverse = 1 / (a11 * a22 - a12 * a12);
    this.step1 = clamped((b1 * a22 - b2 * a12) * inverse);
    this.step2 = clamped((a11 * b2 - a12 * b1) * inverse);
  }

  /** Brings J to what the step from `left` to the distances found last says. */
  private mend(): void {
    const { left, j1, j2, step1, step2, fewer } = this;
    const length2 = step1 * step1 + step2 * step2;
    if (!(length2 > 0)) return;
    for (let p = 0; p < PLACES; p++) {
      const miss = (fewer.left[p]! - left[p]! - j1[p]! * step1 - j2[p]! * step2) / length2;
      j1[p]! += miss * step1;
      j2[p]! += miss * step2;
    }
  }
}

/** NaN, of a search that has no way to go, is no step. */
const clamped = (step: number): number =>
  step > -FARTHEST ? Math.min(FARTHEST, step) : step < 0 ? -FARTHEST : 0;
