/** Files of the command line, where "-" is stdin or stdout. */
import { accessSync, constants, mkdtempSync, readFileSync, rmSync, statSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { basename, join, resolve } from "node:path";
import { PlotwrightError } from "../../src/index.js";
import { fileFault } from "../storage/file-fault.js";
import type { CliIo } from "./io.js";
import { readStdin, type StdinUse } from "./stdin.js";

/** Throws the system's error. */
export const readText = (path: string, use: StdinUse): string =>
  Buffer.from(path === "-" ? readStdin(use) : bytesOf(path)).toString("utf8");

/** The bytes of named pipes, by path. Like stdin they can be read only once, but copies need them again. */
const pipes = new Map<string, Uint8Array>();

function bytesOf(file: string): Uint8Array {
  if (!isPipe(file)) return readFileSync(file);
  const bytes = pipes.get(file) ?? readFileSync(file);
  pipes.set(file, bytes);
  return bytes;
}

/** The name for messages. */
export const nameOf = (file: string): string => (file === "-" ? "stdin" : file);

/** Checks all drawings before the first one is used; throws `bad-file` for one that can't be read. */
export function mustBeReadable(files: readonly string[]): void {
  for (const file of files.filter((one) => one !== "-")) {
    const why = whyUnreadable(file);
    if (why !== null) throw new PlotwrightError("bad-file", `${file} can't be read: ${why}.`);
  }
}

function whyUnreadable(file: string): string | null {
  try {
    accessSync(file, constants.R_OK);
    return statSync(file).isDirectory() ? "it is a folder" : null;
  } catch (cause) {
    return fileFault(cause);
  }
}

/** For a command that only reads the data folder: a mistyped one would look like an empty one. */
export function mustBeDataFolder(data: string | undefined): void {
  if (data === undefined || statSync(data, { throwIfNoEntry: false })?.isDirectory() === true) return;
  throw new PlotwrightError("bad-setting", `--data ${data}: there is no such folder.`);
}

/**
 * The drawing as a file, for threads that read it by its path. Stdin and pipes, which can be read only once, are
 * written to a temporary file during `use`. Errors in the drawing name it.
 */
export async function withDrawingFile<T>(file: string, use: (path: string) => Promise<T>): Promise<T> {
  mustBeReadable([file]);
  try {
    if (file !== "-" && !isPipe(file)) return await use(resolve(file));
    const folder = mkdtempSync(join(tmpdir(), "plotwright-stdin-"));
    try {
      const path = join(folder, "stdin");
      writeFileSync(path, file === "-" ? readStdin("the drawing") : bytesOf(file));
      return await use(path);
    } finally {
      rmSync(folder, { recursive: true, force: true });
    }
  } catch (error) {
    throw naming(nameOf(file), error);
  }
}

const isPipe = (file: string): boolean => statSync(file, { throwIfNoEntry: false })?.isFIFO() === true;

/** The error, with the drawing's name if the drawing is at fault. */
function naming(name: string, error: unknown): unknown {
  if (!(error instanceof PlotwrightError) || !["bad-file", "too-large", "out-of-bounds"].includes(error.code))
    return error;
  if (error.message.includes(basename(name))) return error;
  return new PlotwrightError(error.code, `${name}: ${error.message}`, { cause: error });
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
