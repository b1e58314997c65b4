/**
 * The board's replies in both syntaxes. stream/answer-queue.ts matches replies to commands.
 *
 * Legacy (default after a start): values end with "\r\n" or "\n\r", depending on the command; most commands add "OK\r\n".
 * Future (CU,10,1; firmware 3.0 and newer): one line per command, starting with its name.
 * So lines are split at any run of CR and LF.
 */
export interface ReplyShape {
  /** Matches the values without the name, to distinguish the replies of different commands. */
  readonly values: RegExp;
  /** Line end of the values in legacy syntax; null if the command returns no values. */
  readonly valueEnd: "\r\n" | "\n\r" | null;
  /** The legacy syntax adds OK. */
  readonly ok: boolean;
  /** The name precedes the values in legacy syntax too. */
  readonly isNamed: boolean;
  /** No reply at all: the connection drops. */
  readonly isSilent: boolean;
}

const PLAIN: ReplyShape = { values: /^$/, valueEnd: null, ok: true, isNamed: false, isSilent: false };
const SILENT: ReplyShape = { values: /^$/, valueEnd: null, ok: false, isNamed: false, isSilent: true };

const withValues = (values: RegExp, valueEnd: "\r\n" | "\n\r", ok = true, isNamed = false): ReplyShape => ({
  values,
  valueEnd,
  ok,
  isNamed,
  isSilent: false,
});

const NUMBER = /^\d+$/;
/** Two readings of the A/D converter, 10 bits each. */
const TWO_READINGS = /^(0*\d{1,3}|0*10[01]\d|0*102[0-3]),(0*\d{1,3}|0*10[01]\d|0*102[0-3])$/;

const SHAPES: Readonly<Record<string, ReplyShape>> = {
  V: withValues(/firmware version \d/i, "\r\n", false),
  QM: withValues(/^\d,\d,\d(,\d)?$/, "\n\r", false, true),
  QG: withValues(/^[0-9A-F]{2}$/i, "\r\n", false),
  PI: withValues(NUMBER, "\r\n", false, true),
  QS: withValues(/^-?\d+,-?\d+$/, "\n\r"),
  QP: withValues(NUMBER, "\n\r"),
  QB: withValues(NUMBER, "\r\n"),
  QC: withValues(TWO_READINGS, "\r\n"),
  QE: withValues(/^\d{1,2},\d{1,2}$/, "\n\r"),
  QR: withValues(NUMBER, "\n\r"),
  QN: withValues(NUMBER, "\r\n"),
  QL: withValues(NUMBER, "\r\n"),
  QT: withValues(/^.{1,16}$/, "\r\n"),
  ES: withValues(/^[01](,\d+,\d+,-?\d+,-?\d+)?$/, "\n\r"),
  QU: withValues(/^(\d+,)?-?\d+$/, "\r\n", true, true),
  RB: SILENT,
  BL: SILENT,
};

/** The shape of the reply to a command with this name (upper case). */
export const replyShape = (name: string): ReplyShape => SHAPES[name] ?? PLAIN;

/** The longest line that the board takes, without its line end. */
export const MAX_LINE_BYTES = 255;

/**
 * The name of a line's command, as the board reads it: the first two characters, or only the first one before a comma.
 * "sp,1,250" -> "SP", "r,1" -> "R", "BL;" -> "BL".
 */
export const commandName = (line: string): string =>
  (line[1] === "," ? line.slice(0, 1) : line.slice(0, 2)).toUpperCase();

/** Whether a command with this name only returns values, so that it may be repeated. */
export const isQuery = (name: string): boolean => /^(Q|PI|V)/.test(name);

/** The counters in the reply `m1,m2` of `QS`, counted from `origin`. */
export function parseSteps(
  reply: string,
  origin: readonly [number, number] = [0, 0],
): readonly [number, number] {
  const [first = 0, second = 0] = reply.split(",").map(Number);
  return [first + origin[0], second + origin[1]];
}

/**
 * Number of commands waiting in the board's queue, from the reply to a query; null if the query
 * does not report it.
 */
export function waitingCount(line: string, reply: string): number | null {
  if (line === "QU,6") return Number(reply.split(",").pop());
  if (line === "QG") return Number.parseInt(reply, 16) & 1;
  if (line === "QM") return reply.split(",").length === 4 ? Number(reply.split(",")[3]) : null;
  return null;
}
