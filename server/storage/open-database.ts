/**
 * Opens the server's database and checks it.
 *
 * After each successful check it is copied to a backup file beside it. When the database is damaged or empty,
 * the backup replaces it and the damaged file is kept under another name. Without a good backup the server
 * does not start: an empty queue would silently lose the user's jobs.
 */
import {
  closeSync,
  copyFileSync,
  existsSync,
  fsyncSync,
  openSync,
  renameSync,
  rmSync,
  statSync,
} from "node:fs";
import { join } from "node:path";
import sqlite from "node-sqlite3-wasm";
import type { Database } from "node-sqlite3-wasm";
import { PlotwrightError } from "../../src/index.js";
import { UNCLAIMED_DAYS } from "./drawing-files.js";
import { prepareTables } from "./tables.js";

export interface OpenedDatabase {
  readonly db: Database;
  /** What was repaired, as a message for the user; null when nothing was. */
  readonly repair: string | null;
  /** Why the current database could not be backed up; null when it was. */
  readonly copyFault: string | null;
}

/** Errors of the disk or its permissions. The database itself may be intact, so it is not replaced. */
const NOT_DAMAGE = /unable to open|readonly|disk I\/O|is full|is locked/;

const pathOf = (dataDir: string): string => join(dataDir, "plotwright.db");
const copyOf = (dataDir: string): string => `${pathOf(dataDir)}.backup`;

/**
 * `read` reads everything the server will need and throws if it can't. Throws `bad-setting`, with what to do,
 * when the database can't be used.
 */
export function openDatabase(dataDir: string, read: (db: Database) => void): OpenedDatabase {
  const isFirst = isEmpty(pathOf(dataDir)) && !existsSync(copyOf(dataDir));
  if (isFirst) {
    setAside(dataDir);
    return withCopy(dataDir, openChecked(dataDir, read), null);
  }
  if (isEmpty(pathOf(dataDir))) return restored(dataDir, read, new Error("it is empty or missing"));
  try {
    return withCopy(dataDir, openChecked(dataDir, read), null);
  } catch (error) {
    if (error instanceof PlotwrightError) throw error;
    if (!(error instanceof Error) || NOT_DAMAGE.test(error.message)) throw cannotOpen(dataDir, error);
    return restored(dataDir, read, error);
  }
}

/** Replaces the database with its backup. */
function restored(dataDir: string, read: (db: Database) => void, damage: Error): OpenedDatabase {
  const [path, copy] = [pathOf(dataDir), copyOf(dataDir)];
  if (!existsSync(copy)) throw cannotRepair(dataDir, damage, "there is no copy of it");
  const copiedAt = statSync(copy).mtime.toISOString();
  const kept = setAside(dataDir);
  try {
    copyWhole(copy, path);
    const db = openChecked(dataDir, read);
    const repair = `The database ${path} could not be used: ${damage.message}. It was replaced with the copy from ${copiedAt}. Check the queue before you plot: anything added or plotted after that time is missing. The drawings of missing jobs are kept for ${UNCLAIMED_DAYS} days in ${join(dataDir, "unclaimed-drawings")}.`;
    return withCopy(dataDir, db, kept === null ? repair : `${repair} The damaged file is kept as ${kept}.`);
  } catch (error) {
    // Restore the original state: the user should find the damaged file where it was.
    removeDatabase(dataDir);
    if (kept !== null) renameAll(kept, path);
    if (error instanceof PlotwrightError) throw error;
    throw cannotRepair(dataDir, damage, `its copy ${copy} can't be used either`);
  }
}

function openChecked(dataDir: string, read: (db: Database) => void): Database {
  const path = pathOf(dataDir);
  // A killed server leaves SQLite's lock behind. The lock of the data folder already ensures that no other
  // server runs.
  rmSync(`${path}.lock`, { recursive: true, force: true });
  const db = new sqlite.Database(path);
  try {
    // With exclusive locking WAL needs no shared memory, which this build of SQLite does not have.
    db.exec("PRAGMA locking_mode = EXCLUSIVE");
    db.exec("PRAGMA journal_mode = WAL");
    db.exec("PRAGMA synchronous = FULL");
    mustBeWhole(db);
    prepareTables(db, path);
    mustBeReadable(db, read);
    return db;
  } catch (error) {
    db.close();
    throw error;
  }
}

/**
 * integrity_check also compares tables with their indexes, unlike quick_check; the database is small enough
 * for it.
 */
function mustBeWhole(db: Database): void {
  const [first] = db.all("PRAGMA integrity_check(1)");
  const result = String(first?.["integrity_check"]);
  if (result !== "ok") throw new Error(`it is damaged (${result.replaceAll(/\s+/g, " ")})`);
  if (db.get("PRAGMA foreign_key_check") !== null) {
    throw new Error("it is damaged (a row refers to a missing row)");
  }
}

function mustBeReadable(db: Database, read: (db: Database) => void): void {
  try {
    read(db);
  } catch (cause) {
    const [reason = ""] = cause instanceof Error ? cause.message.split("\n") : [];
    throw new Error(`some of its content can't be read (${reason.slice(0, 120)})`, { cause });
  }
}

/** Makes the backup. If that fails the server still starts, and the previous backup stays. */
function withCopy(dataDir: string, db: Database, repair: string | null): OpenedDatabase {
  try {
    // Move the write-ahead log into the database file, since only that file is copied.
    db.exec("PRAGMA wal_checkpoint(TRUNCATE)");
    copyWhole(pathOf(dataDir), copyOf(dataDir));
    return { db, repair, copyFault: null };
  } catch (error) {
    return { db, repair, copyFault: error instanceof Error ? error.message : String(error) };
  }
}

/** Copies a file. The copy gets its name only when it is completely on disk. */
function copyWhole(from: string, to: string): void {
  const draft = `${to}.draft`;
  try {
    copyFileSync(from, draft);
    const file = openSync(draft, "r+");
    try {
      fsyncSync(file);
    } finally {
      closeSync(file);
    }
    renameSync(draft, to);
  } catch (error) {
    rmSync(draft, { force: true });
    throw error;
  }
}

const isEmpty = (path: string): boolean => !existsSync(path) || statSync(path).size === 0;

/** Suffixes of the database and its write-ahead log, which belong together. */
const PARTS = ["", "-wal"] as const;

/** Renames the existing database and returns the new name; null when there is none or it is empty. */
function setAside(dataDir: string): string | null {
  const path = pathOf(dataDir);
  const stamp = new Date().toISOString().replaceAll(/[:.]/g, "-");
  const kept = join(dataDir, `plotwright-damaged-${stamp}.db`);
  if (PARTS.every((part) => isEmpty(path + part))) {
    removeDatabase(dataDir);
    return null;
  }
  renameAll(path, kept);
  return kept;
}

function renameAll(from: string, to: string): void {
  for (const part of PARTS) if (existsSync(from + part)) renameSync(from + part, to + part);
}

function removeDatabase(dataDir: string): void {
  for (const part of PARTS) rmSync(pathOf(dataDir) + part, { force: true });
}

function cannotOpen(dataDir: string, cause: unknown): PlotwrightError {
  return new PlotwrightError(
    "bad-setting",
    `The database ${pathOf(dataDir)} can't be opened (${(cause as Error).message}). Check the disk and the permissions of that folder, or choose another folder with --data.`,
    { cause },
  );
}

function cannotRepair(dataDir: string, damage: Error, why: string): PlotwrightError {
  return new PlotwrightError(
    "bad-setting",
    `The database ${pathOf(dataDir)} can't be opened (${damage.message}), and ${why}. Nothing was changed: your drawings are in ${join(dataDir, "drawings")}. Replace the database with a good copy; or move it and ${copyOf(dataDir)} elsewhere to start with an empty queue, and add the drawings again; or choose another folder with --data.`,
    { cause: damage },
  );
}
