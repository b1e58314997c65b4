/**
 * Where the board stands on its own time line, seen from the host.
 *
 * The host cannot ask the board for the time, and an answer may have lain unread for as long as the host was
 * stalled. What it does know: a command cannot begin before it was written, and an answer that needed a free
 * place in the board's queue proves that some command had begun *by then*.
 *
 *   origin   host clock at the board's time 0, seconds; board time now = clock − origin
 *   proof    "command beginning at board time t has begun", heard at host time h:  origin ≤ h − t
 *
 * A proof is late by the line's delay and the host's own stalls. So the estimate follows it upward slowly: one late
 * answer does not make the host believe that the board is behind, many in a row (a board whose seconds are longer
 * than ours) do.
 *
 * An answer can also be counted one command too early or too late: a stray OK, or one lost on the line. A single
 * acknowledgement therefore moves the estimate by no more than the two clocks can have drifted apart. What the board
 * says when it is asked how many commands wait is sure, and is believed at once.
 */
const UPWARD_SHARE = 0.1;
/** What one acknowledgement can move the estimate by: this and a share of the time since the one before. */
const STEP_S = 0.005;
const DRIFT_SHARE = 0.01;

export class BoardPace {
  private originS = 0;
  private running = false;
  private lastBegunS = 0;

  /** Estimated board time. Below 0 before the first command. */
  boardS(nowS: number): number {
    return this.running ? nowS - this.originS : 0;
  }

  /**
   * A command that begins at `startS` is written now. Returns how long the board has stood dry waiting for
   * it, seconds; its time line stood still meanwhile.
   */
  written(startS: number, nowS: number): number {
    if (!this.running) {
      this.running = true;
      this.lastBegunS = nowS;
      this.originS = nowS - startS;
      return 0;
    }
    const dryS = nowS - this.originS - startS;
    if (dryS > 0) this.originS += dryS;
    return Math.max(0, dryS);
  }

  /** An acknowledgement: the command beginning at `startS` has begun. `waited`: it came when that had just begun. */
  acknowledged(startS: number, nowS: number, waited: boolean): void {
    const mostS = STEP_S + DRIFT_SHARE * (nowS - this.lastBegunS);
    const byS = Math.min(mostS, Math.max(-mostS, nowS - startS - this.originS));
    if (byS < 0) this.originS += byS;
    else if (waited) this.originS += UPWARD_SHARE * byS;
    this.lastBegunS = nowS;
  }

  /** Proof that the command beginning at `startS` has begun. */
  begun(startS: number, nowS: number): void {
    this.originS = Math.min(this.originS, nowS - startS);
  }

  /** Proof that the command ending at `endS` had not ended when the board answered. */
  notEnded(endS: number, nowS: number): void {
    this.originS = Math.max(this.originS, nowS - endS);
  }
}
