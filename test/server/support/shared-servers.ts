/** Servers that share a queue by PGlite: PostgreSQL in this process, behind a socket that can be cut. */
import { PGlite } from "@electric-sql/pglite";
import { PGLiteSocketServer } from "@electric-sql/pglite-socket";
import { createServer, type PlotwrightServer, type ServerOptions } from "../../../server/index.js";
import {
  DEFAULT_PLOT_SETTINGS,
  sharedJobSchema,
  snapshotSchema,
  type SharedJob,
  type SharedTarget,
  type Snapshot,
} from "../../../src/schema/index.js";

export const MACHINE = "axidraw-v3";
const SVG =
  '<svg xmlns="http://www.w3.org/2000/svg" width="60mm" height="60mm" viewBox="0 0 60 60" stroke="black"><path d="M5 5h50"/></svg>';

export async function send(url: string, method: string, path: string, body?: unknown): Promise<Response> {
  const json = { body: JSON.stringify(body), headers: { "Content-Type": "application/json" } };
  return fetch(`${url}/api/v1${path}`, { method, ...(body === undefined ? {} : json) });
}

export const stateOf = async ({ url }: PlotwrightServer): Promise<Snapshot> =>
  snapshotSchema.parse(await (await send(url, "GET", "/state")).json());
export const noticesOf = async (server: PlotwrightServer): Promise<string[]> =>
  (await stateOf(server)).serverNotices.map(({ message }) => message);
/** As "fern queued". */
export const jobsOf = async (server: PlotwrightServer): Promise<string[]> =>
  (await stateOf(server)).jobs.map(({ name, state }) => `${name} ${state}`);

/** The newest. */
export async function sharedOf({ url }: PlotwrightServer): Promise<SharedJob> {
  const { jobs } = (await (await send(url, "GET", "/shared-jobs")).json()) as { jobs: unknown[] };
  return sharedJobSchema.parse(jobs[0]);
}

export const share = (server: PlotwrightServer, name: string, target: SharedTarget): Promise<Response> =>
  send(server.url, "POST", "/shared-jobs", { name, drawing: SVG, settings: DEFAULT_PLOT_SETTINGS, target });

export class SharedDatabase {
  readonly #database: PGlite;
  #socket: PGLiteSocketServer;
  readonly #port: number;

  private constructor(database: PGlite, socket: PGLiteSocketServer) {
    this.#database = database;
    this.#socket = socket;
    this.#port = Number(socket.getServerConn().split(":").at(-1));
  }

  static async open(): Promise<SharedDatabase> {
    const database = await PGlite.create();
    return new SharedDatabase(database, await listen(database, 0));
  }

  get url(): string {
    return `postgres://postgres:postgres@127.0.0.1:${this.#port}/postgres`;
  }

  /** Nobody reaches it until `restore`. */
  async cut(): Promise<void> {
    await this.#socket.stop();
  }

  async restore(): Promise<void> {
    this.#socket = await listen(this.#database, this.#port);
  }

  async query(text: string): Promise<void> {
    await this.#database.query(text);
  }

  async close(): Promise<void> {
    await this.#socket.stop();
    await this.#database.close();
  }

  serve(dataDir: string, options: ServerOptions = {}): Promise<PlotwrightServer> {
    return createServer({
      port: 0,
      device: "virtual",
      virtualSpeed: 50,
      dataDir,
      sharedQueue: this.url,
      sharedPollMs: 100,
      sharedLostAfterMs: 3_000,
      ...options,
    });
  }
}

async function listen(database: PGlite, port: number): Promise<PGLiteSocketServer> {
  const socket = new PGLiteSocketServer({ db: database, port, host: "127.0.0.1", maxConnections: 20 });
  await socket.start();
  return socket;
}
