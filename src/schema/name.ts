/** Names that people give, and that go into lists, logs and file names. */
import { z } from "zod";

/** Control characters, and what turns the direction of writing: with them a name could forge lines of a log. */
const UNPRINTABLE = /[\p{Cc}\u2028\u2029\u202a-\u202e\u2066-\u2069]+/gu;
/** Half a character, which no text can be written with. */
const LONE_SURROGATES = /\p{Cs}/gu;

/** One line of text that can be written everywhere. */
export const cleanName = (text: string): string =>
  text.replace(UNPRINTABLE, " ").replace(LONE_SURROGATES, "\ufffd").trim();

/** A name of at most so many characters, without what can't be printed; never empty. */
export const nameSchema = (longest: number) =>
  z.string().overwrite(cleanName).min(1, "a name needs at least one character").max(longest);
