/**
 * Uploaded drawings on disk, each under the SHA-256 of its bytes, so that copies of a job share one file.
 * A file is complete and flushed before its name exists; a database row refers to it only after that.
 */
import { createHash, randomBytes } from "node:crypto";
import { createReadStream, type ReadStream } from "node:fs";
import { open, readdir, rename, rm, stat } from "node:fs/promises";
import { join } from "node:path";
import { PlotwrightError } from "../../src/index.js";

export interface StoredDrawing {
  readonly sha256: string;
  readonly bytes: number;
}

export class DrawingFiles {
  readonly #dir: string;
  readonly #maxBytes: number;

  constructor(dataDir: string, maxBytes: number) {
    this.#dir = join(dataDir, "drawings");
    this.#maxBytes = maxBytes;
  }

  path(sha256: string): string {
    if (!/^[0-9a-f]{64}$/.test(sha256)) throw new RangeError(`Not a SHA-256: ${sha256}`);
    return join(this.#dir, `${sha256}.svg`);
  }

  read(sha256: string): ReadStream {
    return createReadStream(this.path(sha256));
  }

  /** Writes a stream to disk as it comes in; throws `too-large` past the limit and leaves nothing behind. */
  async add(chunks: AsyncIterable<Uint8Array> | Iterable<Uint8Array>): Promise<StoredDrawing> {
    const draft = join(this.#dir, `incoming-${randomBytes(8).toString("hex")}`);
    const hash = createHash("sha256");
    let bytes = 0;
    const file = await open(draft, "wx", 0o600);
    try {
      try {
        for await (const chunk of chunks) {
          bytes += chunk.byteLength;
          if (bytes > this.#maxBytes) throw tooLarge(this.#maxBytes);
          hash.update(chunk);
          await file.write(chunk);
        }
        await file.sync();
      } finally {
        await file.close();
      }
      const sha256 = hash.digest("hex");
      await rename(draft, this.path(sha256));
      await syncFolder(this.#dir);
      return { sha256, bytes };
    } catch (error) {
      await rm(draft, { force: true });
      throw error;
    }
  }

  async remove(sha256: string): Promise<void> {
    await rm(this.path(sha256), { force: true });
  }

  /** Takes away what no job refers to: uploads cut off by a crash, drawings of removed jobs. */
  async sweep(isUsed: (sha256: string) => boolean): Promise<void> {
    for (const name of await readdir(this.#dir)) {
      const sha256 = /^([0-9a-f]{64})\.svg$/.exec(name)?.[1];
      if (sha256 === undefined ? name.startsWith("incoming-") : !isUsed(sha256)) {
        await rm(join(this.#dir, name), { force: true });
      }
    }
  }

  async exists(sha256: string): Promise<boolean> {
    return stat(this.path(sha256)).then(
      () => true,
      () => false,
    );
  }
}

export function tooLarge(maxBytes: number): PlotwrightError {
  return new PlotwrightError(
    "too-large",
    `The file is larger than ${Math.round(maxBytes / 1e6)} MB, the most this server takes. Simplify the drawing, or start the server with a larger --max-upload-mb.`,
  );
}

/** A renamed file survives a power cut only when its folder is flushed too; not every system allows that. */
async function syncFolder(dir: string): Promise<void> {
  try {
    const folder = await open(dir, "r");
    try {
      await folder.sync();
    } finally {
      await folder.close();
    }
  } catch {
    // Windows opens no folders; there the rename itself is journaled.
  }
}
