/**
 * Uploaded drawings on disk, one file for each upload; copies of a job share it.
 * A file is complete and flushed before its name exists; a database row refers to it only after that.
 */
import { randomBytes } from "node:crypto";
import { existsSync } from "node:fs";
import { mkdir, open, readdir, rename, rm } from "node:fs/promises";
import { join } from "node:path";
import { PlotwrightError } from "../../src/index.js";
import { unpackUpload } from "../planning/unpack.js";

export interface StoredDrawing {
  readonly id: string;
  readonly bytes: number;
}

export class DrawingFiles {
  readonly #dir: string;
  /** Where drawings are kept that no job names. */
  readonly unclaimedDir: string;
  readonly #maxBytes: number;

  constructor(dataDir: string, maxBytes: number) {
    this.#dir = join(dataDir, "drawings");
    this.unclaimedDir = join(dataDir, "unclaimed-drawings");
    this.#maxBytes = maxBytes;
  }

  path(id: string): string {
    if (!/^[0-9a-f]{32}$/.test(id)) throw new RangeError(`Not a drawing's id: ${id}`);
    return join(this.#dir, `${id}.svg`);
  }

  /** Writes a stream to disk as it comes in; throws `too-large` past the limit and leaves nothing behind. */
  async add(chunks: AsyncIterable<Uint8Array> | Iterable<Uint8Array>): Promise<StoredDrawing> {
    const id = newId();
    const draft = join(this.#dir, `incoming-${id}`);
    let bytes = 0;
    const file = await open(draft, "wx", 0o600);
    try {
      try {
        for await (const chunk of chunks) {
          bytes += chunk.byteLength;
          if (bytes > this.#maxBytes) throw tooLarge(this.#maxBytes);
          await file.write(chunk);
        }
        await file.sync();
      } finally {
        await file.close();
      }
      await rename(draft, this.path(id));
      await syncFolder(this.#dir);
      return { id, bytes };
    } catch (error) {
      await rm(draft, { force: true });
      throw error;
    }
  }

  /** The same for a JSON object with the drawing's text in it: gives back the rest of the object too. */
  async addFromJson(
    chunks: AsyncIterable<Uint8Array>,
  ): Promise<{ readonly drawing: StoredDrawing; readonly rest: unknown }> {
    const upload = await this.add(chunks);
    const id = newId();
    try {
      const { rest, drawingBytes } = await unpackUpload({
        path: this.path(upload.id),
        drawingPath: this.path(id),
      });
      await syncFolder(this.#dir);
      return { drawing: { id, bytes: drawingBytes }, rest };
    } catch (error) {
      await this.remove(id);
      throw error;
    } finally {
      await this.remove(upload.id);
    }
  }

  async remove(id: string): Promise<void> {
    await rm(this.path(id), { force: true });
  }

  /**
   * Removes uploads that were cut off, and moves complete drawings that no job names out of the way; returns how many.
   * They are not deleted: the database that should name them may have been damaged, or be an older copy. Drawings that
   * are named again come back.
   */
  async sweep(isUsed: (id: string) => boolean): Promise<number> {
    let movedCount = 0;
    for (const name of await readdir(this.#dir)) {
      const id = drawingId(name);
      if (id === undefined && name.startsWith("incoming-")) await rm(join(this.#dir, name), { force: true });
      if (id === undefined || isUsed(id)) continue;
      await mkdir(this.unclaimedDir, { recursive: true, mode: 0o700 });
      await rename(join(this.#dir, name), join(this.unclaimedDir, name));
      movedCount++;
    }
    for (const name of existsSync(this.unclaimedDir) ? await readdir(this.unclaimedDir) : []) {
      const id = drawingId(name);
      if (id !== undefined && isUsed(id)) await rename(join(this.unclaimedDir, name), join(this.#dir, name));
    }
    return movedCount;
  }
}

const drawingId = (fileName: string): string | undefined => /^([0-9a-f]{32})\.svg$/.exec(fileName)?.[1];
const newId = (): string => randomBytes(16).toString("hex");

function tooLarge(maxBytes: number): PlotwrightError {
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
