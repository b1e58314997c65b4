/**
 * What the board answers, in both of its syntaxes. Which answer belongs to which command: board/answer-queue.ts.
 *
 * Legacy (boot default): values end "\r\n" or "\n\r" depending on the command, most commands add "OK\r\n".
 * Future (CU,10,1; firmware 3.0 on): one line a command, its name first.
 * So lines are split at any run of CR and LF.
 */
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

/** `m1,m2` of `QS`. */
export function parseSteps(reply: string): readonly [number, number] {
  const [first, second] = reply.split(",").map(Number);
  return [first ?? 0, second ?? 0];
}

/** Commands waiting in the board's queue, as the answers to these queries tell it; null: they do not say. */
export function waitingCount(line: string, reply: string): number | null {
  if (line === "QU,6") return Number(reply.split(",").pop());
  if (line === "QG") return Number.parseInt(reply, 16) & 1;
  if (line === "QM") return reply.split(",").length === 4 ? Number(reply.split(",")[3]) : null;
  return null;
}

/** What `ES` tells of the move that it ended: steps still to be made, of each motor; null: firmware 3 does not tell. */
export function stepsLeft(reply: string): readonly [number, number] | null {
  const [, , , left1, left2] = reply.split(",").map(Number);
  return left1 === undefined || left2 === undefined ? null : [left1, left2];
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
}
