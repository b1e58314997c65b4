/**
 * What the board answers, in both of its syntaxes, and which answer belongs to which command.
 *
 * Legacy (boot default): values end "\r\n" or "\n\r" depending on the command, most commands add "OK\r\n".
 * Future (CU,10,1; firmware 3.0 on): one line a command, its name first.
 * So lines are split at any run of CR and LF, and matched by the kind of the command that waits first.
 */
export type ReplySyntax = "legacy" | "future";

export interface ReplyShape {
  /** How the line of values ends in legacy; null when the command answers none. */
  readonly valueEnd: "\r\n" | "\n\r" | null;
  /** Legacy adds OK. */
  readonly ok: boolean;
  /** The name stands before the values in legacy too. */
  readonly isNamed: boolean;
  /** No answer at all: the line drops. */
  readonly isSilent: boolean;
}

const PLAIN: ReplyShape = { valueEnd: null, ok: true, isNamed: false, isSilent: false };
const value = (valueEnd: "\r\n" | "\n\r", ok: boolean, isNamed = false): ReplyShape => ({
  valueEnd,
  ok,
  isNamed,
  isSilent: false,
});
const SILENT: ReplyShape = { valueEnd: null, ok: false, isNamed: false, isSilent: true };

const SHAPES: Readonly<Record<string, ReplyShape>> = {
  V: value("\r\n", false),
  QM: value("\n\r", false, true),
  QG: value("\r\n", false),
  PI: value("\r\n", false, true),
  QS: value("\n\r", true),
  QP: value("\n\r", true),
  QB: value("\r\n", true),
  QC: value("\r\n", true),
  QE: value("\n\r", true),
  QR: value("\n\r", true),
  QN: value("\r\n", true),
  QL: value("\r\n", true),
  QT: value("\r\n", true),
  ES: value("\n\r", true),
  QU: value("\r\n", true, true),
  RB: SILENT,
  BL: SILENT,
};

/** The shape of the answer to a command of this name (upper case). */
export const replyShape = (name: string): ReplyShape => SHAPES[name] ?? PLAIN;

/** "sp,1,250" -> "SP". */
export function commandName(line: string): string {
  const comma = line.indexOf(",");
  return (comma < 0 ? line : line.slice(0, comma)).trim().toUpperCase();
}

export interface BoardErrorReply {
  /** 0 … 10, as the board numbers them. */
  readonly code: number;
  readonly message: string;
}

export interface Reply {
  /** The command line that this answers, as given to `expect`; null for a line that nobody asked for. */
  readonly command: string | null;
  /** Values without the name, "" for none. */
  readonly value: string;
  readonly error: BoardErrorReply | null;
}

const CR = 13;
const LF = 10;
/** The board never answers more than this; what is longer is noise on the line. */
const MAX_LINE_BYTES = 256;

/** Cuts incoming bytes into lines at any run of CR and LF; empty lines vanish. Control bytes and bytes above 126 are dropped. */
export class LineSplitter {
  private pending = "";

  push(bytes: Uint8Array, onLine: (line: string) => void): void {
    for (const byte of bytes) {
      if (byte === CR || byte === LF) {
        const line = this.pending;
        this.pending = "";
        if (line.length > 0) onLine(line);
      } else if (byte >= 32 && byte < 127 && this.pending.length < MAX_LINE_BYTES) {
        this.pending += String.fromCharCode(byte);
      }
    }
  }

  reset(): void {
    this.pending = "";
  }
}

/** Matches lines to the commands that wait for an answer, first in first out. */
export class ReplyMatcher {
  private readonly waiting: string[] = [];
  private heldValue: string | null = null;
  private lastAnswered: string | null = null;

  constructor(public syntax: ReplySyntax = "legacy") {}

  get waitingCount(): number {
    return this.waiting.length;
  }

  /** A command was sent. Silent ones (RB, BL) need not be announced. */
  expect(command: string): void {
    if (!replyShape(commandName(command)).isSilent) this.waiting.push(command);
  }

  /** Forgets all that waits: after a reset of the line. Returns what was waiting. */
  reset(): string[] {
    this.heldValue = null;
    return this.waiting.splice(0);
  }

  /** One line of the board. Null when it completes no answer (a value that OK still follows, a stray OK). */
  line(text: string): Reply | null {
    const error = errorIn(text);
    if (error !== null) return this.failed(error);
    const command = this.waiting[0];
    if (command === undefined) return text === "OK" ? null : { command: null, value: text, error: null };
    return this.syntax === "future" ? this.futureLine(text, command) : this.legacyLine(text, command);
  }

  private legacyLine(text: string, command: string): Reply | null {
    const name = commandName(command);
    const shape = replyShape(name);
    if (text === "OK") {
      // Some versions add OK after an error: where a bare value is due, it belongs to the command before.
      if (shape.valueEnd !== null && this.heldValue === null && name !== "QT") return null;
      return this.answered(this.heldValue ?? "");
    }
    if (shape.valueEnd === null) return { command: null, value: text, error: null };
    const held = shape.isNamed && text.startsWith(`${name},`) ? text.slice(name.length + 1) : text;
    if (shape.ok) {
      this.heldValue = held;
      return null;
    }
    return this.answered(held);
  }

  private futureLine(text: string, command: string): Reply | null {
    const name = commandName(command);
    if (text === name) return this.answered("");
    if (text.startsWith(`${name},`)) return this.answered(text.slice(name.length + 1));
    return { command: null, value: text, error: null };
  }

  /** The board reports surplus parameters after it has run and acknowledged the command. */
  private failed(error: BoardErrorReply): Reply {
    const EXTRA_PARAMETER = 7;
    if (error.code === EXTRA_PARAMETER && this.syntax === "legacy") {
      return { command: this.lastAnswered, value: "", error };
    }
    this.heldValue = null;
    const command = this.waiting.shift() ?? null;
    return { command, value: "", error };
  }

  private answered(valueText: string): Reply {
    const command = this.waiting.shift() ?? null;
    this.heldValue = null;
    this.lastAnswered = command;
    return { command, value: valueText, error: null };
  }
}

/** "!8 Err: …" or, in future syntax, "SM,!4 Err: …". */
function errorIn(text: string): BoardErrorReply | null {
  const match = /^(?:[A-Za-z0-9]{1,2},)?!(\d{1,2})\s*(.*)$/.exec(text);
  return match === null ? null : { code: Number(match[1]), message: match[2]!.trim() };
}
