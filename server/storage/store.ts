/**
 * Jobs, their order, history and settings in one SQLite database. Every method that changes something
 * returns only after the change is on disk (WAL with synchronous=FULL), so callers can then announce it.
 */
import type { Database } from "node-sqlite3-wasm";
import { ENDED_STATES, jobSchema, type Job } from "../../src/schema/index.js";
import { PlotwrightError } from "../../src/index.js";
import { lockDataDir } from "./data-lock.js";
import { openDatabase, type OpenedDatabase } from "./open-database.js";
import type { JobStore, PlotterRow, PlotterStore, StoredDrawing, WatchedFile } from "../../host/storage.js";

export type { PlotterRow, WatchedFile } from "../../host/storage.js";

type Row = Record<string, number | bigint | string | Uint8Array | null>;
type Value = number | string | null;

const COLUMNS =
  "id, plotter_id, state, name, settings, stats, warnings, progress, elapsed_s, remaining_s, message, place, speed_pct, plotted_s, expected_s, wait, stopped, submitted_by, created_at, started_at, ended_at";
const PLACES = COLUMNS.split(", ")
  .map(() => "?")
  .join(", ");
const ENDED = ENDED_STATES.map((state) => `'${state}'`).join(", ");

export class Store implements JobStore, PlotterStore {
  /** What was repaired when the database was opened, and why it could not be backed up. */
  readonly opened: Pick<OpenedDatabase, "repair" | "copyFault">;
  private readonly db: Database;

  private constructor(
    { db, ...opened }: OpenedDatabase,
    private readonly unlock: () => void,
  ) {
    this.opened = opened;
    this.db = db;
  }

  /** Throws `conflict` when another server uses the folder, `bad-setting` when the database can't be used. */
  static open(dataDir: string): Store {
    const unlock = lockDataDir(dataDir);
    try {
      return new Store(openDatabase(dataDir, readAll), unlock);
    } catch (error) {
      unlock();
      throw error;
    }
  }

  /** Queue order first, then history, newest first. */
  jobs(): Job[] {
    const queued = this.all(`SELECT ${COLUMNS} FROM jobs WHERE state NOT IN (${ENDED}) ORDER BY position`);
    const ended = this.all(
      `SELECT ${COLUMNS} FROM jobs WHERE state IN (${ENDED}) ORDER BY ended_at DESC, position DESC`,
    );
    return [...queued, ...ended].map(jobFromRow);
  }

  /** Ids in the order of jobs(). */
  order(): string[] {
    const queued = this.all(`SELECT id FROM jobs WHERE state NOT IN (${ENDED}) ORDER BY position`);
    const ended = this.all(
      `SELECT id FROM jobs WHERE state IN (${ENDED}) ORDER BY ended_at DESC, position DESC`,
    );
    return [...queued, ...ended].map((row) => String(row["id"]));
  }

  /** The job's drawing as stored by DrawingFiles; throws `not-found`. */
  drawingOf(id: string): string {
    const row = this.db.get("SELECT drawing FROM jobs WHERE id = ?", [id]);
    if (row === null) throw new PlotwrightError("not-found", `There is no job ${id}.`);
    return String((row as Row)["drawing"]);
  }

  isUsed(drawing: string): boolean {
    return this.db.get("SELECT 1 FROM jobs WHERE drawing = ? LIMIT 1", [drawing]) !== null;
  }

  /** For plug-ins with their own tables. */
  get database(): Database {
    return this.db;
  }

  /** Stores everything `work` writes, or nothing. A nested call joins the outer transaction. */
  transaction(work: () => void): void {
    this.inOneTransaction(work);
  }

  /** Whether a file of the watched folder has been handled. */
  isSeen({ name, sha256 }: WatchedFile): boolean {
    return this.db.get("SELECT 1 FROM watched WHERE name = ? AND sha256 = ?", [name, sha256]) !== null;
  }

  saveSeen({ name, sha256 }: WatchedFile): void {
    this.run("INSERT OR IGNORE INTO watched (name, sha256) VALUES (?, ?)", [name, sha256]);
  }

  /** Whether this server has added this job of the shared queue to its own queue. */
  isShared(id: string): boolean {
    return this.db.get("SELECT 1 FROM shared WHERE id = ?", [id]) !== null;
  }

  saveShared(id: string, jobId: string): void {
    this.run("INSERT INTO shared (id, job_id) VALUES (?, ?)", [id, jobId]);
  }

  /** Jobs taken from the shared queue whose start has not been reported to the other servers. */
  unreportedShared(): { readonly id: string; readonly jobId: string }[] {
    return this.all("SELECT id, job_id FROM shared WHERE is_told = 0").map((row) => ({
      id: String(row["id"]),
      jobId: String(row["job_id"]),
    }));
  }

  saveReported(id: string): void {
    this.run("UPDATE shared SET is_told = 1 WHERE id = ?", [id]);
  }

  /** The job was given back to the shared queue, and may be taken again. */
  forgetShared(id: string): void {
    this.run("DELETE FROM shared WHERE id = ?", [id]);
  }

  /** Adds a job before another job of the queue, or last. */
  addJob(job: Job, drawing: StoredDrawing, beforeId: string | null = null): void {
    this.inOneTransaction(() => {
      this.run("INSERT OR IGNORE INTO drawings (id, bytes) VALUES (?, ?)", [drawing.id, drawing.bytes]);
      this.run(
        `INSERT INTO jobs (position, drawing, ${COLUMNS})
         VALUES ((SELECT COALESCE(MAX(position), 0) + 1 FROM jobs), ?, ${PLACES})`,
        [drawing.id, ...rowFromJob(job)],
      );
      if (beforeId !== null) this.place(job.id, beforeId);
    });
  }

  saveJob(job: Job): void {
    this.run(`UPDATE jobs SET (${COLUMNS}) = (${PLACES}) WHERE id = ?`, [...rowFromJob(job), job.id]);
  }

  /**
   * Sets the expected time of a plotter's queued jobs to planned time × `ratio`. Returns the changed times by
   * job id.
   */
  saveExpected(plotterId: string, ratio: number): Record<string, number> {
    const changed = this.all(
      `UPDATE jobs SET expected_s = json_extract(stats, '$.durationS') * ?1
       WHERE plotter_id = ?2 AND state = 'queued' AND stats IS NOT NULL
         AND expected_s IS NOT json_extract(stats, '$.durationS') * ?1
       RETURNING id, expected_s`,
      [ratio, plotterId],
    );
    return Object.fromEntries(changed.map((row) => [String(row["id"]), Number(row["expected_s"])]));
  }

  /** Moves a job before another job of the queue; null: to the end. */
  moveJob(id: string, beforeId: string | null): void {
    this.inOneTransaction(() => this.place(id, beforeId));
  }

  private place(id: string, beforeId: string | null): void {
    const [target] =
      beforeId === null
        ? this.all("SELECT COALESCE(MAX(position), 0) + 1 AS position FROM jobs")
        : this.all(`SELECT position FROM jobs WHERE id = ? AND id <> ? AND state NOT IN (${ENDED})`, [
            beforeId,
            id,
          ]);
    if (target === undefined)
      throw new PlotwrightError("not-found", `There is no job ${beforeId} in the queue.`);
    const position = Number(target["position"]);
    this.run("UPDATE jobs SET position = position + 1 WHERE position >= ?", [position]);
    this.run("UPDATE jobs SET position = ? WHERE id = ?", [position, id]);
  }

  /** Empty on the first start. */
  plotters(): PlotterRow[] {
    return this.all("SELECT id, name, device, machine FROM plotters ORDER BY position").map((row) => ({
      id: String(row["id"]),
      name: textOrNull(row["name"]),
      device: String(row["device"]),
      machine: textOrNull(row["machine"]),
    }));
  }

  /** Adds a new plotter last, or updates a stored one. */
  savePlotter({ id, name, device, machine }: PlotterRow): void {
    this.run(
      `INSERT INTO plotters (id, position, name, device, machine)
       VALUES (?, (SELECT COALESCE(MAX(position), 0) + 1 FROM plotters), ?, ?, ?)
       ON CONFLICT (id) DO UPDATE SET name = excluded.name, device = excluded.device, machine = excluded.machine`,
      [id, name, device, machine],
    );
  }

  /** The stored settings of each plotter, by its id; parse them with their schema. */
  plotterSettings(): Record<string, unknown> {
    const rows = this.all("SELECT id, settings FROM plotters WHERE settings IS NOT NULL");
    return Object.fromEntries(rows.map((row) => [String(row["id"]), JSON.parse(String(row["settings"]))]));
  }

  savePlotterSettings(id: string, settings: unknown): void {
    this.run("UPDATE plotters SET settings = ? WHERE id = ?", [JSON.stringify(settings), id]);
  }

  removePlotter(id: string): void {
    this.run("DELETE FROM plotters WHERE id = ?", [id]);
  }

  /** Removes the job; returns its drawing's id if no other job uses it, else null. */
  removeJob(id: string): string | null {
    const drawing = this.drawingOf(id);
    this.inOneTransaction(() => {
      this.run("DELETE FROM jobs WHERE id = ?", [id]);
      if (!this.isUsed(drawing)) this.run("DELETE FROM drawings WHERE id = ?", [drawing]);
    });
    return this.isUsed(drawing) ? null : drawing;
  }

  /**
   * Stores the progress of a plot. It survives a kill of the process but not a power cut: that would need two disk
   * flushes per second, and the stream to the board would have to wait for them.
   */
  saveJournal(id: string, entry: unknown): void {
    this.db.exec("PRAGMA synchronous = NORMAL");
    try {
      this.run(
        "INSERT INTO journal (job_id, entry) VALUES (?, ?) ON CONFLICT (job_id) DO UPDATE SET entry = excluded.entry",
        [id, JSON.stringify(entry)],
      );
    } finally {
      this.db.exec("PRAGMA synchronous = FULL");
    }
  }

  journal(id: string): unknown {
    const row = this.db.get("SELECT entry FROM journal WHERE job_id = ?", [id]) as Row | null;
    return row === null ? undefined : (JSON.parse(String(row["entry"])) as unknown);
  }

  clearJournal(id: string): void {
    this.run("DELETE FROM journal WHERE job_id = ?", [id]);
  }

  /** A JSON value stored under a name, or undefined; parse it with its schema. */
  setting(key: string): unknown {
    const row = this.db.get("SELECT value FROM settings WHERE key = ?", [key]) as Row | null;
    return row === null ? undefined : (JSON.parse(String(row["value"])) as unknown);
  }

  saveSetting(key: string, value: unknown): void {
    this.run(
      "INSERT INTO settings (key, value) VALUES (?, ?) ON CONFLICT (key) DO UPDATE SET value = excluded.value",
      [key, JSON.stringify(value)],
    );
  }

  close(): void {
    if (!this.db.isOpen) return;
    this.db.close();
    this.unlock();
  }

  private all(sql: string, values: Value[] = []): Row[] {
    return this.db.all(sql, values) as Row[];
  }

  private run(sql: string, values: Value[]): void {
    this.db.run(sql, values);
  }

  private inOneTransaction(work: () => void): void {
    if (this.db.inTransaction) {
      work();
      return;
    }
    this.db.exec("BEGIN IMMEDIATE");
    try {
      work();
      this.db.exec("COMMIT");
    } catch (error) {
      if (this.db.inTransaction) this.db.exec("ROLLBACK");
      throw error;
    }
  }
}

/** Throws if the database contains anything that the server could not read. */
function readAll(db: Database): void {
  (db.all(`SELECT ${COLUMNS} FROM jobs`) as Row[]).forEach(jobFromRow);
  db.all("SELECT id, name, device, machine FROM plotters");
  const texts = db.all(
    `SELECT value FROM settings UNION ALL SELECT entry FROM journal
     UNION ALL SELECT settings FROM plotters WHERE settings IS NOT NULL
     UNION ALL SELECT events FROM webhooks UNION ALL SELECT last FROM webhooks WHERE last IS NOT NULL
     UNION ALL SELECT progress FROM webhooks WHERE progress IS NOT NULL`,
  );
  for (const { value } of texts) JSON.parse(String(value));
}

const textOrNull = (value: Row[string] | undefined): string | null =>
  typeof value === "string" ? value : null;

function rowFromJob(job: Job): Value[] {
  return [
    job.id,
    job.plotterId,
    job.state,
    job.name,
    JSON.stringify(job.settings),
    job.stats === null ? null : JSON.stringify(job.stats),
    JSON.stringify(job.warnings),
    job.progress,
    job.elapsedS,
    job.remainingS,
    job.message,
    job.place === null ? null : JSON.stringify(job.place),
    job.speedPct,
    job.plottedS,
    job.expectedS,
    job.wait === null ? null : JSON.stringify(job.wait),
    job.stopped ? 1 : 0,
    job.submittedBy === undefined ? null : JSON.stringify(job.submittedBy),
    job.createdAt,
    job.startedAt,
    job.endedAt,
  ];
}

/** Throws if the row is damaged. */
function jobFromRow(row: Row): Job {
  return jobSchema.parse({
    id: row["id"],
    plotterId: row["plotter_id"],
    state: row["state"],
    name: row["name"],
    settings: JSON.parse(String(row["settings"])) as unknown,
    stats: row["stats"] === null ? null : (JSON.parse(String(row["stats"])) as unknown),
    warnings: JSON.parse(String(row["warnings"])) as unknown,
    progress: row["progress"],
    elapsedS: row["elapsed_s"],
    remainingS: row["remaining_s"],
    message: row["message"],
    place: row["place"] === null ? null : (JSON.parse(String(row["place"])) as unknown),
    speedPct: row["speed_pct"],
    plottedS: row["plotted_s"],
    expectedS: row["expected_s"],
    wait: row["wait"] === null ? null : (JSON.parse(String(row["wait"])) as unknown),
    stopped: row["stopped"] === 1,
    ...(row["submitted_by"] === null
      ? {}
      : { submittedBy: JSON.parse(String(row["submitted_by"])) as unknown }),
    createdAt: row["created_at"],
    startedAt: row["started_at"],
    endedAt: row["ended_at"],
  });
}
