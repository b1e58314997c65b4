/** The time of a virtual board that runs at infinite speed: it passes only in its moves, and while somebody waits for it. */
import type { Clock } from "../../transport.js";

interface Wait {
  readonly untilS: number;
  readonly callback: () => void;
}

export class InstantClock implements Clock {
  /** The earliest first. */
  private readonly waits: Wait[] = [];

  /**
   * @param realClock lets other work happen between two waits
   * @param board the board's time in seconds, and how to let it pass
   */
  constructor(
    private readonly realClock: Clock,
    private readonly board: { readonly nowS: () => number; readonly wait: (untilS: number) => void },
  ) {}

  nowS(): number {
    return this.board.nowS();
  }

  /** Motion need not wait for the moves before it. */
  latenessS(): number {
    return Infinity;
  }

  after(delayS: number, callback: () => void): () => void {
    const wait = { untilS: this.nowS() + Math.max(0, delayS), callback };
    const before = this.waits.findIndex(({ untilS }) => untilS > wait.untilS);
    this.waits.splice(before < 0 ? this.waits.length : before, 0, wait);
    const cancel = this.realClock.after(0, () => this.passFirst());
    return () => {
      const at = this.waits.indexOf(wait);
      if (at < 0) return;
      this.waits.splice(at, 1);
      cancel();
    };
  }

  /** There is one call for each wait, so all of them pass. */
  private passFirst(): void {
    const first = this.waits.shift();
    if (first === undefined) return;
    this.board.wait(first.untilS);
    first.callback();
  }
}
