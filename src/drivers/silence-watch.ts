/**
 * Detects a board that does not answer in time.
 *
 * A host that is busy or suspended reads no replies, so that time must not count as silence. A late check shows that the
 * host was stalled. Before silence is reported, a last check leaves time to read a reply that has already arrived.
 *
 *   host    runs ──────|   busy for 3 s   |── runs ─────────────|
 *   checks  x    x    x   (due)           x    x    x    x  X       the board is silent at X
 *   counts  ──────────────|               |─────────────────|
 */
import type { Clock } from "./transport.js";

/** Max time between two checks, s. At most this much of a stall counts as silence. */
const CHECK_S = 0.25;
/** Time to read a reply that has already arrived, s. */
const READ_S = 0.05;

export class SilenceWatch {
  private sinceS = 0;
  private limitS = Infinity;
  private dueS = 0;
  private isLastCheck = false;
  private isStopped = false;
  private cancel: (() => void) | null = null;

  constructor(
    private readonly clock: Clock,
    /** Called once for each silence. */
    private readonly onSilent: () => void,
  ) {}

  /** From now on, an answer is expected within `limitS`. Infinity: none is expected. */
  expect(limitS: number): void {
    if (this.isStopped) return;
    this.sinceS = this.clock.nowS();
    this.limitS = limitS;
    this.isLastCheck = false;
    // A timer that runs is not replaced, because this is called for each reply.
    if (!this.cancel) this.checkAfter(Math.min(CHECK_S, limitS));
  }

  /** Stops for good: later calls of `expect` do nothing. */
  stop(): void {
    this.isStopped = true;
    this.limitS = Infinity;
    this.cancel?.();
    this.cancel = null;
  }

  private checkAfter(delayS: number): void {
    if (this.limitS === Infinity) return;
    this.dueS = this.clock.nowS() + delayS;
    this.cancel = this.clock.after(delayS, () => this.check());
  }

  private check(): void {
    this.cancel = null;
    const nowS = this.clock.nowS();
    this.sinceS = Math.min(nowS, this.sinceS + Math.max(0, nowS - this.dueS));
    const leftS = this.sinceS + this.limitS - nowS;
    if (leftS > 0) this.checkAfter(Math.min(CHECK_S, leftS));
    else if (!this.isLastCheck) {
      this.isLastCheck = true;
      this.checkAfter(READ_S);
    } else {
      this.limitS = Infinity;
      this.onSilent();
    }
  }
}
