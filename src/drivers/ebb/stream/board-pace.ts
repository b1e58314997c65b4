/**
 * The host's estimate of the board's time, counted along the commands.
 *
 * The host cannot query the board's time, and a reply may have been waiting unread while the host was stalled. But a
 * command cannot begin before it was written, and a reply that needed a free slot in the board's queue proves that some
 * command had begun by then.
 *
 *   origin   host clock at board time 0, seconds; board time now = clock − origin
 *   proof    "the command starting at board time t has begun", received at host time h:  origin ≤ h − t
 *
 * A proof is late by the connection's latency and the host's own stalls. So the origin increases only slowly: a single
 * late reply hardly changes it, but many in a row do, as with a board whose clock is slower than the host's.
 *
 * A stray or lost OK can also shift the count of replies by one command. So a single acknowledgement moves the estimate
 * by no more than the two clocks can have drifted apart. The reported number of waiting commands is reliable and
 * applies at once.
 */
const UPWARD_SHARE = 0.1;
/**
 * Max change of the estimate by one acknowledgement: this plus a share of the time since the previous one.
 */
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
   * Call when a command that starts at `startS` is written. Returns how long the board was without commands, seconds;
   * the board's time did not advance meanwhile.
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

  /**
   * An acknowledgement proves that the command starting at `startS` has begun. `waited`: the reply had to wait for that,
   * so the command has only just begun.
   */
  acknowledged(startS: number, nowS: number, waited: boolean): void {
    const maxS = STEP_S + DRIFT_SHARE * (nowS - this.lastBegunS);
    const byS = Math.min(maxS, Math.max(-maxS, nowS - startS - this.originS));
    if (byS < 0) this.originS += byS;
    else if (waited) this.originS += UPWARD_SHARE * byS;
    this.lastBegunS = nowS;
  }

  /** Proof that the command starting at `startS` has begun. */
  begun(startS: number, nowS: number): void {
    this.originS = Math.min(this.originS, nowS - startS);
  }

  /** Proof that the command ending at `endS` had not ended at the host's time `atS`. */
  notEnded(endS: number, atS: number): void {
    this.originS = Math.max(this.originS, atS - endS);
  }
}
