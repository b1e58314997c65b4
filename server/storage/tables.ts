/** The tables of the database. `PRAGMA user_version` is the version of their form. */
import type { Database } from "node-sqlite3-wasm";
import { PlotwrightError } from "../../src/index.js";

const VERSION = 11;

const TABLES = `
  CREATE TABLE drawings (
    id         TEXT PRIMARY KEY,
    bytes      INTEGER NOT NULL
  );
  CREATE TABLE jobs (
    id         TEXT PRIMARY KEY,
    plotter_id TEXT NOT NULL,
    position   INTEGER NOT NULL,     -- order of jobs that have not ended; meaningless for history
    state      TEXT NOT NULL,
    drawing    TEXT NOT NULL REFERENCES drawings (id),
    name       TEXT NOT NULL,
    settings   TEXT NOT NULL,        -- JSON, as src/schema
    stats      TEXT,                 -- JSON
    warnings   TEXT NOT NULL,        -- JSON
    progress   REAL NOT NULL,
    elapsed_s  REAL NOT NULL,
    remaining_s REAL,
    message    TEXT,
    place      TEXT,                 -- JSON
    speed_pct  REAL NOT NULL DEFAULT 100,
    plotted_s  REAL,
    expected_s REAL,
    wait       TEXT,                 -- JSON
    stopped    INTEGER NOT NULL DEFAULT 0, -- 1: held by an emergency stop
    submitted_by TEXT,               -- JSON; null: an operator added it
    created_at TEXT NOT NULL,
    started_at TEXT,
    ended_at   TEXT
  );
  CREATE INDEX jobs_by_state ON jobs (state, position);
  CREATE TABLE journal (
    job_id     TEXT PRIMARY KEY REFERENCES jobs (id) ON DELETE CASCADE,
    entry      TEXT NOT NULL         -- JSON: how far the pen has got
  );
  CREATE TABLE settings (
    key        TEXT PRIMARY KEY,
    value      TEXT NOT NULL         -- JSON
  );
  CREATE TABLE plotters (
    id         TEXT PRIMARY KEY,
    position   INTEGER NOT NULL,
    name       TEXT,                 -- null: the name is derived from the device
    device     TEXT NOT NULL,
    machine    TEXT,
    settings   TEXT                  -- JSON, as plotterSettingsSchema; null: nothing set
  );
  CREATE TABLE webhooks (
    id         TEXT PRIMARY KEY,
    name       TEXT NOT NULL,
    url        TEXT NOT NULL,
    events     TEXT NOT NULL,        -- JSON
    secret     TEXT NOT NULL,
    created_at TEXT NOT NULL,
    last       TEXT,                 -- JSON
    progress   TEXT                  -- JSON; null: the defaults
  );
  CREATE TABLE deliveries (
    id         TEXT PRIMARY KEY,
    webhook_id TEXT NOT NULL REFERENCES webhooks (id) ON DELETE CASCADE,
    event      TEXT NOT NULL,
    body       TEXT NOT NULL,
    try_count  INTEGER NOT NULL,
    next_at_ms INTEGER NOT NULL
  );
  CREATE TABLE watched (             -- files of the watched folder that have been handled
    name       TEXT NOT NULL,
    sha256     TEXT NOT NULL,
    PRIMARY KEY (name, sha256)
  );
  CREATE TABLE shared (              -- jobs taken from the shared queue
    id         TEXT PRIMARY KEY,
    job_id     TEXT NOT NULL,
    is_told    INTEGER NOT NULL DEFAULT 0 -- the other servers know that it has begun
  );`;

/** Makes the tables of a new database. One of another version is refused, and stays as it is. */
export function prepareTables(db: Database, path: string): void {
  const version = Number(db.get("PRAGMA user_version")?.["user_version"] ?? 0);
  if (version === VERSION) return;
  if (version === 0) {
    db.exec(`BEGIN IMMEDIATE; ${TABLES}\nPRAGMA user_version = ${VERSION}; COMMIT;`);
    return;
  }
  const advice = version > VERSION ? "Update plotwright" : "Use the plotwright that made it";
  throw new PlotwrightError(
    "bad-setting",
    `The database ${path} was made by ${version > VERSION ? "a newer" : "an older"} plotwright (version ${version}; this one needs ${VERSION}). ${advice}, or choose another folder with --data.`,
  );
}
