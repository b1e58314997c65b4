/** Names given by people, which appear in lists, logs and file names. */
import { z } from "zod";
import { printable } from "../plain-text.js";

/** A name that is safe everywhere. */
export const cleanName = (text: string): string => printable(text).trim();

/** A name of at most `longest` characters, without unprintable ones; never empty. */
export const nameSchema = (longest: number) =>
  z.string().overwrite(cleanName).min(1, "a name needs at least one character").max(longest);
