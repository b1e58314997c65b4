/**
 * The shared queue in PostgreSQL. pg-boss hands each job to one server, and a separate table stores its
 * state. Both change in one transaction. So a server that is killed at any time either has taken a job, and
 * finds it again after a restart, or has not, and another server gets it.
 */
import type { Pool, PoolClient, QueryConfig } from "pg";
import type PgBoss from "pg-boss";
import { createHash, randomUUID } from "node:crypto";
import { z } from "zod";
import { PlotwrightError } from "../../../src/index.js";
import { sharedJobSchema, type SharedJob } from "../../../src/schema/index.js";

/** A shared job as a server takes it; `payload` is the JSON text of the job to create. */
export interface TakenJob {
  readonly id: string;
  /** The plotter for which it was taken. */
  readonly plotterId: string;
  readonly payload: string;
}

interface Taker {
  readonly serverId: string;
  /** Name shown to users. */
  readonly server: string;
  readonly plotterId: string;
}

const TABLES = `CREATE TABLE IF NOT EXISTS plotwright_jobs (
  id         text PRIMARY KEY,
  name       text NOT NULL,
  target     text NOT NULL,
  state      text NOT NULL DEFAULT 'waiting',
  server_id  text,
  server     text,
  plotter_id text,
  message    text,
  payload    text,
  created_at timestamptz NOT NULL DEFAULT now()
);
ALTER TABLE plotwright_jobs ADD COLUMN IF NOT EXISTS has_begun boolean NOT NULL DEFAULT false;
CREATE TABLE IF NOT EXISTS plotwright_servers (
  id         text PRIMARY KEY,
  seen_at    timestamptz NOT NULL
)`;
/** Long enough that waiting jobs are practically never deleted. */
const RETENTION_DAYS = 3_650;
const MAX_LISTED = 500;
/** How long no server takes a job that was put back, so that the server that failed does not try again at once. */
const PUT_BACK_PAUSE_S = 60;
/** Timeout of queries while a user waits for a plot to start. A broken network reports no error by itself. */
const TIMEOUT_MS = 5_000;

/**
 * SQL condition for jobs on lost servers. $1: ms without a sign of life after which a server counts as lost.
 */
const LOST = `state IN ('taken', 'stored') AND NOT has_begun AND payload IS NOT NULL AND NOT EXISTS (
  SELECT 1 FROM plotwright_servers WHERE plotwright_servers.id = job.server_id
  AND seen_at > now() - make_interval(secs => $1::double precision / 1000))`;

type Row = Record<string, unknown>;

const jobIdSchema = z.object({ id: z.string() });

export class SharedStore {
  private readonly queues = new Set<string>();

  private constructor(
    private readonly boss: PgBoss,
    private readonly pool: Pool,
    private readonly timeoutMs: number,
  ) {}

  /**
   * Imports pg and pg-boss here, so that only servers with a shared queue need them. Throws `bad-setting`.
   */
  static async open(url: string, log: (line: string) => void, timeoutMs = TIMEOUT_MS): Promise<SharedStore> {
    const failed = (cause: unknown): PlotwrightError =>
      new PlotwrightError(
        "bad-setting",
        `The shared queue's database can't be used: ${words(cause)}. Check that it runs, and its address after --shared-queue.`,
        { cause },
      );
    // pg would take any other text for the name of a database.
    if (!/^(postgres|postgresql|socket):/.test(url)) {
      throw new PlotwrightError(
        "bad-setting",
        "--shared-queue: it must be the address of a PostgreSQL database, such as postgres://user@host/plots.",
      );
    }
    let pool: Pool | null = null;
    try {
      const [{ default: pg }, { default: Boss }] = await Promise.all([import("pg"), import("pg-boss")]);
      pool = new pg.Pool({ connectionString: url, max: 3, connectionTimeoutMillis: timeoutMs });
      const logError = (error: Error): void => log(`shared queue: ${words(error)}`);
      pool.on("error", logError);
      // The pool listens for errors of idle connections only. On a busy connection the query fails, which is enough, but
      // an "error" event without a listener would end the process.
      pool.on("connect", (client) => void client.on("error", () => undefined));
      await pool.query(TABLES);
      const boss = new Boss({ db: plainDb(pool), schedule: false });
      boss.on("error", logError);
      await boss.start();
      return new SharedStore(boss, pool, timeoutMs);
    } catch (cause) {
      await pool?.end().catch(() => undefined);
      throw failed(cause);
    }
  }

  /** Returns the job's id. */
  async send(name: string, target: string, payload: string): Promise<string> {
    const id = randomUUID();
    const queue = await this.queueOf(target);
    await this.transaction(async (client) => {
      await client.query("INSERT INTO plotwright_jobs (id, name, target, payload) VALUES ($1, $2, $3, $4)", [
        id,
        name,
        target,
        payload,
      ]);
      await this.boss.send(queue, { id }, { db: plainDb(client), retentionDays: RETENTION_DAYS });
    });
    return id;
  }

  /** Takes the next job for the target, which then belongs to this server; null if there is none. */
  async take(target: string, taker: Taker): Promise<TakenJob | null> {
    const { serverId, server, plotterId } = taker;
    const queue = await this.queueOf(target);
    return this.transaction(async (client) => {
      const db = plainDb(client);
      const [next] = await this.boss.fetch<unknown>(queue, { db });
      if (next === undefined) return null;
      // What is no job's id matches no row. It is completed all the same, or it would be fetched endlessly.
      const id = jobIdSchema.safeParse(next.data).data?.id ?? null;
      const { rows } = await client.query<Row>(
        `UPDATE plotwright_jobs SET state = 'taken', server_id = $2, server = $3, plotter_id = $4
         WHERE id = $1 AND state = 'waiting' RETURNING id, plotter_id, payload`,
        [id, serverId, server, plotterId],
      );
      await this.boss.complete(queue, next.id, { server }, { db });
      return rows[0] === undefined ? null : takenFrom(rows[0]);
    });
  }

  /** Jobs taken by this server that may be missing in its own queue, because it was killed in between. */
  async unfinished(serverId: string): Promise<TakenJob[]> {
    const { rows } = await this.pool.query<Row>(
      "SELECT id, plotter_id, payload FROM plotwright_jobs WHERE server_id = $1 AND state = 'taken' ORDER BY created_at",
      [serverId],
    );
    return rows.map(takenFrom);
  }

  /**
   * Records that the job is now in the taker's queue, or was refused. The drawing is kept until the plot begins,
   * since the job may be given back.
   */
  async finish(id: string, state: "stored" | "refused", message: string | null): Promise<void> {
    await this.pool.query(
      `UPDATE plotwright_jobs SET state = $2, message = $3,
       payload = CASE WHEN $2 = 'refused' THEN NULL ELSE payload END WHERE id = $1`,
      [id, state, message],
    );
  }

  /** Marks a job as begun before it starts. False: it belongs to another server or to none. */
  async claim(id: string, serverId: string): Promise<boolean> {
    const { rowCount } = await this.pool.query({
      text: "UPDATE plotwright_jobs SET has_begun = true WHERE id = $1 AND server_id = $2",
      values: [id, serverId],
      query_timeout: this.timeoutMs,
    } as QueryConfig);
    return rowCount !== 0;
  }

  /** Undoes claim() for a job that did not start. */
  async release(id: string, serverId: string): Promise<void> {
    await this.pool.query(
      "UPDATE plotwright_jobs SET has_begun = false WHERE id = $1 AND server_id = $2 AND payload IS NOT NULL",
      [id, serverId],
    );
  }

  /**
   * Records that the plot has begun or the job was removed, so that it stays with its server. False: it now belongs
   * to another server.
   */
  async begun(id: string, serverId: string): Promise<boolean> {
    const { rowCount } = await this.pool.query(
      "UPDATE plotwright_jobs SET has_begun = true, payload = NULL WHERE id = $1 AND server_id = $2",
      [id, serverId],
    );
    return rowCount !== 0;
  }

  /** Whether the job still belongs to this server. */
  async isStill(id: string, serverId: string): Promise<boolean> {
    const { rowCount } = await this.pool.query(
      "SELECT 1 FROM plotwright_jobs WHERE id = $1 AND server_id = $2",
      [id, serverId],
    );
    return rowCount !== 0;
  }

  /** Records a sign of life of this server. */
  async seen(serverId: string): Promise<void> {
    await this.pool.query(
      `INSERT INTO plotwright_servers (id, seen_at) VALUES ($1, now())
       ON CONFLICT (id) DO UPDATE SET seen_at = now()`,
      [serverId],
    );
  }

  /** Makes a job available again. Throws `conflict` if it has begun or its server is not lost. */
  async giveBack(id: string, lostAfterMs: number): Promise<void> {
    if (await this.makeWaiting(id, LOST, lostAfterMs)) return;
    const job = (await this.list()).find((one) => one.id === id);
    throw new PlotwrightError("conflict", whyNot(job));
  }

  /** Makes a job that this server took but can't add to its queue available again, after a pause. */
  async putBack(id: string, serverId: string): Promise<void> {
    await this.makeWaiting(id, "state = 'taken' AND server_id = $1", serverId, PUT_BACK_PAUSE_S);
  }

  /** False: the job does not meet the SQL condition, in which $1 is `value`. */
  private async makeWaiting(id: string, condition: string, value: unknown, startAfter = 0): Promise<boolean> {
    const { rows } = await this.pool.query<Row>("SELECT target FROM plotwright_jobs WHERE id = $1", [id]);
    if (rows[0] === undefined) return false;
    // Before the transaction: within it, this would need a second connection from the pool and could block.
    const queue = await this.queueOf(String(rows[0]["target"]));
    return this.transaction(async (client) => {
      const { rowCount } = await client.query(
        `UPDATE plotwright_jobs job SET state = 'waiting', server_id = NULL, server = NULL, plotter_id = NULL
         WHERE ${condition} AND job.id = $2`,
        [value, id],
      );
      if (rowCount === 0) return false;
      const options = { db: plainDb(client), retentionDays: RETENTION_DAYS, startAfter };
      await this.boss.send(queue, { id }, options);
      return true;
    });
  }

  /** Jobs that lost servers took and did not begin. */
  async lost(
    lostAfterMs: number,
  ): Promise<{ readonly id: string; readonly name: string; readonly server: string }[]> {
    const { rows } = await this.pool.query<Row>(
      `SELECT id, name, server FROM plotwright_jobs job WHERE ${LOST} ORDER BY created_at LIMIT ${MAX_LISTED}`,
      [lostAfterMs],
    );
    return rows.map(({ id, name, server }) => ({
      id: String(id),
      name: String(name),
      server: String(server),
    }));
  }

  /** Withdraws a waiting job; throws `conflict` if a server has taken it. */
  async withdraw(id: string): Promise<void> {
    const { rowCount } = await this.pool.query(
      "UPDATE plotwright_jobs SET state = 'withdrawn', payload = NULL WHERE id = $1 AND state = 'waiting'",
      [id],
    );
    if (rowCount === 0) {
      throw new PlotwrightError("conflict", "A server has already taken this job, or it does not exist.");
    }
  }

  /** Newest first, without those that this version doesn't understand. */
  async list(): Promise<SharedJob[]> {
    const { rows } = await this.pool.query<Row>(
      `SELECT job.id, name, target, state, server, message, has_begun, seen_at, created_at
       FROM plotwright_jobs job LEFT JOIN plotwright_servers ON plotwright_servers.id = job.server_id
       ORDER BY created_at DESC LIMIT ${MAX_LISTED}`,
    );
    return rows.flatMap((row) => listed(row) ?? []);
  }

  async close(): Promise<void> {
    await this.boss.stop({ graceful: false, wait: true }).catch(() => undefined);
    await this.pool.end();
  }

  private async queueOf(target: string): Promise<string> {
    // Hashed, because names of plotters may contain characters that queue names can't.
    const queue = `plotwright_${createHash("sha256").update(target).digest("hex").slice(0, 24)}`;
    if (!this.queues.has(queue)) {
      await this.boss.createQueue(queue);
      this.queues.add(queue);
    }
    return queue;
  }

  private async transaction<T>(work: (client: PoolClient) => Promise<T>): Promise<T> {
    const client = await this.pool.connect();
    try {
      await client.query("BEGIN");
      const result = await work(client);
      await client.query("COMMIT");
      client.release();
      return result;
    } catch (error) {
      // `true` closes the connection, so that no unfinished transaction remains on it.
      client.release(true);
      throw error;
    }
  }
}

const plainDb = (on: Pool | PoolClient): PgBoss.Db => ({
  executeSql: (text, values) => on.query<Row>(text, values),
});

const takenFrom = ({ id, plotter_id: plotterId, payload }: Row): TakenJob => ({
  id: String(id),
  plotterId: String(plotterId),
  payload: String(payload),
});

function listed({
  created_at: createdAt,
  seen_at: seenAt,
  has_begun: hasBegun,
  ...row
}: Row): SharedJob | null {
  const [serverSeenAt, createdIso] = [seenAt, createdAt].map(isoOf);
  return sharedJobSchema.safeParse({ ...row, hasBegun, serverSeenAt, createdAt: createdIso }).data ?? null;
}

/** Null for no time, and for "infinity", which PostgreSQL has too. */
function isoOf(time: unknown): string | null {
  return time instanceof Date && !Number.isNaN(time.getTime()) ? time.toISOString() : null;
}

function whyNot(job: SharedJob | undefined): string {
  if (job === undefined) return "There is no such job in the shared queue.";
  const where = job.server ?? "any server";
  if (job.state !== "taken" && job.state !== "stored")
    return `"${job.name}" is ${job.state}: there is nothing to give back.`;
  if (job.hasBegun) {
    return `"${job.name}" has begun on ${where}: check the paper there, and send the drawing again if it has to be plotted again.`;
  }
  return `${where} is running and will plot "${job.name}". Remove the job there, or switch that server off first.`;
}

/** The error's message without passwords: the database address may contain one. */
function words(error: unknown): string {
  const { code, message } = error as { code?: unknown; message?: unknown };
  const text = typeof message === "string" && message !== "" ? message : String(code ?? error);
  return text.replace(/\/\/[^\s@]*@/g, "//…@");
}
