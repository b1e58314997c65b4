/** Promises that settle when a condition has come true, or when what they wait on has ended. */
export class Waiters {
  private waiting: { until: () => boolean; resolve: () => void; reject: (error: Error) => void }[] = [];
  private ended: Error | true | null = null;

  until(condition: () => boolean): Promise<void> {
    return new Promise((resolve, reject) => {
      this.waiting.push({ until: condition, resolve, reject });
      this.check();
    });
  }

  /** Nothing more will change: everything that waits resolves, or rejects with an error. */
  end(how: Error | true): void {
    this.ended = how;
    this.check();
  }

  /** Something has changed. */
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
