/**
 * The pictures of jobs: files in a folder of each job, named by their time. Their number and size are limited, for each
 * job and in total.
 */
import { mkdir, readFile, readdir, rename, rm, stat, writeFile } from "node:fs/promises";
import { join } from "node:path";
import { PlotwrightError } from "../../../src/index.js";
import { PICTURE_TYPES, type PictureKind } from "../../../src/schema/index.js";
import type { CameraPicture } from "./fetch-picture.js";

export interface PictureFile {
  /** ms since 1970. */
  readonly atMs: number;
  readonly bytes: number;
  readonly kind: PictureKind;
}

export const PICTURE_LIMITS = {
  maxCount: 240,
  maxJobBytes: 50_000_000,
  /** Past it, all pictures of the jobs that were plotted longest ago go. */
  maxTotalBytes: 2_000_000_000,
};
export type PictureLimits = typeof PICTURE_LIMITS;

/** In the folder of a job: how many pictures are missing. */
const MISSING = "missing";

/** How long pictures stay whose job is missing: its database may be an older copy. */
const UNCLAIMED_MS = 30 * 86_400_000;

export class PictureFiles {
  private readonly dir: string;
  /** Changes are made one after the other. */
  private last: Promise<unknown> = Promise.resolve();
  /** By job id, oldest first; null until the folders were read. */
  private index: Promise<Map<string, PictureFile[]>> | null = null;
  /** How many pictures are missing, by job id, as far as it was counted or read. */
  private readonly missingCounts = new Map<string, number>();

  constructor(
    dataDir: string,
    private readonly limits: PictureLimits = PICTURE_LIMITS,
  ) {
    this.dir = join(dataDir, "pictures");
  }

  async list(jobId: string): Promise<readonly PictureFile[]> {
    return (await this.all()).get(jobId) ?? [];
  }

  add(jobId: string, picture: CameraPicture, atMs: number): Promise<void> {
    return this.inTurn(() => this.write(jobId, picture, atMs));
  }

  /** How many pictures of a job could not be taken or stored. */
  async missing(jobId: string): Promise<number> {
    const text = await readFile(join(this.folder(jobId), MISSING), "utf8").catch(() => "0");
    return this.missingCounts.get(jobId) ?? (Number.parseInt(text, 10) || 0);
  }

  /** Counts a missing picture, also if even that can't be stored. */
  addMissing(jobId: string): Promise<void> {
    return this.inTurn(async () => {
      const count = (await this.missing(jobId)) + 1;
      this.missingCounts.set(jobId, count);
      await mkdir(this.folder(jobId), { recursive: true, mode: 0o700 });
      await writeFile(join(this.folder(jobId), MISSING), String(count), { mode: 0o600 });
    });
  }

  remove(jobId: string): Promise<void> {
    return this.inTurn(() => this.drop(jobId));
  }

  /** Throws `not-found`. */
  async read(jobId: string, atMs: number): Promise<Uint8Array> {
    const file = (await this.list(jobId)).find((one) => one.atMs === atMs);
    const bytes = file && (await readFile(this.path(jobId, file)).catch(() => undefined));
    if (bytes === undefined) throw new PlotwrightError("not-found", "There is no such picture of this job.");
    return bytes;
  }

  /** Removes the pictures of jobs that have been missing for long. */
  async sweep(isJob: (id: string) => boolean, nowMs = Date.now()): Promise<void> {
    for (const [id, files] of await this.all()) {
      const lastMs = files.at(-1)?.atMs ?? 0;
      if (!isJob(id) && nowMs - lastMs > UNCLAIMED_MS) await this.remove(id);
    }
  }

  private async write(jobId: string, { kind, bytes }: CameraPicture, atMs: number): Promise<void> {
    const all = await this.all();
    const kept = all.get(jobId) ?? [];
    const last = kept.at(-1)?.atMs ?? 0;
    const file: PictureFile = { atMs: Math.max(atMs, last + 1), bytes: bytes.byteLength, kind };
    await mkdir(this.folder(jobId), { recursive: true, mode: 0o700 });
    const path = this.path(jobId, file);
    await writeFile(`${path}.new`, bytes, { mode: 0o600 });
    await rename(`${path}.new`, path);
    const { kept: left, dropped } = thinned([...kept, file], this.limits);
    all.delete(jobId);
    all.set(jobId, left);
    await Promise.all(dropped.map((one) => rm(this.path(jobId, one), { force: true })));
    await this.fitInTotal(all);
  }

  private async drop(jobId: string): Promise<void> {
    (await this.all()).delete(jobId);
    this.missingCounts.delete(jobId);
    await rm(this.folder(jobId), { recursive: true, force: true });
  }

  private inTurn(change: () => Promise<void>): Promise<void> {
    const done = this.last.then(change);
    this.last = done.catch(() => undefined);
    return done;
  }

  private folder(jobId: string): string {
    if (!isJobId(jobId)) throw new RangeError(`Not a job's id: ${jobId}`);
    return join(this.dir, jobId);
  }

  private path(jobId: string, { atMs, kind }: PictureFile): string {
    return join(this.folder(jobId), `${atMs}.${kind}`);
  }

  private all(): Promise<Map<string, PictureFile[]>> {
    this.index ??= this.readAll();
    return this.index;
  }

  private async readAll(): Promise<Map<string, PictureFile[]>> {
    const jobs: [string, PictureFile[]][] = [];
    for (const jobId of (await readdir(this.dir).catch(() => [])).filter(isJobId)) {
      const files: PictureFile[] = [];
      for (const name of await readdir(join(this.dir, jobId)).catch(() => [])) {
        const [, atMs, kind] = /^(\d{1,15})\.(\w+)$/.exec(name) ?? [];
        // The rest of a picture that was being written when the server ended.
        if (name.endsWith(".new")) await rm(join(this.dir, jobId, name), { force: true });
        if (kind === undefined || !(kind in PICTURE_TYPES)) continue;
        const found = await stat(join(this.dir, jobId, name)).catch(() => null);
        if (found) files.push({ atMs: Number(atMs), bytes: found.size, kind: kind as PictureKind });
      }
      files.sort((a, b) => a.atMs - b.atMs);
      jobs.push([jobId, files]);
    }
    const lastMs = (files: readonly PictureFile[]): number => files.at(-1)?.atMs ?? 0;
    return new Map(jobs.sort(([, a], [, b]) => lastMs(a) - lastMs(b)));
  }

  /** The job that got a picture last is the last one, and keeps its own. */
  private async fitInTotal(all: ReadonlyMap<string, readonly PictureFile[]>): Promise<void> {
    const sizes = [...all].map(([id, files]) => ({ id, bytes: bytesOf(files) }));
    let total = sizes.reduce((sum, { bytes }) => sum + bytes, 0);
    for (const { id, bytes } of sizes.slice(0, -1)) {
      if (total <= this.limits.maxTotalBytes) return;
      await this.drop(id);
      total -= bytes;
    }
  }
}

const isJobId = (text: string): boolean => /^[\w-]{1,100}$/.test(text);
const bytesOf = (files: readonly PictureFile[]): number => files.reduce((sum, { bytes }) => sum + bytes, 0);

/**
 * Drops pictures until the rest is within the limits: each time the one whose neighbours are closest in time. So the
 * rest stays evenly spread over the plot, however long it gets. The first and the newest stay.
 */
export function thinned(
  files: readonly PictureFile[],
  { maxCount, maxJobBytes }: Pick<PictureLimits, "maxCount" | "maxJobBytes">,
): { readonly kept: PictureFile[]; readonly dropped: PictureFile[] } {
  const kept = [...files];
  const dropped: PictureFile[] = [];
  while (kept.length > 2 && (kept.length > maxCount || bytesOf(kept) > maxJobBytes)) {
    let at = 1;
    let least = Infinity;
    for (let i = 1; i + 1 < kept.length; i++) {
      const spanMs = kept[i + 1].atMs - kept[i - 1].atMs;
      if (spanMs < least) [at, least] = [i, spanMs];
    }
    dropped.push(...kept.splice(at, 1));
  }
  return { kept, dropped };
}
