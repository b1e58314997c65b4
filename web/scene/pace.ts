/**
 * Measures how many pieces are drawn in a given time. Decides whether a picture is drawn in one part, and how large its
 * parts are otherwise. Has to be measured, because it varies by a factor of a thousand with the graphics card.
 */

/** Target time of a part: short enough not to delay the page or a newer picture. */
const PART_MS = 30;
/** A picture that takes no longer is drawn in one part. */
const QUICK_MS = 45;
const FIRST_GUESS = 400;
const MIN_PIECES_PER_MS = 10;
/** One measurement changes the estimate by at most this factor, because something else may have disturbed it. */
const MAX_STEP = 4;

export class Pace {
  #piecesPerMs = FIRST_GUESS;

  /** The number of pieces for one part. */
  get part(): number {
    return Math.round(this.#piecesPerMs * PART_MS);
  }

  isQuick(pieceCount: number): boolean {
    return pieceCount <= this.#piecesPerMs * QUICK_MS;
  }

  /**
   * Reports that a part of so many pieces took `ms`. A short time that is slower than the estimate is ignored, because
   * even one piece takes a turn of the event loop.
   */
  took(pieceCount: number, ms: number): void {
    const measured = pieceCount / Math.max(ms, 0.1);
    if (pieceCount === 0 || (measured < this.#piecesPerMs && ms <= PART_MS)) return;
    const bounded = Math.min(this.#piecesPerMs * MAX_STEP, Math.max(this.#piecesPerMs / MAX_STEP, measured));
    this.#piecesPerMs = Math.max(MIN_PIECES_PER_MS, bounded);
  }
}
