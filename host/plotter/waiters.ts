/** Promises that settle when a condition becomes true, or when the source of the condition ends. */
export class Waiters {
  private waiting: { until: () => boolean; resolve: () => void; reject: (error: Error) => void }[] = [];
  private ended: Error | true | null = null;

  until(condition: () => boolean): Promise<void> {
    return new Promise((resolve, reject) => {
      this.waiting.push({ until: condition, resolve, reject });
      this.check();
    });
  }

  /** Call when nothing more will change: all waiting promises resolve, or reject with the error. */
  end(how: Error | true): void {
    this.ended = how;
    this.check();
  }

  /** Call after a change: settles the promises whose condition is now true. */
  check(): void {
    const waiting = this.waiting;
    this.waiting = waiting.filter(({ until, resolve, reject }) => {
      if (this.ended instanceof Error) reject(this.ended);
      else if (this.ended || until()) resolve();
      else return true;
      return false;
    });
  }
}
