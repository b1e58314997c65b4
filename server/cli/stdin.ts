/** The bytes of stdin. They are read once and stored, since copies and a check of --config read them again. */
import { readFileSync } from "node:fs";
import { PlotwrightError } from "../../src/index.js";

/** Named in messages. */
export type StdinUse = "the drawing" | "--config" | "--machine-file" | "--cert" | "--key";

let stored: { readonly bytes: Uint8Array; readonly use: StdinUse } | null = null;

/** Throws `bad-setting` if it was read for another use. */
export function readStdin(use: StdinUse): Uint8Array {
  stored ??= { bytes: readFileSync(0), use };
  if (stored.use === use) return stored.bytes;
  throw new PlotwrightError(
    "bad-setting",
    `Standard input can't be both ${stored.use} and ${use}: give one of them a file.`,
  );
}
