/** Received bytes, split into lines, each with the tick at which its end arrives. */
const CR = 13;
const LF = 10;
const BACKSPACE = 8;
const KEPT_BYTES = 300;

interface Line {
  readonly text: string;
  readonly arrivalTick: number;
  readonly byteCount: number;
}

export class InputLines {
  private readonly lines: Line[] = [];
  private partial = "";
  private partialBytes = 0;
  private lastWasCr = false;
  private lastArrivalTick = 0;
  /** Number of bytes received and not parsed yet. */
  byteCount = 0;

  /** `ticksPerByte`: 0 for a connection whose speed does not matter. */
  receive(bytes: Uint8Array, nowTick: number, ticksPerByte: number): void {
    for (const byte of bytes) {
      this.lastArrivalTick = Math.max(this.lastArrivalTick + ticksPerByte, nowTick);
      this.byteCount++;
      this.partialBytes++;
      if (byte === CR || byte === LF) {
        const isPair = byte === LF && this.lastWasCr;
        this.lastWasCr = byte === CR;
        if (!isPair) this.endLine();
        continue;
      }
      this.lastWasCr = false;
      if (byte === BACKSPACE) this.partial = this.partial.slice(0, -1);
      else if (byte >= 32 && this.partial.length < KEPT_BYTES) this.partial += String.fromCharCode(byte);
    }
  }

  /** Tick at which the next line is complete; Infinity if there is none. */
  get nextArrivalTick(): number {
    return this.lines[0]?.arrivalTick ?? Infinity;
  }

  take(): string {
    const line = this.lines.shift();
    if (line === undefined) return "";
    this.byteCount -= line.byteCount;
    return line.text;
  }

  clear(): void {
    this.lines.length = 0;
    this.partial = "";
    this.partialBytes = 0;
    this.byteCount = 0;
    this.lastArrivalTick = 0;
  }

  private endLine(): void {
    const byteCount = this.partialBytes;
    this.partialBytes = 0;
    if (this.partial === "") {
      this.byteCount -= byteCount;
      return;
    }
    this.lines.push({ text: this.partial, arrivalTick: this.lastArrivalTick, byteCount });
    this.partial = "";
  }
}
