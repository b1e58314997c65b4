/**
 * Opens the server's database and checks it.
 *
 * After each good check a copy is kept beside it. When the database is damaged or empty, that copy takes its place, and
 * the damaged file is kept under another name. Without a good copy the server does not start: an empty queue in place
 * of the user's jobs would be a loss that nobody is told of.
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
import { migrate } from "./migrations.js";

export interface OpenedDatabase {
  readonly db: Database;
  /** What was put right, for the user; null when nothing had to be. */
  readonly repair: string | null;
  /** Why there is no copy of the database as it is now; null when there is one. */
  readonly copyFault: string | null;
}

/** Faults of the disk or its rights: the database itself may be as it should, so it is not replaced. */
const NOT_DAMAGE = /unable to open|readonly|disk I\/O|is full|is locked/;

const pathOf = (dataDir: string): string => join(dataDir, "plotwright.db");
const copyOf = (dataDir: string): string => `${pathOf(dataDir)}.backup`;

/**
 * `read` reads whatever the server will need and throws when it can't. Throws `bad-setting` with what to do when the
 * database can't be used.
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

/** Puts the copy in place of the database. */
function restored(dataDir: string, read: (db: Database) => void, damage: Error): OpenedDatabase {
  const [path, copy] = [pathOf(dataDir), copyOf(dataDir)];
  if (!existsSync(copy)) throw cannotRepair(dataDir, damage, "there is no copy of it");
  const copiedAt = statSync(copy).mtime.toISOString();
  const kept = setAside(dataDir);
  try {
    copyWhole(copy, path);
    const db = openChecked(dataDir, read);
    const repair = `The database ${path} could not be used: ${damage.message}. The copy from ${copiedAt} has taken its place. Look through the queue before you plot: what was added or plotted after that time is not in it. Drawings of jobs that are missing are in ${join(dataDir, "unclaimed-drawings")}.`;
    return withCopy(dataDir, db, kept === null ? repair : `${repair} The damaged file is kept as ${kept}.`);
  } catch (error) {
    // As it was found: the user is to see the damaged file where it was.
    removeDatabase(dataDir);
    if (kept !== null) renameAll(kept, path);
    if (error instanceof PlotwrightError) throw error;
    throw cannotRepair(dataDir, damage, `its copy ${copy} can't be used either`);
  }
}

function openChecked(dataDir: string, read: (db: Database) => void): Database {
  const path = pathOf(dataDir);
  // A killed server leaves SQLite's lock behind; the data folder's own lock says that no other server runs.
  rmSync(`${path}.lock`, { recursive: true, force: true });
  const db = new sqlite.Database(path);
  try {
    // No other process may open it, so WAL needs no shared memory (which this build does not have).
    db.exec("PRAGMA locking_mode = EXCLUSIVE");
    db.exec("PRAGMA journal_mode = WAL");
    db.exec("PRAGMA synchronous = FULL");
    mustBeWhole(db);
    migrate(db, path);
    mustBeReadable(db, read);
    return db;
  } catch (error) {
    db.close();
    throw error;
  }
}

/** integrity_check also compares tables with their indexes, which quick_check does not; the database is small. */
function mustBeWhole(db: Database): void {
  const [first] = db.all("PRAGMA integrity_check(1)");
  const result = String(first?.["integrity_check"]);
  if (result !== "ok") throw new Error(`it is damaged (${result.replaceAll(/\s+/g, " ")})`);
  if (db.get("PRAGMA foreign_key_check") !== null) {
    throw new Error("it is damaged (a row refers to one that is not there)");
  }
}

function mustBeReadable(db: Database, read: (db: Database) => void): void {
  try {
    read(db);
  } catch (cause) {
    const [reason = ""] = cause instanceof Error ? cause.message.split("\n") : [];
    throw new Error(`it holds what can't be read (${reason.slice(0, 120)})`, { cause });
  }
}

/** Not being able to copy must not keep the server from starting: the last copy stays then. */
function withCopy(dataDir: string, db: Database, repair: string | null): OpenedDatabase {
  try {
    // All of it in the one file that is copied.
    db.exec("PRAGMA wal_checkpoint(TRUNCATE)");
    copyWhole(pathOf(dataDir), copyOf(dataDir));
    return { db, repair, copyFault: null };
  } catch (error) {
    return { db, repair, copyFault: error instanceof Error ? error.message : String(error) };
  }
}

/** On disk completely before it has its name. */
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

/** The database and its write-ahead log, which belong together. */
const PARTS = ["", "-wal"] as const;

/** Keeps what is there under another name; returns that name, or null when nothing was there. */
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
    `The database ${pathOf(dataDir)} can't be opened (${(cause as Error).message}). See to the disk and the rights to that folder, or choose another folder with --data.`,
    { cause },
  );
}

function cannotRepair(dataDir: string, damage: Error, why: string): PlotwrightError {
  return new PlotwrightError(
    "bad-setting",
    `The database ${pathOf(dataDir)} can't be opened (${damage.message}), and ${why}. Nothing was changed: your drawings are in ${join(dataDir, "drawings")}. Put a good copy of the database in its place; or move it and ${copyOf(dataDir)} elsewhere to begin with an empty queue, and add the drawings again; or choose another folder with --data.`,
    { cause: damage },
  );
}
