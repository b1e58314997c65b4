import { readFileSync } from "node:fs";
import { PlotwrightError } from "../../src/index.js";
import { textOfBytes } from "../../src/internal.js";

/** The file's text, whatever its encoding; throws `bad-file` with the reason if it can't be read. */
export function readDrawing(file: string): string {
  return textOfBytes(readBytes(file));
}

/** The file as it is; throws `bad-file` with the reason if it can't be read. */
export function readBytes(file: string): Buffer<ArrayBuffer> {
  try {
    return readFileSync(file);
  } catch (cause) {
    const { code, message } = cause as NodeJS.ErrnoException;
    const why = code === "ENOENT" ? "there is no such file" : code === "EISDIR" ? "it is a folder" : message;
    throw new PlotwrightError("bad-file", `${file} can't be read: ${why}.`, { cause });
  }
}
