/**
 * The connection to a board that exchanges lines of text, in layers:
 *
 *   Transport     bytes: a serial port, Web Serial or a virtual board
 *   LineSession   lines: splits, writes and logs them; notices silence, a lost connection and the end
 *   LineProtocol  answers: which reply belongs to which line. Each driver has its own
 */
import { PlotwrightError } from "../errors.js";
import { lineClosed, lineLost } from "./faults.js";
import { asciiBytes, LineSplitter } from "./line-splitter.js";
import { SessionLog } from "./session-log.js";
import { SilenceWatch } from "./silence-watch.js";
import type { Clock, Transport } from "./transport.js";

export interface LineProtocol {
  /** Follows each line that is written. */
  readonly lineEnd: string;
  /** Called with each line from the board. */
  take(line: string): void;
  /** Whether a line from the board comes too often to be logged. Left out: none does. */
  isRoutine?(line: string): boolean;
  /** The board has been silent for as long as `expectWithin` allowed. */
  silent(): void;
  /** Called once, when the connection has failed or was closed: everything that waits fails with the error. */
  ended(error: PlotwrightError): void;
}

/** How a driver identifies its board. */
interface Identification<Found> {
  /** The board in words, with its article. */
  readonly board: string;
  readonly tries: number;
  /** Asks the board once. Resolves with null if the answer is missing or not understood. */
  attempt(index: number): Promise<Found | null>;
  /** Whether a line is certainly of such a board, for example a late answer. Left out: none is. */
  isOwn?(line: string): boolean;
}

/** Lines of another device that its error message quotes. */
const QUOTED_LINES = 4;

export class LineSession {
  readonly log: SessionLog;
  /** Why the session can no longer be used; null while it is usable. */
  failure: PlotwrightError | null = null;
  /** Something was received, even if it is no whole line. */
  hasHeard = false;
  private isClosed = false;
  private readonly splitter = new LineSplitter();
  private readonly silence: SilenceWatch;
  private readonly faultListeners: ((error: PlotwrightError) => void)[] = [];

  constructor(
    private readonly transport: Transport,
    private readonly protocol: LineProtocol,
    { clock, logLines }: { readonly clock: Clock; readonly logLines?: number | undefined },
  ) {
    this.log = new SessionLog(clock, logLines);
    this.silence = new SilenceWatch(clock, () => protocol.silent());
    transport.onData((bytes) => this.receive(bytes));
    transport.onClose((error) => this.fail(lostBy(error)));
  }

  /** Called once, when the connection is lost or the board stops answering, but not by `close`. */
  onFault(listener: (error: PlotwrightError) => void): void {
    this.faultListeners.push(listener);
  }

  /** Rejects with `board-timeout` if nothing answers, and with `no-board` if another device does. */
  async identify<Found>({ board, tries, attempt, isOwn }: Identification<Found>): Promise<Found> {
    const entryCount = this.log.count;
    for (let i = 0; i < tries; i++) {
      const found = await attempt(i);
      if (this.failure) throw this.failure;
      if (found !== null) return found;
    }
    const heard = this.log.receivedSince(entryCount);
    const isOther = this.hasHeard && !heard.some((line) => isOwn?.(line));
    throw isOther ? otherDevice(board, heard.slice(-QUOTED_LINES)) : nothingAnswers();
  }

  writeLines(lines: readonly string[]): void {
    for (const line of lines) this.log.add("sent", line);
    this.writeText(lines.map((line) => line + this.protocol.lineEnd).join(""));
  }

  /** Writes characters that are no line, and does not log them. */
  writeText(text: string): void {
    this.transport.write(asciiBytes(text)).catch((error: unknown) => this.fail(lostBy(error)));
  }

  /** From now on, the board counts as silent if nothing else is expected for `limitS`. Infinity: nothing is due. */
  expectWithin(limitS: number): void {
    this.silence.expect(limitS);
  }

  /** Ends the session because of an error. */
  fail(error: PlotwrightError): void {
    if (this.failure) return;
    this.end(error);
    for (const listener of this.faultListeners) listener(error);
  }

  /** Ends the session; whatever waits fails with `disconnected`. */
  async close(): Promise<void> {
    if (this.isClosed) return;
    this.isClosed = true;
    if (!this.failure) this.end(lineClosed());
    await this.transport.close();
  }

  private end(error: PlotwrightError): void {
    this.failure = error;
    this.silence.stop();
    this.log.add("note", error.message);
    this.protocol.ended(error);
  }

  private receive(bytes: Uint8Array): void {
    this.hasHeard = true;
    this.splitter.push(bytes, (line) => {
      if (!this.protocol.isRoutine?.(line)) this.log.add("received", line);
      this.protocol.take(line);
    });
  }
}

const lostBy = (error: unknown): PlotwrightError =>
  error instanceof PlotwrightError ? error : lineLost(error);

const nothingAnswers = (): PlotwrightError =>
  new PlotwrightError(
    "board-timeout",
    "Nothing answers on this port: check that it is the plotter's port, that the cable is plugged in firmly, and that no other program uses the port. Then unplug the board, plug it in and connect again.",
  );

function otherDevice(board: string, lines: readonly string[]): PlotwrightError {
  const received = lines.map((line) => JSON.stringify(line)).join(", ");
  return new PlotwrightError(
    "no-board",
    `Something answers on this port, but it is not ${board}: choose another device, or another machine.` +
      (received === "" ? "" : ` It sent: ${received}.`),
  );
}
