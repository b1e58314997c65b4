/** The lines that wait for their answers, and how much of the Grbl's receive buffer they may fill. */
import type { PlotwrightError } from "../../../errors.js";

export type Settle = (error: PlotwrightError | null) => void;

interface SentLine {
  readonly line: string;
  readonly settle: Settle;
  /** A check whose report has come. */
  isReported: boolean;
}

/**
 * Characters of the buffer that stay free: some boards have one less than they report, and a doubled answer lets one more line
 * be sent.
 */
const SPARE_BYTES = 32;

export class SentLines {
  private lines: SentLine[] = [];
  /** Line ends included. */
  private byteCount = 0;

  get count(): number {
    return this.lines.length;
  }

  get first(): SentLine | undefined {
    return this.lines.at(0);
  }

  hasRoom(line: string, rxBytes: number): boolean {
    return this.count === 0 || this.byteCount + line.length + 1 <= rxBytes - SPARE_BYTES;
  }

  add(line: string, settle: Settle): void {
    this.lines.push({ line, settle, isReported: false });
    this.byteCount += line.length + 1;
  }

  /** Takes the first one out. */
  next(): SentLine | undefined {
    const first = this.lines.shift();
    if (first) this.byteCount -= first.line.length + 1;
    return first;
  }

  settleAll(error: PlotwrightError): void {
    this.byteCount = 0;
    for (const { settle } of this.lines.splice(0)) settle(error);
  }
}
