import { readFileSync } from "node:fs";
import { PlotwrightError } from "../../src/index.js";
import { textOfBytes } from "../../src/internal.js";
import { fileFault } from "../storage/file-fault.js";

/** The file's text, whatever its encoding; throws `bad-file` with the reason if it can't be read. */
export function readDrawing(file: string): string {
  return textOfBytes(readBytes(file));
}

/** The file's bytes; throws `bad-file` with the reason if it can't be read. */
export function readBytes(file: string): Buffer<ArrayBuffer> {
  try {
    return readFileSync(file);
  } catch (cause) {
    throw new PlotwrightError("bad-file", `${file} can't be read: ${fileFault(cause)}.`, { cause });
  }
}
