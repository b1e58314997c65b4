/** A running wait of the virtual Grbl: a G4, or the search for its switches. A hold interrupts it. */
export class Dwell {
  /** Machine seconds at which it ends, Infinity during a hold; null: none is running. */
  private untilS: number | null = null;
  /** What is left of it when the hold ends, s. */
  private leftS = 0;
  private then: () => void = () => undefined;

  get isRunning(): boolean {
    return this.untilS !== null;
  }

  /** When it ends; Infinity: never, as it is. */
  get nextS(): number {
    return this.untilS ?? Infinity;
  }

  start(untilS: number, then: () => void): void {
    this.untilS = untilS;
    this.then = then;
  }

  hold(nowS: number): void {
    if (this.untilS === null || this.untilS === Infinity) return;
    this.leftS = this.untilS - nowS;
    this.untilS = Infinity;
  }

  goOn(nowS: number): void {
    if (this.untilS === Infinity) this.untilS = nowS + this.leftS;
  }

  /** Returns what has to be done if it has ended by now; null: it has not. */
  takeEnded(nowS: number): (() => void) | null {
    if (this.untilS === null || this.untilS > nowS) return null;
    this.untilS = null;
    return this.then;
  }

  cancel(): void {
    this.untilS = null;
  }
}
