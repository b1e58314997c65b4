/**
 * The protocol of one EiBotBoard: sends commands in order and matches replies to commands. Knows nothing about motion.
 *
 * The board parses one command at a time and answers it when it is queued or done. A motion command that has to wait for
 * a slot in the queue is answered late. So the time-out applies only to the first unanswered command, from the time it
 * became the first, and each command states how long it may take.
 */
import { checkObject } from "../../../check-arguments.js";
import { firmwareFeatures, firmwareFromReply } from "../protocol/firmware.js";
import { silent } from "../../faults.js";
import { LineSession, type LineProtocol } from "../../line-session.js";
import { commandName, isQuery, replyShape } from "../protocol/replies.js";
import { PlotwrightError } from "../../../errors.js";
import { AnswerQueue, LostAnswer, type AwaitedAnswer } from "./answer-queue.js";
import type { SessionLog } from "../../session-log.js";
import type { Clock, Transport } from "../../transport.js";

/** Time-outs and log of a `BoardSession`. */
export interface SessionOptions {
  /** For time-outs, in real seconds. */
  readonly clock: Clock;
  /** Time without a reply after which the board counts as gone, while this program runs. Default 1.5 s. */
  readonly timeoutS?: number;
  /** Max number of lines in the log. Default 20 000. */
  readonly logLines?: number;
}

/** A command to be written. `onReply` is called exactly once, with its reply or an error. */
export interface Outgoing {
  readonly line: string;
  /** Expected wait for the reply on top of the session's patience, because of motion queued before it. */
  readonly waitS?: number;
  readonly onReply?: (error: PlotwrightError | null, value: string) => void;
  /**
   * A time-out fails only this command, not the session. It is then `waitS` alone.
   *
   * @internal
   */
  readonly alone?: boolean;
}

/** The board's firmware, from its reply to `V`. */
export interface BoardIdentity {
  /** For example "2.8.1". */
  readonly firmware: string;
  /** The whole reply to `V`. */
  readonly text: string;
}

interface SentCommand extends AwaitedAnswer {
  readonly timeoutS: number;
  readonly alone: boolean;
}

const IDENTIFY_TRIES = 3;
const IDENTIFY_PATIENCE_S = 0.7;
/** How often a query is sent if its replies are lost. */
const QUERY_TRIES = 3;
/** An earlier program may have made the board refuse commands without a checksum. The last number is this one's. */
const NO_CHECKSUMS = "CU,54,0,119";

/**
 * One EiBotBoard over one transport: sends commands in order, matches replies to commands, and detects a silent board.
 * Call `identify` first.
 */
export class BoardSession {
  /** Set by `identify`. */
  identity: BoardIdentity | null = null;

  private readonly lines: LineSession;
  private readonly timeoutS: number;
  private readonly answers: AnswerQueue<SentCommand>;

  constructor(transport: Transport, options: SessionOptions) {
    checkObject(
      "BoardSession",
      "the transport",
      transport,
      ["write"],
      "what board.transport() or requestBoard returns",
    );
    checkObject(
      "BoardSession",
      "the options object",
      options,
      ["clock"],
      "{ clock }, for example { clock: browserClock() }",
    );
    this.timeoutS = options.timeoutS ?? 1.5;
    this.answers = new AnswerQueue((line) => {
      this.log.add("note", `belongs to no command: ${line}`);
      this.findOrder();
    });
    const protocol: LineProtocol = {
      lineEnd: "\r",
      take: (line) => this.answers.take(line),
      silent: () => this.noAnswer(),
      ended: (error) => this.answers.failAll(error),
    };
    this.lines = new LineSession(transport, protocol, options);
  }

  /** What was sent and received. */
  get log(): SessionLog {
    return this.lines.log;
  }

  /** Why the session can no longer be used; null while it is usable. */
  get failure(): PlotwrightError | null {
    return this.lines.failure;
  }

  /** Number of written commands without a reply yet. */
  get unansweredCount(): number {
    return this.answers.count;
  }

  /** Number of lines that match none of our commands: noise, or a second program on the port. */
  get strayCount(): number {
    return this.answers.strayCount;
  }

  /** Number of replies that never came although later ones did. */
  get lostReplyCount(): number {
    return this.answers.lostCount;
  }

  /** Called once, when the connection is lost or the board stops answering. */
  onFault(listener: (error: PlotwrightError) => void): void {
    this.lines.onFault(listener);
  }

  /**
   * Identifies the board and switches it to the legacy reply syntax. Rejects with `board-timeout` if nothing answers, and
   * with `no-board` if another device does, or if the port returns what is sent to it. Ignores unread replies to an
   * earlier program.
   */
  async identify(): Promise<BoardIdentity> {
    this.identity = await this.lines.identify({
      board: "an EiBotBoard",
      tries: IDENTIFY_TRIES,
      attempt: () => this.askVersion(),
      isOwn: (line) => firmwareFromReply(line) !== null,
    });
    // An earlier program may have switched off the OK, or switched the board to the other reply syntax.
    if (firmwareFeatures(this.identity.firmware).hasFutureSyntax) {
      await this.send("CU,1,1");
      await this.send("CU,10,0");
    }
    return this.identity;
  }

  private async askVersion(): Promise<BoardIdentity | null> {
    const entryCount = this.log.count;
    // What was heard before may be replies to an earlier program.
    this.lines.hasHeard = false;
    // An earlier program may have left an unfinished line, so a failed attempt must not end the session.
    const text = await this.ask("V", IDENTIFY_PATIENCE_S, true).catch(() => null);
    const heard = this.log.receivedSince(entryCount);
    if (text === null) {
      if (heard.some((line) => line.includes("!10 "))) await this.ask(NO_CHECKSUMS, 1, true).catch(() => "");
      return null;
    }
    if (heard.some(isEchoOfV)) throw echoes();
    return { firmware: firmwareFromReply(text) ?? "0.0.0", text };
  }

  /**
   * Sends a command that returns a value. Resolves with the value without name and line end. A query is
   * repeated if its reply is lost.
   */
  query(line: string, waitS = 0): Promise<string> {
    return this.ask(line, waitS, false, isQuery(commandName(line)) ? QUERY_TRIES : 1);
  }

  /** Sends a command that is answered by OK. Resolves at the reply: the command is then queued or done. */
  async send(line: string, waitS = 0): Promise<void> {
    await this.ask(line, waitS, false);
  }

  /** Writes several commands at once. Never throws: errors go to each command's `onReply`. */
  write(commands: readonly Outgoing[]): void {
    const { failure } = this.lines;
    if (failure) {
      for (const command of commands) command.onReply?.(failure, "");
      return;
    }
    const silent: Outgoing[] = [];
    for (const command of commands) {
      if (hasNoReply(command.line)) silent.push(command);
      else this.expect(command);
    }
    this.lines.writeLines(commands.map(({ line }) => line));
    for (const command of silent) command.onReply?.(null, "");
  }

  /** Ends the session. Waiting commands are rejected with `disconnected`. */
  close(): Promise<void> {
    return this.lines.close();
  }

  private ask(line: string, waitS: number, alone: boolean, tries = 1): Promise<string> {
    return new Promise((resolve, reject) => {
      const askOnce = (triesLeft: number): void => {
        const onReply: Outgoing["onReply"] = (error, value) => {
          if (!error) resolve(value);
          else if (error instanceof LostAnswer && triesLeft > 1) askOnce(triesLeft - 1);
          else reject(error);
        };
        this.write([{ line, waitS, alone, onReply }]);
      };
      askOnce(tries);
    });
  }

  /**
   * Called for a line that belongs to no command: replies may have been lost or be surplus. The reply to `V` cannot be
   * confused with others, so when it arrives, all earlier commands have been answered.
   */
  private findOrder(): void {
    if (this.answers.inDoubt || !this.identity || this.answers.count === 0 || this.failure) return;
    this.answers.inDoubt = true;
    const onReply = (): void => {
      this.answers.inDoubt = false;
    };
    this.write([{ line: "V", waitS: this.timeoutS, alone: true, onReply }]);
  }

  private expect({ line, waitS = 0, alone = false, onReply }: Outgoing): void {
    const timeoutS = alone ? waitS : this.timeoutS + waitS;
    const settle: SentCommand["settle"] = (error, value) => {
      this.awaitFirst();
      onReply?.(error, value);
    };
    this.answers.add({ line, timeoutS, alone, settle });
    if (this.answers.count === 1) this.awaitFirst();
  }

  /** Call when another command has become the first unanswered one. */
  private awaitFirst(): void {
    this.lines.expectWithin(this.answers.first?.timeoutS ?? Infinity);
  }

  /** The first unanswered command has waited too long. */
  private noAnswer(): void {
    const { first } = this.answers;
    if (!first) return;
    if (first.alone) this.answers.failFirst(silent(first.line));
    else this.lines.fail(silent(first.line));
  }
}

const hasNoReply = (line: string): boolean => replyShape(commandName(line)).isSilent;

/**
 * A port that returns what is sent to it has returned V: in the board's own replies a comma follows the name. "^M" is how
 * a terminal shows the end of a line.
 */
const isEchoOfV = (line: string): boolean => /^V(\^M)?($|EBB)/i.test(line);

const echoes = (): PlotwrightError =>
  new PlotwrightError(
    "no-board",
    "This port returns everything that is sent to it (echo), so it can't be distinguished from the board's replies: switch the echo off in the program or adapter between this computer and the board (for a terminal: stty raw -echo), then connect again.",
  );
