import type { Clock, Transport } from "../../../src/index.js";

/**
 * A host that stalls from time to time, like a process under SIGSTOP, a garbage collection or a busy machine: the
 * board continues, but no timer fires and no byte is read until the host continues too.
 */
export class StallingHost {
  private stalled = false;
  private readonly dueTimers: (() => void)[] = [];
  private readonly arrived: (() => void)[] = [];

  constructor(private readonly world: Clock) {}

  /** Stalls for `stallS` at the end of every `everyS`. Returns a function that ends this. */
  stallRegularly(everyS: number, stallS: number): () => void {
    let cancel = (): void => undefined;
    const begin = (): void => {
      cancel = this.stallFor(stallS, () => (cancel = this.world.after(everyS - stallS, begin)));
    };
    cancel = this.world.after(everyS - stallS, begin);
    return () => cancel();
  }

  stallFor(stallS: number, over: () => void = () => undefined): () => void {
    this.stalled = true;
    return this.world.after(stallS, () => {
      this.stalled = false;
      // As in an event loop, timers that are due come before the bytes that have arrived.
      for (const callback of [...this.dueTimers.splice(0), ...this.arrived.splice(0)]) callback();
      over();
    });
  }

  readonly clock: Clock = {
    nowS: () => this.world.nowS(),
    after: (delayS, callback) => {
      let cancelled = false;
      const cancel = this.world.after(delayS, () =>
        this.whenAwake(this.dueTimers, () => cancelled || callback()),
      );
      return () => {
        cancelled = true;
        cancel();
      };
    },
  };

  /** The same connection, as the stalling host sees it; in addition, every reply comes `delayS` late. */
  transport(line: Transport, delayS = 0): Transport {
    return {
      write: (bytes) => line.write(bytes),
      onData: (listener) =>
        line.onData(
          (bytes) => void this.world.after(delayS, () => this.whenAwake(this.arrived, () => listener(bytes))),
        ),
      onClose: (listener) => line.onClose(listener),
      close: () => line.close(),
    };
  }

  private whenAwake(waiting: (() => void)[], callback: () => void): void {
    if (this.stalled) waiting.push(callback);
    else callback();
  }
}
