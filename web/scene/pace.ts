/**
 * How much the card draws in a given time, measured as it goes: what is quick enough for one part, and how large the
 * parts of a picture that is not may be. A card does not tell its speed, and without one it is a thousandth.
 */

/** A part as long as this keeps neither the page nor a newer picture waiting. */
const PART_MS = 30;
/** A picture that takes no longer is drawn in one go. */
const QUICK_MS = 45;
const FIRST_GUESS = 400;
const SLOWEST = 10;
/** One measure changes the guess by no more than this factor: it may have been of something else. */
const STEP = 4;

export class Pace {
  #piecesPerMs = FIRST_GUESS;

  /** Pieces for one part. */
  get part(): number {
    return Math.round(this.#piecesPerMs * PART_MS);
  }

  isQuick(pieceCount: number): boolean {
    return pieceCount <= this.#piecesPerMs * QUICK_MS;
  }

  /** A part of so many pieces was done after `ms`. Few pieces done soon tell nothing: even one takes a turn. */
  took(pieceCount: number, ms: number): void {
    const measured = pieceCount / Math.max(ms, 0.1);
    if (pieceCount === 0 || (measured < this.#piecesPerMs && ms <= PART_MS)) return;
    const bounded = Math.min(this.#piecesPerMs * STEP, Math.max(this.#piecesPerMs / STEP, measured));
    this.#piecesPerMs = Math.max(SLOWEST, bounded);
  }
}
