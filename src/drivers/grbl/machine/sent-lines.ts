/** The lines that wait for their answers, and how much of the Grbl's receive buffer they may fill. */
import type { PlotwrightError } from "../../../errors.js";

export type Settle = (error: PlotwrightError | null) => void;

interface SentLine {
  readonly line: string;
  readonly settle: Settle;
  /** Otherwise it is sent again if it is not answered. */
  readonly isLast: boolean;
  /** A check whose report has come. */
  isReported: boolean;
}

/** Some boards have one character less than they report. */
const LESS_BYTES = 1;

export class SentLines {
  private lines: SentLine[] = [];
  /** Line ends included. */
  private byteCount = 0;
  /** Of the line that was answered last. */
  private lastBytes = 0;

  get count(): number {
    return this.lines.length;
  }

  get first(): SentLine | undefined {
    return this.lines.at(0);
  }

  /** After a doubled answer, the line that was answered last is still in the buffer. So there is always room for it. */
  hasRoom(line: string, rxBytes: number): boolean {
    return this.count === 0 || this.byteCount + line.length + 1 + this.lastBytes <= rxBytes - LESS_BYTES;
  }

  add(line: string, settle: Settle, isLast: boolean): void {
    this.lines.push({ line, settle, isLast, isReported: false });
    this.byteCount += line.length + 1;
  }

  /** Takes the first one out. */
  next(): SentLine | undefined {
    const first = this.lines.shift();
    if (first) {
      this.lastBytes = first.line.length + 1;
      this.byteCount -= this.lastBytes;
    }
    return first;
  }

  settleAll(error: PlotwrightError): void {
    this.byteCount = 0;
    for (const { settle } of this.lines.splice(0)) settle(error);
  }
}
