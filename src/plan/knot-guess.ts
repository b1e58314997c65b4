/**
 * Where the knots between fewer pieces of constant acceleration should be, from the jumps of acceleration at the old ones.
 *
 *   a ^        .--- j2           j1, j2   jumps at t1 and t2, to the left of the line
 *     |   j1 |                   one      J = j1 + j2 at (j1 t1 + j2 t2)/J: their centre
 *     |  ----'                   two      for three jumps: two places such that any cubic has the same sum over both
 *     +----t1--t2----> t
 *
 * A piece's way is its acceleration summed twice, so the difference of old and new pieces is Σ j (t − tᵢ)²/2 of each. It vanishes
 * after the last knot where the sums of j, j t and j t² are the same for both, and is small where the next one is too. Those are
 * the nodes of Gauss's quadrature, of one and of two points, for the jumps as weights: zeros of the polynomial that is square to
 * all of lower degree. With weights of one sign they lie between the old knots; so for two |j| is used.
 *
 * What is left to the line's own frame (it turns) and to the limits is for whoever tries the knots out.
 */
import type { BlockColumns } from "./block-columns.js";
import type { PieceNotes } from "./piece-notes.js";

/** A knot is not guessed nearer to an end than this share of the whole. */
const EDGE = 0.25;

/** How much jumps along the line count beside those across it: they say where pieces speed up and brake. */
const ALONG = 0.1;

export class KnotGuess {
  /** The knot between two pieces in the place of three, as a share of their time: by jumps across the line; by all. */
  across = 0.5;
  both = 0.5;
  /** The knots between three in the place of four, as shares of the second and third of those. */
  first = 0.5;
  second = 0.5;

  /** For two in the place of [i, i + 3). */
  forTwo({ durationS, ax, ay }: BlockColumns, { jump }: PieceNotes, i: number): void {
    const d0 = durationS[i]!;
    const d1 = durationS[i + 1]!;
    const T = d0 + d1 + durationS[i + 2]!;
    const x1 = ax[i + 1]! - ax[i]!;
    const y1 = ay[i + 1]! - ay[i]!;
    const x = ax[i + 2]! - ax[i]!;
    const y = ay[i + 2]! - ay[i]!;
    const later = jump[i + 2]! / (jump[i + 1]! + jump[i + 2]!);
    this.across = inside((d0 + later * d1) / T);
    this.both = inside((d0 + (1 - (x1 * x + y1 * y) / (x * x + y * y)) * d1) / T);
  }

  /** For three in the place of [i, i + 4). */
  forThree(pieces: BlockColumns, notes: PieceNotes, i: number): void {
    const d1 = pieces.durationS[i + 1]!;
    const d2 = pieces.durationS[i + 2]!;
    const w1 = weightOf(pieces, notes, i + 1);
    const w2 = weightOf(pieces, notes, i + 2);
    const w3 = weightOf(pieces, notes, i + 3);
    // Moments, seen from the knot in the middle; nodes are the zeros of t² + 2 b t + c.
    const m0 = w1 + w2 + w3;
    const m1 = w3 * d2 - w1 * d1;
    const m2 = w3 * d2 * d2 + w1 * d1 * d1;
    const m3 = w3 * d2 * d2 * d2 - w1 * d1 * d1 * d1;
    const per = 1 / (m1 * m1 - m0 * m2);
    const b = ((m3 * m0 - m2 * m1) * per) / 2;
    const c = (m2 * m2 - m1 * m3) * per;
    const root = Math.sqrt(Math.max(0, b * b - c));
    this.first = between(1 - (b + root) / d1, 0.4);
    this.second = between((root - b) / d2, 0.6);
  }
}

function weightOf({ ax, ay }: BlockColumns, { jump }: PieceNotes, k: number): number {
  const dx = ax[k]! - ax[k - 1]!;
  const dy = ay[k]! - ay[k - 1]!;
  return Math.abs(jump[k]!) + ALONG * Math.sqrt(dx * dx + dy * dy);
}

/** NaN, of jumps that are none, is as near to the beginning as may be. */
const inside = (share: number): number => (share > EDGE ? Math.min(share, 1 - EDGE) : EDGE);

const between = (share: number, otherwise: number): number => (share >= 0 && share <= 1 ? share : otherwise);
