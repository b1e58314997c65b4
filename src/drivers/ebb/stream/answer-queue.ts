/**
 * Which reply line belongs to which command.
 *
 * The board answers in order, but its answers have no number, some end in `OK`, some do not, an error may or
 * may not be followed by an `OK`, and after `CU,10,1` the name of the command comes first (firmware 3.x).
 * So every waiting command knows the shape of its answer, and a line is given to the first command that it
 * can belong to. A value that only a later command can have asked for proves that the answers before it were
 * lost: a plot goes on over that, and the count of lost answers says so.
 *
 * A line that fits nothing is put aside. An `OK` where a value is due is one too many, unless the value was lost:
 * then a second one follows. Either way the order is in doubt until the answer to `V` comes, which looks like no
 * other; values asked for before it may be another command's and are not believed.
 */
import { commandName, replyShape, type ReplyShape } from "../protocol/replies.js";
import { PlotwrightError } from "../../../errors.js";

const NUMBER = /^\d+$/;
const TWO_NUMBERS = /^-?\d+,-?\d+$/;
/** Two readings of the converter, 10 bits each. */
const TWO_READINGS = /^(0*\d{1,3}|0*10[01]\d|0*102[0-3]),(0*\d{1,3}|0*10[01]\d|0*102[0-3])$/;

/** What a value looks like, by command, without the name: tells a command's own answer from another's. */
const VALUE_PATTERNS: Readonly<Record<string, RegExp>> = {
  V: /firmware version \d/i,
  QM: /^\d,\d,\d(,\d)?$/,
  QG: /^[0-9A-F]{2}$/i,
  PI: NUMBER,
  QS: TWO_NUMBERS,
  QC: TWO_READINGS,
  QE: /^\d{1,2},\d{1,2}$/,
  QP: NUMBER,
  QB: NUMBER,
  QR: NUMBER,
  QN: NUMBER,
  QL: NUMBER,
  QU: /^(\d+,)?-?\d+$/,
  QT: /^.{1,16}$/,
  ES: /^[01](,\d+,\d+,-?\d+,-?\d+)?$/,
};
const NO_VALUE = /^$/;

/** A command under way. `settle` is called exactly once. */
export interface AwaitedAnswer {
  readonly line: string;
  settle(error: PlotwrightError | null, value: string): void;
}

interface Waiting {
  readonly awaited: AwaitedAnswer;
  readonly name: string;
  readonly shape: ReplyShape;
  readonly pattern: RegExp;
  value: string | null;
  /** An OK came while its value was due. */
  hadOk: boolean;
}

/** After noise too, which may have no line end of its own. */
const ERROR_LINE = /!(\d+)\s*Err:\s*(.*)$/;

/** The answer did not come, or cannot be told from another's. A question may be asked again. */
export class LostAnswer extends PlotwrightError {
  constructor(line: string) {
    super("board-error", `The board's answer to ${line} was lost on the line.`);
  }
}

export class AnswerQueue {
  /** Lines that belong to no command: garbage, a late answer, or another program's conversation. */
  strayCount = 0;
  /** Answers that never came, proved by the answer to a later command. */
  lostCount = 0;
  /** The order of answers is in doubt: set by whoever then asks for `V`, whose answer ends it. */
  inDoubt = false;
  /** A ring would save nothing: the queue is a few commands long. `head` avoids shifting the array. */
  private waiting: Waiting[] = [];
  private head = 0;
  /** An error was just answered; the OK that some firmware sends after it belongs to no one. */
  private forgivesOk = false;
  private lastLine = "";

  constructor(private readonly onStray: (line: string) => void) {}

  get count(): number {
    return this.waiting.length - this.head;
  }

  get first(): AwaitedAnswer | null {
    return this.waiting[this.head]?.awaited ?? null;
  }

  add(awaited: AwaitedAnswer): void {
    const name = commandName(awaited.line);
    const pattern = VALUE_PATTERNS[name] ?? NO_VALUE;
    this.waiting.push({ awaited, name, shape: replyShape(name), pattern, value: null, hadOk: false });
  }

  /** One reply line without its line end; empty lines carry nothing in any syntax. */
  take(line: string): void {
    if (line === "") return;
    const error = ERROR_LINE.exec(line);
    if (error) this.takeError(Number(error[1]), error[2]!, line);
    else if (line === "OK" || line === "CUOK") this.takeOk();
    else if (!this.takeValue(line)) this.stray(line);
  }

  /** Settles everything that waits with one error: the line is gone or no longer to be trusted. */
  failAll(error: PlotwrightError): void {
    const rest = this.waiting.slice(this.head);
    this.waiting = [];
    this.head = 0;
    for (const { awaited } of rest) awaited.settle(error, "");
  }

  /** Gives up on the first command only. */
  failFirst(error: PlotwrightError): void {
    if (this.count > 0) this.shift().awaited.settle(error, "");
  }

  private takeError(code: number, words: string, line: string): void {
    // "Extra parameter" is found after the command has run and been answered: it names the one before.
    const lateFor = code === 7 ? this.lastLine : "";
    if (lateFor !== "" || this.count === 0) {
      this.stray(lateFor === "" ? line : `${line} (to ${lateFor})`);
      return;
    }
    const failed = this.shift();
    this.forgivesOk = true;
    failed.awaited.settle(boardError(failed.awaited.line, code, words), "");
  }

  private takeOk(): void {
    const first = this.waiting[this.head];
    if (!first) {
      if (!this.forgivesOk) this.stray("OK");
      this.forgivesOk = false;
      return;
    }
    // A board without a name answers QT by an empty line, which vanishes.
    if (isPlain(first.shape) || first.value !== null || first.name === "QT") {
      this.finish(this.shift(), first.value ?? "");
      return;
    }
    if (this.forgivesOk) {
      this.forgivesOk = false;
      return;
    }
    if (!first.hadOk) {
      first.hadOk = true;
      this.stray("OK");
      return;
    }
    // Two, and no value: it was lost, and this OK belongs to the next.
    this.loseFirst();
    if (this.count > 0) this.takeOk();
  }

  /** False when no waiting command can have asked for this. */
  private takeValue(line: string): boolean {
    for (let i = this.head; i < this.waiting.length; i++) {
      const candidate = this.waiting[i]!;
      const named = line === candidate.name || line.startsWith(`${candidate.name},`);
      const value = named ? line.slice(candidate.name.length + 1) : line;
      if (!candidate.pattern.test(value)) continue;
      if (!named && (value === "" || candidate.shape.isNamed)) continue;
      // A second value for the same question: one of the two is not its answer.
      if (candidate.value !== null) return false;
      // A plain name is also what any later command of that name would send: never skip others for it.
      if (isPlain(candidate.shape) && i > this.head) return false;
      for (let before = i - this.head; before > 0; before--) this.loseFirst();
      candidate.value = value;
      const endsHere = !candidate.shape.ok || isPlain(candidate.shape) || (named && !candidate.shape.isNamed);
      if (endsHere) this.finish(this.shift(), value);
      return true;
    }
    return false;
  }

  private loseFirst(): void {
    const lost = this.shift();
    this.lostCount++;
    // What got its value and lacks its OK was answered all the same; an OK says nothing but "taken".
    if (isPlain(lost.shape) || (lost.value !== null && !this.inDoubt)) {
      lost.awaited.settle(null, lost.value ?? "");
      return;
    }
    lost.awaited.settle(new LostAnswer(lost.awaited.line), "");
  }

  private finish(done: Waiting, value: string): void {
    this.lastLine = done.awaited.line;
    if (done.name === "V") this.inDoubt = false;
    if (this.inDoubt && !isPlain(done.shape)) done.awaited.settle(new LostAnswer(done.awaited.line), "");
    else done.awaited.settle(null, value);
  }

  private shift(): Waiting {
    const first = this.waiting[this.head]!;
    this.head++;
    if (this.head > 64 || this.head === this.waiting.length) {
      this.waiting = this.waiting.slice(this.head);
      this.head = 0;
    }
    return first;
  }

  private stray(line: string): void {
    this.strayCount++;
    this.onStray(line);
  }
}

const isPlain = (shape: ReplyShape): boolean => shape.valueEnd === null;

/** What the board's error numbers mean for the user, where its own words do not say it. */
const ERROR_ADVICE: Readonly<Record<number, string>> = {
  0: "the move is too fast or too slow for the board",
  8: "this firmware does not know the command: update it, or check that the right firmware was chosen",
  10: "the board expects checksums, set by another program: unplug the board and plug it in again",
};

function boardError(line: string, code: number, words: string): PlotwrightError {
  const advice = ERROR_ADVICE[code];
  return new PlotwrightError(
    "board-error",
    `The board refused ${line}: ${words === "" ? `error ${code}` : words}${advice ? ` (${advice})` : ""}.`,
  );
}
