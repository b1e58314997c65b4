/**
 * One server per data folder.
 *
 * The lock is a file that names the process that owns it. Node has no flock(), so a killed owner leaves the file
 * behind. It is stale when that process has ended.
 */
import { linkSync, lstatSync, readFileSync, renameSync, rmSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { randomBytes } from "node:crypto";
import { PlotwrightError } from "../../src/index.js";
import { isAlive, thisProcess, type ProcessOwner } from "./process-owner.js";

/** Takes the lock or throws `conflict`; the returned function releases it. */
export function lockDataDir(dir: string): () => void {
  const path = join(dir, "server.lock");
  const mine = thisProcess();
  const draft = `${path}.${randomBytes(6).toString("hex")}`;
  try {
    writeFileSync(draft, JSON.stringify(mine), { mode: 0o600 });
  } catch (cause) {
    rmSync(draft, { force: true });
    throw new PlotwrightError(
      "bad-setting",
      `The data folder ${dir} can't be written to (${(cause as Error).message}). Make room there, or choose another folder with --data.`,
      { cause },
    );
  }
  try {
    for (let attempt = 0; attempt < 5; attempt++) {
      if (tryLink(draft, path)) return () => release(path, mine);
      mustBeFile(path);
      const owner = readOwner(path);
      if (owner !== null && isAlive(owner)) throw inUse(dir, owner.pid);
      const pid = removeStale(path, `${draft}.stale`);
      if (pid !== null) throw inUse(dir, pid);
    }
    throw inUse(dir, 0);
  } finally {
    rmSync(draft, { force: true });
  }
}

/**
 * Removes a stale lock. Returns null, or the process that has replaced the lock since it was found stale: its lock is
 * put back.
 */
function removeStale(path: string, aside: string): number | null {
  try {
    // Rename it first, so that only one of two servers that find it stale removes it.
    renameSync(path, aside);
  } catch {
    return null;
  }
  try {
    const owner = readOwner(aside);
    if (owner === null || !isAlive(owner)) return null;
    tryLink(aside, path);
    return owner.pid;
  } finally {
    rmSync(aside, { force: true });
  }
}

/** A folder could not be replaced, and reading a named pipe would wait endlessly. */
function mustBeFile(path: string): void {
  if (lstatSync(path, { throwIfNoEntry: false })?.isFile() !== false) return;
  throw new PlotwrightError(
    "bad-setting",
    `${path} is not a file, but a server needs that name for its lock. Rename or remove it, or choose another folder with --data.`,
  );
}

/** In one step, link() creates the name with its complete content, or fails if the name exists. */
function tryLink(from: string, to: string): boolean {
  try {
    linkSync(from, to);
    return true;
  } catch (error) {
    if ((error as NodeJS.ErrnoException).code === "EEXIST") return false;
    throw error;
  }
}

/**
 * Adds the server's address to its lock, for people who start a second server.
 *
 * @throws Error of the file system
 */
export function noteAddress(dir: string, url: string): void {
  const path = join(dir, "server.lock");
  const draft = `${path}.${randomBytes(6).toString("hex")}`;
  try {
    writeFileSync(draft, JSON.stringify({ ...thisProcess(), url }), { mode: 0o600 });
    renameSync(draft, path);
  } finally {
    rmSync(draft, { force: true });
  }
}

/** The address of the running server that uses the folder; null if there is none, or it does not listen yet. */
export function addressOfServer(dir: string): string | null {
  const owner = readOwner(join(dir, "server.lock"));
  return owner !== null && isAlive(owner) ? (owner.url ?? null) : null;
}

function release(path: string, mine: ProcessOwner): void {
  const owner = readOwner(path);
  if (owner?.pid === mine.pid && owner.began === mine.began) rmSync(path, { force: true });
}

function readOwner(path: string): (ProcessOwner & { readonly url?: string }) | null {
  try {
    const value: unknown = JSON.parse(readFileSync(path, "utf8"));
    if (typeof value !== "object" || value === null) return null;
    const { pid, began, url } = value as Record<string, unknown>;
    return typeof pid === "number" && Number.isInteger(pid) && pid > 0 && typeof began === "string"
      ? { pid, began, ...(typeof url === "string" ? { url } : {}) }
      : null;
  } catch {
    return null;
  }
}

function inUse(dir: string, pid: number): PlotwrightError {
  const who = pid > 0 ? ` (process ${pid})` : "";
  return new PlotwrightError(
    "conflict",
    `Another plotwright server${who} uses the data folder ${dir}. Stop it, or choose another folder with --data.`,
  );
}
