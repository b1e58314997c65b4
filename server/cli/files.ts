/** Files of the command line, where "-" is stdin or stdout. */
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join, resolve } from "node:path";
import { PlotwrightError } from "../../src/index.js";
import { fileFault } from "../storage/file-fault.js";
import type { CliIo } from "./io.js";
import { readStdin } from "./stdin.js";

export const readText = (path: string): string =>
  path === "-" ? Buffer.from(readStdin()).toString("utf8") : readFileSync(path, "utf8");

/** The name for messages. */
export const nameOf = (file: string): string => (file === "-" ? "stdin" : file);

/** The drawing as a file, for threads that read it by its path. Stdin is written to a temporary file during `use`. */
export async function withDrawingFile<T>(file: string, use: (path: string) => Promise<T>): Promise<T> {
  if (file !== "-") return use(resolve(file));
  const folder = mkdtempSync(join(tmpdir(), "plotwright-stdin-"));
  try {
    const path = join(folder, "stdin");
    writeFileSync(path, readStdin());
    return await use(path);
  } finally {
    rmSync(folder, { recursive: true, force: true });
  }
}

export function writeOut(path: string, text: string, io: Pick<CliIo, "out">): void {
  if (path === "-") {
    io.out(text);
    return;
  }
  try {
    writeFileSync(path, text);
  } catch (cause) {
    throw new PlotwrightError("bad-setting", `${path} can't be written: ${fileFault(cause)}.`, {
      cause,
    });
  }
}
