/** Servers that share a queue by PGlite: PostgreSQL in this process, behind a socket that can be cut. */
import { PGlite } from "@electric-sql/pglite";
import pg from "pg";
import { expect } from "vitest";
import { createServer, type PlotwrightServer, type ServerOptions } from "../../../server/index.js";
import {
  DEFAULT_PLOT_SETTINGS,
  sharedJobSchema,
  snapshotSchema,
  type SharedJob,
  type SharedTarget,
  type Snapshot,
} from "../../../src/schema/index.js";
import { PgliteServer } from "./pglite-server.js";

export const MACHINE = "axidraw-v3";
/**
 * The database answers sooner, and a heartbeat is never that old while a server runs, even on a busy
 * computer.
 */
const PATIENCE_MS = 30_000;
const LOST_AFTER_MS = 3_600_000;

/** Lines of 50 mm. */
export const linesSvg = (count: number): string =>
  `<svg xmlns="http://www.w3.org/2000/svg" width="60mm" height="60mm" viewBox="0 0 60 60" stroke="black">${Array.from(
    { length: count },
    (_, i) => `<path d="M5 ${2 + i / 4}h50"/>`,
  ).join("")}</svg>`;

/** In this process or in its own. */
export interface AtUrl {
  readonly url: string;
}

export async function send(url: string, method: string, path: string, body?: unknown): Promise<Response> {
  const json = { body: JSON.stringify(body), headers: { "Content-Type": "application/json" } };
  return fetch(`${url}/api/v1${path}`, { method, ...(body === undefined ? {} : json) });
}

export const stateOf = async ({ url }: AtUrl): Promise<Snapshot> =>
  snapshotSchema.parse(await (await send(url, "GET", "/state")).json());
export const noticesOf = async (server: AtUrl): Promise<string[]> =>
  (await stateOf(server)).serverNotices.map(({ message }) => message);
/** As "fern queued". */
export const jobsOf = async (server: AtUrl): Promise<string[]> =>
  (await stateOf(server)).jobs.map(({ name, state }) => `${name} ${state}`);

/** Newest first. */
export async function sharedJobsOf({ url }: AtUrl): Promise<SharedJob[]> {
  const { jobs } = (await (await send(url, "GET", "/shared-jobs")).json()) as { jobs: unknown[] };
  return jobs.map((job) => sharedJobSchema.parse(job));
}
export const sharedOf = async (server: AtUrl, name: string): Promise<SharedJob | undefined> =>
  (await sharedJobsOf(server)).find((job) => job.name === name);

/** Gives a server's plotter a name, and its model if given. */
export async function introduce({ url }: AtUrl, name: string, machine?: string): Promise<void> {
  const patch = { name, ...(machine === undefined ? {} : { machine }) };
  expect((await send(url, "PATCH", "/plotters/main", patch)).status).toBe(200);
}

export async function share(
  { url }: AtUrl,
  name: string,
  target: SharedTarget,
  drawing = linesSvg(1),
): Promise<void> {
  const body = { name, drawing, settings: DEFAULT_PLOT_SETTINGS, target };
  expect((await send(url, "POST", "/shared-jobs", body)).status).toBe(201);
}

/**
 * Requests the start of a job; returns "200", or the error message. A database delayed by a busy computer
 * counts as away after some seconds: a second request gets the answer.
 */
export async function startOf({ url }: AtUrl, id: string): Promise<string> {
  const answer = await send(url, "POST", `/jobs/${id}/start`);
  const text = await answer.text();
  return answer.ok ? "200" : `${answer.status} ${text}`;
}

/** Shares a job that this server claims itself, and waits until it has. Returns the shared job's id. */
export async function shareAndTake(server: AtUrl, name: string, target: SharedTarget): Promise<string> {
  await share(server, name, target);
  await expect.poll(() => sharedOf(server, name)).toMatchObject({ state: "stored", hasBegun: false });
  return (await sharedOf(server, name))!.id;
}

export class SharedDatabase {
  private readonly port: number;

  private constructor(
    private readonly database: PGlite,
    private server: PgliteServer,
  ) {
    this.port = server.port;
  }

  static async open(): Promise<SharedDatabase> {
    const database = await PGlite.create();
    return new SharedDatabase(database, await PgliteServer.listen(database, 0));
  }

  get url(): string {
    return `postgres://postgres:postgres@127.0.0.1:${this.port}/postgres`;
  }

  /** Cuts the connection to it until `restore`. */
  async cut(): Promise<void> {
    await this.server.stop();
  }

  async restore(): Promise<void> {
    this.server = await PgliteServer.listen(this.database, this.port);
  }

  /** A separate client, never in another client's transaction. */
  async query(text: string): Promise<void> {
    const client = new pg.Client({ connectionString: this.url });
    await client.connect();
    try {
      await client.query(text);
    } finally {
      await client.end();
    }
  }

  /** Makes the closed server that has this job look as if it had gone long ago. */
  async age(jobName: string): Promise<void> {
    await this.query(
      `UPDATE plotwright_servers SET seen_at = seen_at - interval '${2 * LOST_AFTER_MS} milliseconds'
       WHERE id = (SELECT server_id FROM plotwright_jobs WHERE name = '${jobName}')`,
    );
  }

  async close(): Promise<void> {
    await this.server.stop();
    await this.database.close();
  }

  serve(dataDir: string, options: ServerOptions = {}): Promise<PlotwrightServer> {
    return createServer({
      port: 0,
      device: "virtual",
      virtualSpeed: 50,
      dataDir,
      sharedQueue: this.url,
      sharedPollMs: 100,
      sharedLostAfterMs: LOST_AFTER_MS,
      sharedTimeoutMs: PATIENCE_MS,
      ...options,
    });
  }
}
