/** Runs the command line in this process, and captures its output. */
import { Readable } from "node:stream";
import { runCli } from "../../../server/cli/program.js";
import type { CliIo } from "../../../server/cli/io.js";

export interface CliRun {
  readonly code: number;
  readonly out: string;
  readonly err: string;
}

export class CaughtIo implements CliIo {
  outText = "";
  errText = "";
  readonly isTerminal = false;
  hasKeyboard = true;
  /** What stdin gives. */
  inputText = "";
  private interruptListeners: ((isFinal: boolean) => void)[] = [];
  private lineListeners: ((line: string) => void)[] = [];

  out(text: string): void {
    this.outText += text;
  }

  err(text: string): void {
    this.errText += text;
  }

  onInterrupt(listener: (isFinal: boolean) => void): () => void {
    this.interruptListeners.push(listener);
    return () => (this.interruptListeners = this.interruptListeners.filter((one) => one !== listener));
  }

  endWithin(): void {}

  status(): void {}

  onLine(listener: (line: string) => void): () => void {
    this.lineListeners.push(listener);
    return () => (this.lineListeners = this.lineListeners.filter((one) => one !== listener));
  }

  inputLines(): AsyncIterable<string> {
    return Readable.from(this.inputText.split("\n").slice(0, -1));
  }

  /** Whether an interrupt is handled; otherwise it would end the process. */
  get listens(): boolean {
    return this.interruptListeners.length > 0;
  }

  interrupt(): void {
    [...this.interruptListeners].forEach((listener) => listener(false));
  }

  /** The process is asked to end: SIGTERM, or its terminal is closed. */
  end(): void {
    [...this.interruptListeners].forEach((listener) => listener(true));
  }

  line(text = ""): void {
    [...this.lineListeners].forEach((listener) => listener(text));
  }
}

export async function cli(...args: string[]): Promise<CliRun> {
  return cliWith(new CaughtIo(), ...args);
}

export async function cliWith(io: CaughtIo, ...args: string[]): Promise<CliRun> {
  const code = await runCli(args, io, "0.0.0");
  return { code, out: io.outText, err: io.errText };
}
