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
    throw new PlotwrightError("bad-file", `${file} can't be read: ${fileFault(cause)}.`, { cause });
  }
}

const FILE_FAULTS: Readonly<Record<string, string>> = {
  ENOENT: "there is no such file or folder",
  EISDIR: "it is a folder",
  EACCES: "you have no permission",
  EPERM: "you have no permission",
  EROFS: "the disk is read-only",
  ENOSPC: "the disk is full",
};

/** Why a file cannot be read or written. */
export function fileFault(cause: unknown): string {
  const { code, message } = cause as NodeJS.ErrnoException;
  return FILE_FAULTS[code ?? ""] ?? message;
}
