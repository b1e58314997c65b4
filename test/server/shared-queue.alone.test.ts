/**
 * Two servers that share jobs by a PostgreSQL database (PGlite: PostgreSQL in this process, behind a socket), each
 * with a virtual plotter; one is killed in mid-job.
 */
import { once } from "node:events";
import { PGlite } from "@electric-sql/pglite";
import { PGLiteSocketServer } from "@electric-sql/pglite-socket";
import { afterAll, beforeAll, describe, expect, it } from "vitest";
import {
  DEFAULT_PLOT_SETTINGS,
  sharedJobSchema,
  snapshotSchema,
  type Job,
  type SharedJob,
  type SharedTarget,
} from "../../src/schema/index.js";
import { startServerProcess, temporaryFolder, type ServerProcess } from "../support/server-process.js";

/** PLOTWRIGHT_SHARED_JOBS=40 for the long run. */
const JOB_COUNT = Number(process.env["PLOTWRIGHT_SHARED_JOBS"] ?? 12);
const svg = (count: number): string =>
  `<svg xmlns="http://www.w3.org/2000/svg" width="60mm" height="60mm" viewBox="0 0 60 60" stroke="black">${Array.from(
    { length: count },
    (_, i) => `<path d="M5 ${2 + i / 4}h50"/>`,
  ).join("")}</svg>`;

const json = (method: string, body: unknown): RequestInit => ({
  method,
  body: JSON.stringify(body),
  headers: { "Content-Type": "application/json" },
});
const jobsOf = async (url: string): Promise<Job[]> =>
  snapshotSchema.parse(await (await fetch(`${url}/api/v1/state`)).json()).jobs;
const countOf = (jobs: readonly Job[], ...states: Job["state"][]): number =>
  jobs.filter(({ state }) => states.includes(state)).length;

/** What their operator does: takes up what a busy computer or a kill has interrupted, and begins what waits. */
async function goOn(url: string): Promise<void> {
  const action: Partial<Record<Job["state"], string>> = {
    failed: "requeue",
    interrupted: "recover",
    paused: "resume",
    queued: "start",
  };
  for (const { id, state } of await jobsOf(url)) {
    const name = action[state];
    if (name !== undefined) await fetch(`${url}/api/v1/jobs/${id}/${name}`, { method: "POST" });
  }
}

describe("two servers that share a queue", () => {
  const folders = [temporaryFolder("shared-left"), temporaryFolder("shared-right")] as const;
  let database: PGlite;
  let socket: PGLiteSocketServer;
  const servers: ServerProcess[] = [];

  const start = (side: 0 | 1): Promise<ServerProcess> =>
    startServerProcess({
      dataDir: folders[side].path,
      virtualSpeed: 20,
      args: ["--shared-queue", `postgres://postgres:postgres@${socket.getServerConn()}/postgres`],
    });
  beforeAll(async () => {
    database = await PGlite.create();
    socket = new PGLiteSocketServer({ db: database, port: 0, host: "127.0.0.1", maxConnections: 20 });
    await socket.start();
    for (const side of [0, 1] as const) {
      const server = await start(side);
      servers.push(server);
      const plotter = { name: side === 0 ? "Left" : "Right", machine: "axidraw-v3" };
      expect((await fetch(`${server.url}/api/v1/plotters/main`, json("PATCH", plotter))).status).toBe(200);
      await fetch(`${server.url}/api/v1/queue`, json("PATCH", { runOn: true }));
    }
  });
  afterAll(async () => {
    for (const server of servers) await server.stop();
    await socket.stop();
    await database.close();
    for (const folder of folders) folder.remove();
  });

  it(`plots each of ${JOB_COUNT} jobs once where it is meant to be, though one server is killed in mid-job`, async () => {
    const send = async (server: ServerProcess, name: string, target: SharedTarget): Promise<void> => {
      const body = { name, drawing: svg(8), settings: DEFAULT_PLOT_SETTINGS, target };
      expect((await fetch(`${server.url}/api/v1/shared-jobs`, json("POST", body))).status).toBe(201);
    };
    const [left, right] = servers as [ServerProcess, ServerProcess];
    const names: string[] = [];
    for (let index = 0; index < JOB_COUNT; index++) {
      const target: SharedTarget =
        index % 4 === 0
          ? { plotter: "Left" }
          : index % 4 === 1
            ? { plotter: "right" }
            : { machine: "axidraw-v3" };
      const name = `${index} ${Object.values(target).join("")}`;
      names.push(name);
      await send(index % 2 === 0 ? left : right, name, target);
    }

    await expect
      .poll(
        async () => {
          for (const { url } of [left, right]) await goOn(url);
          const jobs = await jobsOf(left.url);
          return countOf(jobs, "done") >= 1 && countOf(jobs, "plotting") === 1;
        },
        { timeout: 600_000, interval: 200 },
      )
      .toBe(true);
    const gone = once(left.process, "exit");
    left.process.kill("SIGKILL");
    await gone;
    // The other one goes on, with everything that is not meant for the one that is gone.
    const shared = async (url: string): Promise<SharedJob[]> => {
      const { jobs } = (await (await fetch(`${url}/api/v1/shared-jobs`)).json()) as { jobs: unknown[] };
      return jobs.map((job) => sharedJobSchema.parse(job));
    };
    await expect
      .poll(
        async () => {
          await goOn(right.url);
          const isForRight = ({ state, target }: SharedJob): boolean =>
            state === "waiting" && target !== "plotter left";
          return (await shared(right.url)).filter(isForRight).length;
        },
        { timeout: 600_000, interval: 200 },
      )
      .toBe(0);

    const again = await start(0);
    servers[0] = again;
    await expect
      .poll(
        async () => {
          for (const { url } of [again, right]) await goOn(url);
          return countOf([...(await jobsOf(again.url)), ...(await jobsOf(right.url))], "done");
        },
        { timeout: 600_000, interval: 200 },
      )
      .toBe(JOB_COUNT);

    const [onLeft, onRight] = [await jobsOf(again.url), await jobsOf(right.url)];
    expect([...onLeft, ...onRight].map(({ name }) => name).sort()).toEqual([...names].sort());
    expect(onLeft.filter(({ name }) => name.endsWith("right"))).toEqual([]);
    expect(onRight.filter(({ name }) => name.endsWith("Left"))).toEqual([]);
    expect((await shared(right.url)).map(({ state }) => state)).toEqual(Array(JOB_COUNT).fill("stored"));
  }, 1_800_000);
});
