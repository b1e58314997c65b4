/** The parser of options that are lengths. */
import { InvalidArgumentError } from "commander";
import { parseLength } from "../../src/internal.js";

export function length(text: string): number {
  const mm = parseLength(text);
  if (mm === null)
    throw new InvalidArgumentError("It must be a length in mm, or with a unit as in 2cm or 1in.");
  return mm;
}
