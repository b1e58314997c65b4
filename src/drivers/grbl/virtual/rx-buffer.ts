/** The receive buffer of the virtual Grbl: characters that arrive when it is full are lost silently. */
export class RxBuffer {
  lostCount = 0;
  private text = "";

  constructor(private readonly size: number) {}

  get freeCount(): number {
    return this.size - this.text.length;
  }

  /** The first line that has arrived whole. */
  get line(): string | null {
    const end = this.text.indexOf("\n");
    return end < 0 ? null : this.text.slice(0, end);
  }

  push(character: string): void {
    if (this.freeCount > 0) this.text += character;
    else this.lostCount++;
  }

  dropLine(): void {
    this.text = this.text.slice(this.text.indexOf("\n") + 1);
  }

  clear(): void {
    this.text = "";
  }
}
