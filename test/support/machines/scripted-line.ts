import { PlotwrightError, type Transport } from "../../../src/index.js";

/** The far end of a connection, simulated by a test: records what was written and sends what the test wants. */
export class ScriptedLine implements Transport {
  /** Command lines written so far. */
  readonly written: string[] = [];
  closed = false;
  private partial = "";
  private dataListener: ((bytes: Uint8Array) => void) | null = null;
  private closeListener: ((error?: Error) => void) | null = null;

  /** `answer` returns the reply bytes to each command; null: no reply. */
  constructor(
    private answer: (line: string) => string | null = () => null,
    private readonly lineEnd = "\r",
  ) {}

  answerWith(answer: (line: string) => string | null): void {
    this.answer = answer;
  }

  write(bytes: Uint8Array): Promise<void> {
    if (this.closed) return Promise.reject(new PlotwrightError("disconnected", "The line is closed."));
    this.partial += Buffer.from(bytes).toString("latin1");
    const lines = this.partial.split(this.lineEnd);
    this.partial = lines.pop()!;
    for (const line of lines) {
      this.written.push(line);
      const reply = this.answer(line);
      if (reply !== null) this.say(reply);
    }
    return Promise.resolve();
  }

  say(text: string): void {
    this.dataListener?.(Buffer.from(text, "latin1"));
  }

  lose(error?: Error): void {
    this.closed = true;
    this.closeListener?.(error);
  }

  onData(listener: (bytes: Uint8Array) => void): void {
    this.dataListener = listener;
  }

  onClose(listener: (error?: Error) => void): void {
    this.closeListener = listener;
  }

  close(): Promise<void> {
    this.closed = true;
    return Promise.resolve();
  }
}
