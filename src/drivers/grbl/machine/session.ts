/**
 * One Grbl over one transport: counts the unanswered characters, matches each `ok` or `error:n` to its line,
 * and detects a silent board. Knows nothing about motion.
 */
import { PlotwrightError } from "../../../errors.js";
import { lineClosed, lineLost, silent } from "../../faults.js";
import { asciiBytes, LineSplitter } from "../../line-splitter.js";
import { SessionLog } from "../../session-log.js";
import { SilenceWatch } from "../../silence-watch.js";
import { delay, type Clock, type Transport } from "../../transport.js";
import { QUEUE_MOVES, type Axes } from "../model/planner.js";
import {
  alarm,
  buffersOf,
  isGreeting,
  NOW,
  offsetOf,
  refusal,
  restarted,
  RX_BYTES,
  statusOf,
  versionOf,
  type Status,
} from "../protocol.js";

type Settle = (error: PlotwrightError | null) => void;

interface SentLine {
  readonly line: string;
  readonly settle: Settle;
}

/** Silence after which the board counts as gone, s; its status is polled meanwhile. */
const PATIENCE_S = 3;
const POLL_S = 0.5;
/** Reported by a reset during motion. */
const RESET_ALARM = 3;
/** An Arduino restarts when its port is opened, and does not answer for up to two seconds. */
const IDENTIFY_TRIES = 4;
const IDENTIFY_S = 1;

export class GrblSession {
  readonly log: SessionLog;
  version: string | null = null;
  /**
   * Set while a job is played: called when the board restarts, stops by itself or is lost, before the unanswered lines
   * are settled.
   */
  onBreak: ((error: PlotwrightError) => void) | null = null;

  private buffers = { queueMoves: QUEUE_MOVES, rxBytes: RX_BYTES };
  private sentBytes = 0;
  private sent: SentLine[] = [];
  private offset: Axes = [0, 0, 0];
  private statusWaiters: ((status: Status) => void)[] = [];
  private greetingWaiters: (() => void)[] = [];
  private failures: ((error: PlotwrightError) => void)[] = [];
  private readonly lines = new LineSplitter();
  private failure: PlotwrightError | null = null;
  private isIdentified = false;
  private resetting: Promise<Status> | null = null;
  private closed = false;
  private readonly silence: SilenceWatch;
  private cancelPoll: (() => void) | null = null;

  constructor(
    private readonly transport: Transport,
    private readonly clock: Clock,
    private readonly onLost: (error: PlotwrightError) => void,
  ) {
    this.log = new SessionLog(clock);
    this.silence = new SilenceWatch(clock, () => this.noAnswer());
    transport.onData((bytes) => this.lines.push(bytes, (line) => this.take(line)));
    transport.onClose(() => this.fail(lineLost()));
  }

  /** Resolves with the version. Rejects with `no-board` if another device answers, `board-timeout` if nothing does. */
  async identify(): Promise<string> {
    for (let i = 0; i < IDENTIFY_TRIES && this.version === null && !this.failure; i++) {
      // A Grbl that sleeps, holds or works for another program answers only after a reset.
      if (i > 0) this.now(NOW.reset);
      const tooLate = delay(this.clock, IDENTIFY_S);
      // The empty line ends a line that another program may have left unfinished.
      const answered = Promise.allSettled([this.send(""), this.send("$I")]).then(() => undefined);
      await Promise.race([answered, tooLate]);
      this.dropSent(silent("$I"));
      // A reply to an earlier attempt must not count for a later line.
      if (i > 0) await tooLate;
    }
    if (this.failure) throw this.failure;
    if (this.version === null) throw notGrbl(this.received());
    this.isIdentified = true;
    return this.version;
  }

  /** Whether the buffer has room for another line now. */
  hasRoom(line: string): boolean {
    return this.sent.length === 0 || this.sentBytes + line.length + 1 <= this.buffers.rxBytes;
  }

  /** Max accepted moves that are not done. */
  get queueMoves(): number {
    return this.buffers.queueMoves;
  }

  /** Sends one line; `settle` is called once, with its reply or an error. */
  write(line: string, settle: Settle): void {
    if (this.failure) return settle(this.failure);
    this.sent.push({ line, settle });
    this.sentBytes += line.length + 1;
    this.log.add("sent", line);
    this.put(`${line}\n`);
    // Not measured from an old reply.
    if (this.sent.length === 1) this.silence.expect(PATIENCE_S);
    if (!this.cancelPoll) this.poll();
  }

  /** Resolves when the line is accepted; for `G4` when everything before it is done. */
  send(line: string): Promise<void> {
    return new Promise((resolve, reject) => this.write(line, (error) => (error ? reject(error) : resolve())));
  }

  /** Sends a real-time command. */
  now(byte: string): void {
    if (byte !== NOW.status) this.log.add("sent", byte === NOW.reset ? "(reset)" : byte);
    this.put(byte);
  }

  status(): Promise<Status> {
    return this.within("its status", (resolve) => {
      this.statusWaiters.push(resolve);
      this.now(NOW.status);
    });
  }

  /** Resets Grbl, which clears its queue. Unanswered lines are settled with `conflict`. */
  reset(): Promise<Status> {
    // One at a time: the greeting after a second reset would look like a restart.
    this.resetting ??= this.resetOnce().finally(() => {
      this.resetting = null;
    });
    return this.resetting;
  }

  async close(): Promise<void> {
    if (this.closed) return;
    this.closed = true;
    this.fail(lineClosed());
    await this.transport.close();
  }

  private async resetOnce(): Promise<Status> {
    const greeted = this.within<void>("a reset", (resolve) => this.greetingWaiters.push(resolve));
    this.now(NOW.reset);
    await greeted;
    this.dropSent(stopped());
    return this.status();
  }

  /** A board that does not answer counts as lost. */
  private within<T>(what: string, begin: (resolve: (value: T) => void) => void): Promise<T> {
    return new Promise((resolve, reject) => {
      if (this.failure) return reject(this.failure);
      const silence = new SilenceWatch(this.clock, () => this.fail(silent(what)));
      silence.expect(PATIENCE_S);
      const failed = (error: PlotwrightError): void => {
        silence.stop();
        reject(error);
      };
      this.failures.push(failed);
      begin((value) => {
        silence.stop();
        this.failures = this.failures.filter((one) => one !== failed);
        resolve(value);
      });
    });
  }

  private put(text: string): void {
    this.transport.write(asciiBytes(text)).catch(() => this.fail(lineLost()));
  }

  private take(line: string): void {
    this.silence.expect(PATIENCE_S);
    this.offset = offsetOf(line) ?? this.offset;
    const status = statusOf(line, this.offset);
    if (status) {
      for (const waiter of this.statusWaiters.splice(0)) waiter(status);
      return;
    }
    this.log.add("received", line);
    this.version = versionOf(line) ?? this.version;
    this.buffers = buffersOf(line) ?? this.buffers;
    const refused = /^error:(\d+)/.exec(line);
    const alarmed = /^ALARM:(\d+)/.exec(line);
    if (line === "ok") this.settleFirst(null);
    else if (refused) this.settleFirst(Number(refused[1]));
    else if (alarmed) {
      const code = Number(alarmed[1]);
      if (code !== RESET_ALARM || this.greetingWaiters.length === 0) this.broken(alarm(code));
    } else if (isGreeting(line)) {
      const waiters = this.greetingWaiters.splice(0);
      if (waiters.length === 0) this.broken(restarted());
      for (const waiter of waiters) waiter();
    }
  }

  private settleFirst(code: number | null): void {
    const first = this.sent.shift();
    if (!first) return;
    this.sentBytes -= first.line.length + 1;
    first.settle(code === null ? null : refusal(first.line, code));
  }

  private broken(error: PlotwrightError): void {
    if (this.version === null) return;
    // Without a job, the machine would keep a position that is wrong now. Connecting again finds out the board's state.
    if (this.isIdentified && !this.onBreak) return this.fail(error);
    this.onBreak?.(error);
    this.dropSent(error);
  }

  private dropSent(error: PlotwrightError): void {
    this.sentBytes = 0;
    for (const { settle } of this.sent.splice(0)) settle(error);
  }

  /** While a reply is missing, polls the status: Grbl answers that even if a line waits for motion. */
  private poll(): void {
    this.cancelPoll = null;
    if (this.failure || this.sent.length === 0) return;
    this.cancelPoll = this.clock.after(POLL_S, () => {
      this.now(NOW.status);
      this.poll();
    });
  }

  private noAnswer(): void {
    if (this.sent.length === 0) return;
    // A device that has answered but is not identified is not a Grbl.
    const isOther = this.version === null && this.received().length > 0;
    this.fail(isOther ? notGrbl(this.received()) : silent(this.sent[0].line));
  }

  private received(): string[] {
    return this.log.receivedSince(0);
  }

  private fail(error: PlotwrightError): void {
    if (this.failure) return;
    this.failure = error;
    this.silence.stop();
    this.cancelPoll?.();
    this.log.add("note", error.message);
    this.onBreak?.(error);
    this.dropSent(error);
    for (const failed of this.failures.splice(0)) failed(error);
    if (!this.closed) this.onLost(error);
  }
}

const stopped = (): PlotwrightError => new PlotwrightError("conflict", "The machine was stopped.");

function notGrbl(received: readonly string[]): PlotwrightError {
  if (received.length === 0) return silent("its version");
  return new PlotwrightError(
    "no-board",
    `Something answers on this port, but it is not a Grbl: choose another device, or another machine. It sent: ${received.slice(-4).join("; ")}.`,
  );
}
