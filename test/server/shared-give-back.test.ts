/** What a server took from the shared queue and left behind: another one can have it, as long as nothing was drawn. */
import { PGlite } from "@electric-sql/pglite";
import { PGLiteSocketServer } from "@electric-sql/pglite-socket";
import { afterEach, describe, expect, it } from "vitest";
import { createServer, type PlotwrightServer } from "../../server/index.js";
import {
  DEFAULT_PLOT_SETTINGS,
  sharedJobSchema,
  snapshotSchema,
  type SharedJob,
  type Snapshot,
} from "../../src/schema/index.js";
import { temporaryFolder } from "../support/server-process.js";

const MACHINE = "axidraw-v3";
const SVG =
  '<svg xmlns="http://www.w3.org/2000/svg" width="60mm" height="60mm" viewBox="0 0 60 60" stroke="black"><path d="M5 5h50"/></svg>';

const undo: (() => unknown)[] = [];
afterEach(async () => {
  for (const step of undo.splice(0).reverse()) await step();
});

async function send(url: string, method: string, path: string, body?: unknown): Promise<Response> {
  const json = { body: JSON.stringify(body), headers: { "Content-Type": "application/json" } };
  return fetch(`${url}/api/v1${path}`, { method, ...(body === undefined ? {} : json) });
}
const stateOf = async ({ url }: PlotwrightServer): Promise<Snapshot> =>
  snapshotSchema.parse(await (await send(url, "GET", "/state")).json());
async function sharedOf({ url }: PlotwrightServer): Promise<SharedJob> {
  const { jobs } = (await (await send(url, "GET", "/shared-jobs")).json()) as { jobs: unknown[] };
  return sharedJobSchema.parse(jobs[0]);
}

describe("a job that a server has taken", () => {
  it("is given back when that server has gone and has not begun it, and comes in once", async () => {
    const database = await PGlite.create();
    undo.push(() => database.close());
    const socket = new PGLiteSocketServer({ db: database, port: 0, host: "127.0.0.1", maxConnections: 20 });
    await socket.start();
    undo.push(() => socket.stop());
    const open = async (dataDir: string, name: string): Promise<PlotwrightServer> => {
      const server = await createServer({
        port: 0,
        device: "virtual",
        virtualSpeed: 50,
        dataDir,
        sharedQueue: `postgres://postgres:postgres@${socket.getServerConn()}/postgres`,
        sharedPollMs: 100,
        sharedLostAfterMs: 3_000,
      });
      undo.push(() => server.close());
      await send(server.url, "PATCH", "/plotters/main", { name, machine: MACHINE });
      return server;
    };
    const [leftData, rightData] = [temporaryFolder("give-left"), temporaryFolder("give-right")];
    undo.push(leftData.remove, rightData.remove);

    const left = await open(leftData.path, "Left");
    const job = { name: "fern", drawing: SVG, settings: DEFAULT_PLOT_SETTINGS, target: { machine: MACHINE } };
    expect((await send(left.url, "POST", "/shared-jobs", job)).status).toBe(201);
    await expect
      .poll(() => sharedOf(left), { timeout: 30_000 })
      .toMatchObject({ state: "stored", hasBegun: false });
    const { id } = await sharedOf(left);
    const right = await open(rightData.path, "Right");
    const giveBack = (): Promise<Response> => send(right.url, "POST", `/shared-jobs/${id}/give-back`);
    const refused = await giveBack();
    expect([refused.status, await refused.text()]).toEqual([
      409,
      expect.stringContaining("was heard of just now"),
    ]);

    await left.close();
    const noticesOf = async (server: PlotwrightServer): Promise<string[]> =>
      (await stateOf(server)).serverNotices.map(({ message }) => message);
    await expect
      .poll(() => noticesOf(right), { timeout: 30_000 })
      .toEqual([expect.stringMatching(/^"fern" is with .*, which has gone/)]);
    expect((await giveBack()).status).toBe(200);
    const statesOf = async (server: PlotwrightServer): Promise<string[]> =>
      (await stateOf(server)).jobs.map(({ name, state }) => `${name} ${state}`);
    await expect.poll(() => statesOf(right), { timeout: 30_000 }).toEqual(["fern queued"]);

    const back = await open(leftData.path, "Left");
    await expect.poll(() => statesOf(back), { timeout: 30_000 }).toEqual([]);
    expect(await noticesOf(back)).toEqual(['"fern" was given to another server while this one was away.']);

    const { jobs } = await stateOf(right);
    await send(right.url, "POST", `/jobs/${jobs[0]!.id}/start`);
    await expect.poll(() => statesOf(right), { timeout: 30_000 }).toEqual(["fern done"]);
    await expect
      .poll(() => sharedOf(back), { timeout: 30_000 })
      .toMatchObject({ state: "stored", hasBegun: true });
    await right.close();
    const tooLate = await send(back.url, "POST", `/shared-jobs/${id}/give-back`);
    expect([tooLate.status, await tooLate.text()]).toEqual([409, expect.stringContaining("has begun")]);
  });
});
