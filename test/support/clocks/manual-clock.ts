import type { Clock } from "../../../src/index.js";

interface Timer {
  readonly dueS: number;
  readonly order: number;
  readonly callback: () => void;
}

/** Time that passes only when a test says so. Timers fire in order; promises settle between them. */
export class ManualClock implements Clock {
  private timeS = 0;
  private timers: Timer[] = [];
  private created = 0;

  nowS(): number {
    return this.timeS;
  }

  /** Pending timers. */
  get timerCount(): number {
    return this.timers.length;
  }

  after(delayS: number, callback: () => void): () => void {
    const timer = { dueS: this.timeS + Math.max(0, delayS), order: this.created++, callback };
    this.insert(timer);
    return () => {
      const index = this.timers.indexOf(timer);
      if (index >= 0) this.timers.splice(index, 1);
    };
  }

  /** Advances the time and fires the timers that are due, including those that they start within that time. */
  async advance(byS: number): Promise<void> {
    const untilS = this.timeS + byS;
    await settle();
    while (this.timers.length > 0 && this.timers[0].dueS <= untilS) {
      const timer = this.timers.shift()!;
      this.timeS = Math.max(this.timeS, timer.dueS);
      timer.callback();
      await settle();
    }
    this.timeS = untilS;
  }

  /** Advances the time without firing a timer, as for a suspended process; then fires all that are due. */
  async sleep(byS: number): Promise<void> {
    this.timeS += byS;
    await this.advance(0);
  }

  /** Advances the time until the work is done. Throws if that takes more than `limitS`. */
  async run<T>(work: Promise<T>, limitS = 100_000): Promise<T> {
    let done = false;
    const finished = work.finally(() => {
      done = true;
    });
    finished.catch(() => undefined);
    const untilS = this.timeS + limitS;
    await settle();
    while (!done) {
      if (this.timers.length === 0) await loaded(() => done || this.timers.length > 0);
      if (done) break;
      const next = this.timers[0];
      if (!next) throw new Error("the work is not done, and no timer is pending");
      if (next.dueS > untilS) throw new Error(`the work is not done after ${limitS} s`);
      await this.advance(Math.max(0, next.dueS - this.timeS));
    }
    return finished;
  }

  private insert(timer: Timer): void {
    let at = this.timers.length;
    while (at > 0 && this.timers[at - 1].dueS > timer.dueS) at--;
    this.timers.splice(at, 0, timer);
  }
}

/** Work may load code, which takes real time. */
async function loaded(isLoaded: () => boolean): Promise<void> {
  for (let i = 0; i < 250 && !isLoaded(); i++) await new Promise((resolve) => setTimeout(resolve, 20));
}

/** Lets every promise that can settle do so, also at the end of a long chain of them. */
async function settle(): Promise<void> {
  for (let i = 0; i < 40; i++) await Promise.resolve();
}
