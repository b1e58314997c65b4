/**
 * The database schema, one migration per version; `PRAGMA user_version` is the number of migrations applied.
 */
import type { Database } from "node-sqlite3-wasm";
import { PlotwrightError } from "../../src/index.js";

const MIGRATIONS: readonly string[] = [
  `CREATE TABLE drawings (
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
     created_at TEXT NOT NULL,
     started_at TEXT,
     ended_at   TEXT
   );
   CREATE INDEX jobs_by_state ON jobs (state, position);
   CREATE TABLE settings (
     key        TEXT PRIMARY KEY,
     value      TEXT NOT NULL         -- JSON
   );`,
  `ALTER TABLE jobs ADD COLUMN place TEXT;                          -- JSON
   ALTER TABLE jobs ADD COLUMN speed_pct REAL NOT NULL DEFAULT 100;
   CREATE TABLE journal (
     job_id     TEXT PRIMARY KEY REFERENCES jobs (id) ON DELETE CASCADE,
     entry      TEXT NOT NULL         -- JSON: how far the pen has got
   );`,
  `ALTER TABLE jobs ADD COLUMN plotted_s REAL;`,
  `ALTER TABLE jobs ADD COLUMN expected_s REAL;
   ALTER TABLE jobs ADD COLUMN wait TEXT;                           -- JSON
   CREATE TABLE plotters (
     id         TEXT PRIMARY KEY,
     position   INTEGER NOT NULL,
     name       TEXT,                 -- null: the name is derived from the device
     device     TEXT NOT NULL,
     machine    TEXT
   );`,
  `INSERT OR IGNORE INTO settings (key, value) SELECT 'queue:main', value FROM settings WHERE key = 'queue';
   DELETE FROM settings WHERE key = 'queue';
   CREATE TABLE webhooks (
     id         TEXT PRIMARY KEY,
     name       TEXT NOT NULL,
     url        TEXT NOT NULL,
     events     TEXT NOT NULL,        -- JSON
     secret     TEXT NOT NULL,
     created_at TEXT NOT NULL,
     last       TEXT                  -- JSON
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
   );`,
  `CREATE TABLE shared (               -- jobs taken from the shared queue
     id         TEXT PRIMARY KEY
   );`,
  `-- job_id: null in rows older than this column. is_told: the other servers know that it has begun.
   ALTER TABLE shared ADD COLUMN job_id TEXT;
   ALTER TABLE shared ADD COLUMN is_told INTEGER NOT NULL DEFAULT 0;`,
  `ALTER TABLE plotters ADD COLUMN settings TEXT;                   -- JSON, as plotterSettingsSchema; null: nothing set`,
];

/** Brings the database to the newest version, or refuses one that is newer than this program. */
export function migrate(db: Database, path: string): void {
  const version = Number(db.get("PRAGMA user_version")?.["user_version"] ?? 0);
  if (version > MIGRATIONS.length) {
    throw new PlotwrightError(
      "bad-setting",
      `The database ${path} was made by a newer plotwright (version ${version}; this one supports up to ${MIGRATIONS.length}). Update plotwright, or choose another folder with --data.`,
    );
  }
  for (let step = version; step < MIGRATIONS.length; step++) {
    db.exec(`BEGIN IMMEDIATE; ${MIGRATIONS[step]}\nPRAGMA user_version = ${step + 1}; COMMIT;`);
  }
}
