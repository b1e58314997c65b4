/** Names given by people, which appear in lists, logs and file names. */
import { z } from "zod";

/**
 * Control characters, and characters that change the writing direction: a name with them could forge log
 * lines.
 */
const UNPRINTABLE = /[\p{Cc}\u2028\u2029\u202a-\u202e\u2066-\u2069]+/gu;
/** Half a surrogate pair, which cannot be encoded as text. */
const LONE_SURROGATES = /\p{Cs}/gu;

/** One line of text that is safe everywhere. */
export const cleanName = (text: string): string =>
  text.replace(UNPRINTABLE, " ").replace(LONE_SURROGATES, "\ufffd").trim();

/** A name of at most `longest` characters, without unprintable ones; never empty. */
export const nameSchema = (longest: number) =>
  z.string().overwrite(cleanName).min(1, "a name needs at least one character").max(longest);
