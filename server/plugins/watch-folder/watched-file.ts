/**
 * Reads the files of a watched folder, which other programs write. A name may also belong to a named pipe, a device, a
 * folder or a link that leads nowhere, and a file may be of any size. None of them may hold up the server.
 */
import { createHash } from "node:crypto";
import { constants, type Stats } from "node:fs";
import { lstat, open, stat, type FileHandle } from "node:fs/promises";
import { basename } from "node:path";
import { PlotwrightError } from "../../../src/index.js";
import { fileFault } from "../../storage/file-fault.js";

/** Many times the settings of a drawing with hundreds of layers. */
const MAX_SETTINGS_BYTES = 1_000_000;

/** Opening a named pipe would otherwise wait until another program writes to it. Windows has neither. */
const OPEN_AT_ONCE = constants.O_RDONLY | (constants.O_NONBLOCK ?? 0) | (constants.O_NOCTTY ?? 0);

/**
 * Calls `use` with the drawing, or returns null if it is no regular file, or a link. `use` may read it several times: it
 * stays the same file even if the name gets another one.
 */
export async function withDrawing<T>(
  path: string,
  use: (drawing: WatchedDrawing) => Promise<T>,
): Promise<T | null> {
  if (!(await lstat(path)).isFile()) return null;
  const file = await open(path, OPEN_AT_ONCE | (constants.O_NOFOLLOW ?? 0));
  try {
    const stats = await file.stat();
    return stats.isFile() ? await use(new WatchedDrawing(file, stats.size)) : null;
  } finally {
    await file.close();
  }
}

export class WatchedDrawing {
  constructor(
    private readonly file: FileHandle,
    readonly bytes: number,
  ) {}

  /** Its bytes at this time, from the beginning: a file that grows has an end all the same. */
  chunks(): AsyncIterable<Buffer> {
    if (this.bytes === 0) return (async function* () {})();
    return this.file.createReadStream({ start: 0, end: this.bytes - 1, autoClose: false });
  }

  /** Rejects when the signal is aborted. */
  async sha256(signal: AbortSignal): Promise<string> {
    const hash = createHash("sha256");
    for await (const chunk of this.chunks()) {
      signal.throwIfAborted();
      hash.update(chunk);
    }
    return hash.digest("hex");
  }
}

/** The text of a settings file; null if there is none. Throws `bad-setting` if it can't be read. */
export async function settingsText(path: string): Promise<string | null> {
  if ((await orNull(lstat(path))) === null) return null;
  try {
    return await textOf(path);
  } catch (cause) {
    if (cause instanceof PlotwrightError) throw cause;
    throw unreadable(path, fileFault(cause), cause);
  }
}

async function textOf(path: string): Promise<string> {
  // Not opened yet: opening a device can have an effect.
  mustBeFile(path, await stat(path));
  const file = await open(path, OPEN_AT_ONCE);
  try {
    mustBeFile(path, await file.stat());
    // The size of a file may not be true, as below /proc.
    const buffer = Buffer.alloc(MAX_SETTINGS_BYTES + 1);
    let bytes = 0;
    for (;;) {
      const { bytesRead } = await file.read(buffer, bytes, buffer.length - bytes, bytes);
      bytes += bytesRead;
      if (bytes > MAX_SETTINGS_BYTES) throw tooLarge(path);
      if (bytesRead === 0) return buffer.toString("utf8", 0, bytes);
    }
  } finally {
    await file.close();
  }
}

function mustBeFile(path: string, stats: Stats): void {
  if (!stats.isFile()) throw unreadable(path, stats.isDirectory() ? "it is a folder" : "it is not a file");
  if (stats.size > MAX_SETTINGS_BYTES) throw tooLarge(path);
}

const tooLarge = (path: string): PlotwrightError =>
  unreadable(path, `it is larger than ${MAX_SETTINGS_BYTES / 1e6} MB`);

const unreadable = (path: string, why: string, cause?: unknown): PlotwrightError =>
  new PlotwrightError("bad-setting", `${basename(path)} can't be read: ${why}.`, { cause });

/** Null if there is no such file. */
function orNull<T>(found: Promise<T>): Promise<T | null> {
  return found.catch((error: unknown) => {
    if ((error as NodeJS.ErrnoException).code === "ENOENT") return null;
    throw error;
  });
}
