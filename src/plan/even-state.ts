/**
 * The state that a long piece should end in. A plan's own velocity at one instant follows the chords of the flattened
 * curve, which zigzag about it; a piece of 200 ms carries half of that error times its length. So the state is taken
 * from seven places of the plan, r seconds apart, by least squares (Savitzky and Golay 1964):
 *
 *   slope    Σ i pᵢ / 28 r                        = v + 7/6 r² p‴
 *   third    (p₃ − p₂ − p₁ + p₋₁ + p₋₂ − p₋₃) / 6 r³ = p‴
 *
 * The best parabolas of h seconds through a cubic, one after the other, meet where they are h² p‴/12 slower than it
 * (the error is the third Bernoulli polynomial), so their common velocity is  slope − (7/6 r² + h²/12) third.
 */
import type { BlockColumns } from "./block-columns.js";

/** Half of the time that the seven places span, by that of a piece. */
const REACH = 1;

export class EvenState {
  vx = 0;
  vy = 0;
  /** Seven x, then seven y. */
  private readonly places = new Float64Array(14);

  /**
   * Finds the velocity, at the beginning of block `m` > 0 of the run in `from` (constant accelerations), that
   * suits pieces of `h` seconds on both sides. Near the ends of the run the places stand closer.
   */
  find(from: BlockColumns, m: number, h: number): void {
    const t = from.startS[m]!;
    const r = Math.min(REACH * h, t - from.startS[0]!, from.clockS - t) / 3;
    this.look(from, m, t, r);
    const sharpen = (7 / 6 + (h * h) / (12 * r * r)) / r;
    this.vx = slope(this.places, 0) / r - sharpen * third(this.places, 0);
    this.vy = slope(this.places, 7) / r - sharpen * third(this.places, 7);
  }

  private look(from: BlockColumns, m: number, t: number, r: number): void {
    const { places } = this;
    let i = m;
    while (i > 0 && from.startS[i]! > t - 3 * r) i--;
    for (let j = 0; j < 7; j++) {
      const at = t + (j - 3) * r;
      while (i + 1 < from.count && from.startS[i + 1]! <= at) i++;
      const u = at - from.startS[i]!;
      places[j] = from.x[i]! + u * (from.vx[i]! + (u * from.ax[i]!) / 2);
      places[j + 7] = from.y[i]! + u * (from.vy[i]! + (u * from.ay[i]!) / 2);
    }
  }
}

function slope(p: Float64Array, i: number): number {
  return (3 * (p[i + 6]! - p[i]!) + 2 * (p[i + 5]! - p[i + 1]!) + (p[i + 4]! - p[i + 2]!)) / 28;
}

function third(p: Float64Array, i: number): number {
  return (p[i + 6]! - p[i]! - (p[i + 5]! - p[i + 1]!) - (p[i + 4]! - p[i + 2]!)) / 6;
}
