/** Text from drawings, boards, people and other programs, made safe to print in lists, logs and terminals. */

/**
 * Control characters, and characters that change the writing direction: with them, a text could forge lines of a log, or
 * control a terminal.
 */
const UNPRINTABLE = /[\p{Cc}\u061c\u200e\u200f\u2028\u2029\u202a-\u202e\u2066-\u2069]+/gu;
/** Half a surrogate pair, which cannot be encoded as text. */
const LONE_SURROGATES = /\p{Cs}/gu;

/** One line of text that is safe to print. */
export const printable = (text: string): string =>
  text.replace(UNPRINTABLE, " ").replace(LONE_SURROGATES, "\ufffd");

/** JSON of one line that is safe to print. Its meaning is the same: unprintable characters are written as \uXXXX. */
export const printableJson = (value: unknown): string =>
  withCodes(JSON.stringify(value), (hex) => `\\u${hex.padStart(4, "0")}`);

/** The text with a code for each unprintable character, made from its hexadecimal number. */
export const withCodes = (text: string, codeOf: (hex: string) => string): string =>
  text.replace(UNPRINTABLE, (found) =>
    [...found].map((one) => codeOf(one.charCodeAt(0).toString(16))).join(""),
  );
