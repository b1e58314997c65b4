/**
 * One EiBotBoard over one transport: commands out in order, each reply given to its command, a watch on
 * silence, and a log of what was said. Knows nothing of motion.
 *
 * The board parses one command at a time and answers each when it has been queued or done; a motion command
 * whose turn in the queue has not come is answered late by design. So the watch measures how long the
 * *first* unanswered command has kept everything waiting, and each command says how much patience it needs.
 */
import { firmwareFeatures, firmwareFromReply } from "../protocol/firmware.js";
import { commandName, LineSplitter, replyShape } from "../protocol/replies.js";
import { PlotwrightError } from "../../../errors.js";
import { AnswerQueue, LostAnswer, type AwaitedAnswer } from "./answer-queue.js";
import { SessionLog } from "./session-log.js";
import type { Clock, Transport } from "../../transport.js";

export interface SessionOptions {
  readonly clock: Clock;
  /** Silence on an unanswered command before the board counts as gone. Default 1.5 s. */
  readonly patienceS?: number;
  /** Lines kept for the log. Default 20 000. */
  readonly logLines?: number;
}

/** A command to be written. Its answer, or what became of it, arrives at `onReply`, exactly once. */
export interface Outgoing {
  readonly line: string;
  /** Silence that is normal before this command's answer, beyond the session's patience: motion ahead of it. */
  readonly waitS?: number;
  readonly onReply?: (error: PlotwrightError | null, value: string) => void;
}

export interface BoardIdentity {
  /** For example "2.8.1". */
  readonly firmware: string;
  /** The whole answer to `V`. */
  readonly text: string;
}

interface SentCommand extends AwaitedAnswer {
  readonly waitS: number;
  /** Running out of patience with it is this command's failure alone, not the session's. */
  readonly alone: boolean;
}

const IDENTIFY_TRIES = 3;
const IDENTIFY_PATIENCE_S = 0.7;
const OVERSLEPT_S = 0.25;
/** How often a question is asked whose answers are lost. */
const QUESTION_TRIES = 3;
/** Of the log, for the message about a device that is no EiBotBoard. */
const HEARD_LINES = 6;

export class BoardSession {
  readonly log: SessionLog;
  identity: BoardIdentity | null = null;

  private readonly clock: Clock;
  private readonly patienceS: number;
  private readonly answers: AnswerQueue;
  private readonly faultListeners: ((error: PlotwrightError) => void)[] = [];
  private readonly lines = new LineSplitter();
  private fault: PlotwrightError | null = null;
  private closed = false;
  /** Since when the first unanswered command has been the first. */
  private firstSinceS = 0;
  private cancelWatch: (() => void) | null = null;
  private watchDueS = 0;
  /** `V` was asked only to know which answer is which, and has not been answered yet. */
  private isFindingOrder = false;
  /** Something has come from the other end since it was last asked who it is. */
  private hasHeard = false;

  constructor(
    private readonly transport: Transport,
    options: SessionOptions,
  ) {
    this.clock = options.clock;
    this.patienceS = options.patienceS ?? 1.5;
    this.log = new SessionLog(options.clock, options.logLines);
    this.answers = new AnswerQueue((line) => {
      this.log.add("note", `belongs to no command: ${line}`);
      this.findOrder();
    });
    transport.onData((bytes) => this.take(bytes));
    transport.onClose((error) => this.lineClosed(error));
  }

  /** Why the session can no longer be used; null while it can. */
  get failure(): PlotwrightError | null {
    return this.fault;
  }

  /** Commands written whose answers are still to come. */
  get unansweredCount(): number {
    return this.answers.count;
  }

  /** Lines that answered no command of ours: line noise, or a second program on the port. */
  get strayCount(): number {
    return this.answers.strayCount;
  }

  /** Answers that never came although later ones did. */
  get lostReplyCount(): number {
    return this.answers.lostCount;
  }

  /** Told once, when the line is lost or the board has gone silent. */
  onFault(listener: (error: PlotwrightError) => void): void {
    this.faultListeners.push(listener);
  }

  /**
   * Asks who is there and brings the board to the plain reply syntax. Rejects with `board-timeout` when
   * nothing answers, `no-board` when something else does. What an earlier program left on the line is ignored.
   */
  async identify(): Promise<BoardIdentity> {
    for (let attempt = 1; ; attempt++) {
      this.hasHeard = false;
      try {
        // The try before may have ended in the middle of a line of its own.
        const text = await this.ask("V", IDENTIFY_PATIENCE_S, true);
        this.identity = { firmware: firmwareFromReply(text) ?? "0.0.0", text };
        break;
      } catch (error) {
        if (this.fault) throw this.fault;
        if (attempt < IDENTIFY_TRIES) continue;
        const last = this.log.tail(HEARD_LINES);
        // A board's own answer that comes too late is none of another device.
        const isBoard = last.some((line) => firmwareFromReply(line) !== null);
        throw this.hasHeard && !isBoard ? wrongBoard(last) : silentAtStart(error);
      }
    }
    // An earlier program may have left it in its other reply syntax.
    if (firmwareFeatures(this.identity.firmware).hasFutureSyntax) await this.send("CU,10,0");
    return this.identity;
  }

  /**
   * One command whose answer is a value; resolves with the value without name and line ends. A question whose answer
   * is lost on the line is asked again.
   */
  query(line: string, waitS = 0): Promise<string> {
    const isQuestion = /^(Q|PI|V)/.test(commandName(line));
    return this.ask(line, waitS, false, isQuestion ? QUESTION_TRIES : 1);
  }

  /** One command that is answered by OK. Resolves at the answer: queued or done, see the board's protocol. */
  async send(line: string, waitS = 0): Promise<void> {
    await this.ask(line, waitS, false);
  }

  /** Writes several commands in one go. Never throws: each command's `onReply` is told what became of it. */
  write(commands: readonly Outgoing[]): void {
    if (this.fault || this.closed) {
      const error = this.fault ?? closedError();
      for (const command of commands) command.onReply?.(error, "");
      return;
    }
    let text = "";
    const silent: Outgoing[] = [];
    for (const command of commands) {
      text += `${command.line}\r`;
      this.log.add("sent", command.line);
      if (hasNoReply(command.line)) silent.push(command);
      else this.expect(command.line, command.waitS ?? 0, false, command.onReply);
    }
    this.put(text);
    for (const command of silent) command.onReply?.(null, "");
  }

  /** Ends the session; what still waits is rejected as `disconnected`. */
  async close(): Promise<void> {
    if (this.closed) return;
    this.closed = true;
    this.cancelWatch?.();
    this.answers.failAll(closedError());
    await this.transport.close();
  }

  private ask(line: string, waitS: number, alone: boolean, tries = 1): Promise<string> {
    return new Promise((resolve, reject) => {
      const askOnce = (triesLeft: number): void => {
        if (this.fault || this.closed) {
          reject(this.fault ?? closedError());
          return;
        }
        this.log.add("sent", line);
        if (hasNoReply(line)) resolve("");
        else {
          this.expect(line, waitS, alone, (error, value) => {
            if (!error) resolve(value);
            else if (error instanceof LostAnswer && triesLeft > 1) askOnce(triesLeft - 1);
            else reject(error);
          });
        }
        this.put(`${line}\r`);
      };
      askOnce(tries);
    });
  }

  /**
   * A line came that belongs to no command: answers may have been lost or be one too many. `V` has an answer of a
   * shape of its own, so with it everything before is answered.
   */
  private findOrder(): void {
    if (this.isFindingOrder || !this.identity || this.answers.count === 0 || this.fault) return;
    this.isFindingOrder = true;
    this.answers.inDoubt = true;
    this.log.add("sent", "V");
    this.expect("V", this.patienceS, true, () => {
      this.isFindingOrder = false;
      this.answers.inDoubt = false;
    });
    this.put("V\r");
  }

  private expect(line: string, waitS: number, alone: boolean, onReply: Outgoing["onReply"]): void {
    const sent: SentCommand = {
      line,
      waitS,
      alone,
      settle: (error, value) => {
        this.firstSinceS = this.clock.nowS();
        onReply?.(error, value);
      },
    };
    if (this.answers.count === 0) this.firstSinceS = this.clock.nowS();
    this.answers.add(sent);
    if (!this.cancelWatch) this.watch();
  }

  private put(text: string): void {
    this.transport.write(asciiBytes(text)).catch((error: unknown) => {
      this.fail(error instanceof PlotwrightError ? error : lineLost(error));
    });
  }

  private take(bytes: Uint8Array): void {
    this.hasHeard = true;
    this.lines.push(bytes, (line) => {
      this.log.add("received", line);
      this.answers.take(line);
    });
  }

  /**
   * One timer for the whole queue: it looks at the first command when the soonest possible time-out has
   * come, and goes to sleep again for what is left. No timer is set or cleared per command.
   */
  private watch(): void {
    const first = this.answers.first as SentCommand | null;
    if (!first || this.fault || this.closed) {
      this.cancelWatch = null;
      return;
    }
    const nowS = this.clock.nowS();
    const leftS = this.firstSinceS + this.patienceOf(first) - nowS;
    // Fired far too late: it was we who slept (suspended, stopped). Answers that came meanwhile are read first.
    const overslept = this.cancelWatch !== null && nowS - this.watchDueS > OVERSLEPT_S;
    if (leftS > 0 || overslept) {
      // Timers may fire a little early; a millisecond more is cheaper than a second timer for the rest.
      const delayS = overslept ? OVERSLEPT_S : Math.min(leftS, this.patienceS) + 0.001;
      this.watchDueS = nowS + delayS;
      this.cancelWatch = this.clock.after(delayS, () => this.watch());
      return;
    }
    this.cancelWatch = null;
    if (first.alone) {
      this.answers.failFirst(silent(first.line));
      this.watch();
    } else {
      this.fail(silent(first.line));
    }
  }

  private patienceOf(sent: SentCommand): number {
    return sent.alone ? sent.waitS : this.patienceS + sent.waitS;
  }

  private lineClosed(error: Error | undefined): void {
    if (!this.closed) this.fail(error instanceof PlotwrightError ? error : lineLost(error));
  }

  private fail(error: PlotwrightError): void {
    if (this.fault || this.closed) return;
    this.fault = error;
    this.cancelWatch?.();
    this.cancelWatch = null;
    this.log.add("note", error.message);
    this.answers.failAll(error);
    for (const listener of this.faultListeners) listener(error);
  }
}

const hasNoReply = (line: string): boolean => replyShape(commandName(line)).isSilent;

/** Commands are ASCII by construction. */
function asciiBytes(text: string): Uint8Array {
  const bytes = new Uint8Array(text.length);
  for (let i = 0; i < text.length; i++) bytes[i] = text.charCodeAt(i);
  return bytes;
}

const closedError = (): PlotwrightError =>
  new PlotwrightError("disconnected", "The connection to the board was closed.");

const lineLost = (cause: unknown): PlotwrightError =>
  new PlotwrightError(
    "disconnected",
    "The connection to the board is lost: check its USB cable and power, then connect again.",
    { cause },
  );

const silent = (line: string): PlotwrightError =>
  new PlotwrightError(
    "board-timeout",
    `The board has stopped answering (waiting on ${line}): check its USB cable and power, and that no other program uses the port.`,
  );

const silentAtStart = (cause: unknown): PlotwrightError =>
  new PlotwrightError(
    "board-timeout",
    "Nothing answers on this port: check that it is the plotter's, that its cable is firm, and that no other program uses the port; then unplug the board, plug it in and connect again.",
    { cause },
  );

function wrongBoard(lastLines: readonly string[]): PlotwrightError {
  const heard = lastLines.filter((line) => line.includes(" < ")).map((line) => line.split(" < ")[1]!);
  const said = heard.map((line) => JSON.stringify(line)).join(", ");
  return new PlotwrightError(
    "no-board",
    "Something answers on this port, but it is not an EiBotBoard: choose another device." +
      (said === "" ? "" : ` It said: ${said}.`),
  );
}
