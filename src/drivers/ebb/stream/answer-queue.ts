/**
 * Matches reply lines to commands.
 *
 * The board answers in order, but its replies have no number. Some end in `OK` and some do not, an error may or may not
 * be followed by an `OK`, and after `CU,10,1` the command name comes first (firmware 3.x). Upper and lower case are
 * alike. So every waiting command has the pattern of its reply, and a line is assigned to the first command that it
 * fits. A value that fits only a later command proves that the replies before it were lost. The plot continues, and lost
 * replies are counted.
 *
 * A line that fits no command is ignored and logged. An `OK` where a value is due is either surplus, or the value was
 * lost and a second `OK` follows. In both cases the order is in doubt until the reply to `V` arrives, which cannot be
 * confused with any other. Until then, values may belong to another command and are discarded.
 */
import { commandName, replyShape, type ReplyShape } from "../protocol/replies.js";
import { PlotwrightError } from "../../../errors.js";

/** A command that waits for its reply. `settle` is called exactly once. */
export interface AwaitedAnswer {
  readonly line: string;
  settle(error: PlotwrightError | null, value: string): void;
}

interface Waiting<Awaited> {
  readonly awaited: Awaited;
  readonly name: string;
  readonly shape: ReplyShape;
  value: string | null;
  /** An OK arrived while the value was due. */
  hadOk: boolean;
}

/** Not anchored at the start: noise without a line end may precede the error. */
const ERROR_LINE = /!(\d+)\s*Err:\s*(.*)$/i;
/** After `CU,10,0` the name precedes it. */
const OK_LINE = /^(CU)?OK$/i;

/** The reply was lost, or may belong to another command. Queries may be repeated. */
export class LostAnswer extends PlotwrightError {
  constructor(line: string) {
    super("board-error", `The board's reply to ${line} was lost on the connection.`);
  }
}

export class AnswerQueue<Awaited extends AwaitedAnswer = AwaitedAnswer> {
  /** Number of lines that belong to no command: noise, late replies, or replies to another program. */
  strayCount = 0;
  /** Number of replies that never came, as shown by the reply to a later command. */
  lostCount = 0;
  /** The order of replies is in doubt. Set by the session, which then sends `V`, and clears it at the reply. */
  inDoubt = false;
  private readonly waiting: Waiting<Awaited>[] = [];
  /** An error was just received: ignore the OK that some firmware sends after it. */
  private toleratesMissingOk = false;
  private lastLine = "";

  constructor(private readonly onStray: (line: string) => void) {}

  get count(): number {
    return this.waiting.length;
  }

  get first(): Awaited | undefined {
    return this.waiting[0]?.awaited;
  }

  add(awaited: Awaited): void {
    const name = commandName(awaited.line);
    this.waiting.push({ awaited, name, shape: replyShape(name), value: null, hadOk: false });
  }

  /** Takes one reply line without its line end. Empty lines have no meaning in either syntax. */
  take(line: string): void {
    if (line === "") return;
    const error = ERROR_LINE.exec(line);
    if (error) this.takeError(Number(error[1]), error[2], line);
    else if (OK_LINE.test(line)) this.takeOk();
    else if (!this.takeValue(line)) this.stray(line);
  }

  /** Fails all waiting commands with one error, because the connection is lost or unreliable. */
  failAll(error: PlotwrightError): void {
    for (const { awaited } of this.waiting.splice(0)) awaited.settle(error, "");
  }

  /** Fails the first command only. */
  failFirst(error: PlotwrightError): void {
    this.waiting.shift()?.awaited.settle(error, "");
  }

  private takeError(code: number, words: string, line: string): void {
    // The board reports "Extra parameter" after the command was answered: it concerns the previous command.
    const lateFor = code === 7 ? this.lastLine : "";
    const failed = lateFor === "" ? this.waiting.shift() : undefined;
    if (!failed) {
      this.stray(lateFor === "" ? line : `${line} (to ${lateFor})`);
      return;
    }
    this.toleratesMissingOk = true;
    failed.awaited.settle(boardError(failed.awaited.line, code, words), "");
  }

  private takeOk(): void {
    const first = this.waiting[0];
    if (!first) {
      if (!this.toleratesMissingOk) this.stray("OK");
      this.toleratesMissingOk = false;
      return;
    }
    // A board without a name answers QT with an empty line, which the line splitter drops.
    if (isPlain(first.shape) || first.value !== null || first.name === "QT") {
      this.finishFirst(first.value ?? "");
      return;
    }
    if (this.toleratesMissingOk) {
      this.toleratesMissingOk = false;
      return;
    }
    if (!first.hadOk) {
      first.hadOk = true;
      this.stray("OK");
      return;
    }
    // A second OK and no value: the value was lost, and this OK belongs to the next command.
    this.loseFirst();
    if (this.count > 0) this.takeOk();
  }

  /** False if the line fits no waiting command. */
  private takeValue(line: string): boolean {
    const name = commandName(line);
    for (let i = 0; i < this.waiting.length; i++) {
      const candidate = this.waiting[i];
      const named = name === candidate.name;
      const value = named ? line.slice(candidate.name.length + 1) : line;
      if (!candidate.shape.values.test(value)) continue;
      if (!named && (value === "" || candidate.shape.isNamed)) continue;
      // A second value for the same query: one of the two is not its reply.
      if (candidate.value !== null) return false;
      // Several commands may have the same name: such a line does not prove that earlier replies were lost.
      if (isPlain(candidate.shape) && i > 0) return false;
      for (let before = i; before > 0; before--) this.loseFirst();
      candidate.value = value;
      const endsHere = !candidate.shape.ok || isPlain(candidate.shape) || (named && !candidate.shape.isNamed);
      if (endsHere) this.finishFirst(value);
      return true;
    }
    return false;
  }

  private loseFirst(): void {
    const lost = this.waiting.shift()!;
    this.lostCount++;
    // The later reply proves that this command was processed, so a lost OK does no harm, but a lost value does.
    if (isPlain(lost.shape) || (lost.value !== null && !this.inDoubt)) {
      lost.awaited.settle(null, lost.value ?? "");
      return;
    }
    lost.awaited.settle(new LostAnswer(lost.awaited.line), "");
  }

  private finishFirst(value: string): void {
    const done = this.waiting.shift()!;
    this.lastLine = done.awaited.line;
    const isLost = this.inDoubt && !isPlain(done.shape) && done.name !== "V";
    if (isLost) done.awaited.settle(new LostAnswer(done.awaited.line), "");
    else done.awaited.settle(null, value);
  }

  private stray(line: string): void {
    this.strayCount++;
    this.onStray(line);
  }
}

const isPlain = (shape: ReplyShape): boolean => shape.valueEnd === null;

/** Advice for error codes whose text does not say what to do. */
const ERROR_ADVICE: Readonly<Record<number, string>> = {
  0: "the move is too fast or too slow for the board",
  8: "this firmware does not know the command: update the firmware, or check that the right firmware was chosen",
  10: "the board expects checksums, set by another program: unplug the board and plug it in again",
};

function boardError(line: string, code: number, words: string): PlotwrightError {
  const advice = ERROR_ADVICE[code];
  return new PlotwrightError(
    "board-error",
    `The board refused ${line}: ${words === "" ? `error ${code}` : words}${advice ? ` (${advice})` : ""}.`,
  );
}
