/**
 * Uploaded drawings on disk, one file per upload. Copies of a job share the file.
 * A file gets its final name only when it is complete and flushed; database rows refer to it only after that.
 */
import { randomBytes } from "node:crypto";
import { existsSync } from "node:fs";
import { mkdir, open, readdir, rename, rm, stat } from "node:fs/promises";
import { join } from "node:path";
import { PlotwrightError } from "../../src/index.js";
import type { DrawingStore, GrowingDrawing, StoredDrawing } from "../../host/storage.js";

export type { StoredDrawing } from "../../host/storage.js";

/** How long a drawing that belongs to no job is kept: long enough to notice that its job is missing. */
export const UNCLAIMED_DAYS = 30;

export class DrawingFiles implements DrawingStore {
  private readonly dir: string;
  /** Folder for drawings that belong to no job. */
  readonly unclaimedDir: string;
  /** Size limit of one file. */
  readonly maxBytes: number;

  constructor(dataDir: string, maxBytes: number) {
    this.dir = join(dataDir, "drawings");
    this.unclaimedDir = join(dataDir, "unclaimed-drawings");
    this.maxBytes = maxBytes;
  }

  path(id: string): string {
    if (!/^[0-9a-f]{32}$/.test(id)) throw new RangeError(`Not a drawing's id: ${id}`);
    return join(this.dir, `${id}.svg`);
  }

  /**
   * Writes a stream to disk as it arrives. Throws `too-large` past the limit, and then leaves no file behind.
   */
  async add(chunks: AsyncIterable<Uint8Array> | Iterable<Uint8Array>): Promise<StoredDrawing> {
    const id = newId();
    const draft = join(this.dir, `incoming-${id}`);
    let bytes = 0;
    const file = await open(draft, "wx", 0o600);
    try {
      try {
        for await (const chunk of chunks) {
          bytes += chunk.byteLength;
          this.mustFit(bytes);
          await file.write(chunk);
        }
        await file.sync();
      } finally {
        await file.close();
      }
      await rename(draft, this.path(id));
      await syncFolder(this.dir);
      return { id, bytes };
    } catch (error) {
      await rm(draft, { force: true });
      throw error;
    }
  }

  /** A file that is written while its job is drawn. Throws `too-large` past the limit. */
  async grow(text: string): Promise<GrowingDrawing> {
    const { id } = await this.add([Buffer.from(text, "ascii")]);
    const file = await open(this.path(id), "r+");
    return {
      id,
      write: async (from, more) => {
        const bytes = Buffer.from(more, "ascii");
        this.mustFit(from + bytes.length);
        await file.write(bytes, 0, bytes.length, from);
        await file.truncate(from + bytes.length);
      },
      close: async () => {
        await file.sync();
        await file.close();
      },
    };
  }

  /** Throws `too-large` if a drawing of that size is larger than the limit. */
  mustFit(bytes: number): void {
    if (bytes > this.maxBytes) throw tooLarge(this.maxBytes);
  }

  /** As `add`, but throws `bad-file` if the file is empty. */
  async addFile(chunks: AsyncIterable<Uint8Array>): Promise<StoredDrawing> {
    const drawing = await this.add(chunks);
    if (drawing.bytes > 0) return drawing;
    await this.remove(drawing.id);
    throw new PlotwrightError(
      "bad-file",
      "The file is empty. Send the drawing as the request's body, or in a form.",
    );
  }

  async remove(id: string): Promise<void> {
    await rm(this.path(id), { force: true });
  }

  /**
   * Removes incomplete uploads and moves complete drawings that belong to no job to `unclaimedDir`; returns
   * how many were moved. They are not deleted at once, because the database that should refer to them may be damaged
   * or an older copy. Moved drawings that a job refers to again are moved back; the others are deleted after
   * UNCLAIMED_DAYS.
   */
  async sweep(isUsed: (id: string) => boolean, nowMs = Date.now()): Promise<number> {
    let movedCount = 0;
    for (const name of await readdir(this.dir)) {
      const id = drawingId(name);
      if (id === undefined && name.startsWith("incoming-")) await rm(join(this.dir, name), { force: true });
      if (id === undefined || isUsed(id)) continue;
      await mkdir(this.unclaimedDir, { recursive: true, mode: 0o700 });
      await rename(join(this.dir, name), join(this.unclaimedDir, name));
      movedCount++;
    }
    for (const name of existsSync(this.unclaimedDir) ? await readdir(this.unclaimedDir) : []) {
      const id = drawingId(name);
      if (id === undefined) continue;
      const path = join(this.unclaimedDir, name);
      if (isUsed(id)) await rename(path, join(this.dir, name));
      // Not mtimeMs: that is when it was uploaded, which moving it does not change.
      else if (nowMs - (await stat(path)).ctimeMs > UNCLAIMED_DAYS * 86_400_000) await rm(path);
    }
    return movedCount;
  }
}

const drawingId = (fileName: string): string | undefined => /^([0-9a-f]{32})\.svg$/.exec(fileName)?.[1];
const newId = (): string => randomBytes(16).toString("hex");

function tooLarge(maxBytes: number): PlotwrightError {
  return new PlotwrightError(
    "too-large",
    `The file is larger than ${Math.round(maxBytes / 1e6)} MB, the limit of this server. Simplify the drawing, or start the server with a larger --max-upload-mb.`,
  );
}

/** A renamed file survives a power cut only if its folder is flushed too, which not every system supports. */
async function syncFolder(dir: string): Promise<void> {
  try {
    const folder = await open(dir, "r");
    try {
      await folder.sync();
    } finally {
      await folder.close();
    }
  } catch {
    // Windows can't open folders; its file system journals the rename itself.
  }
}
