import { readFileSync } from "node:fs";
import { PlotwrightError } from "../../src/index.js";
import { textOfBytes } from "../../src/internal.js";

/** The file's text; throws `bad-file` with the reason if it can't be read. */
export function readDrawing(file: string): string {
  try {
    return textOfBytes(readFileSync(file));
  } catch (cause) {
    const { code, message } = cause as NodeJS.ErrnoException;
    const why = code === "ENOENT" ? "there is no such file" : code === "EISDIR" ? "it is a folder" : message;
    throw new PlotwrightError("bad-file", `${file} can't be read: ${why}.`, { cause });
  }
}
