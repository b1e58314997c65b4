/**
 * Two servers that share jobs through a PostgreSQL database (PGlite: PostgreSQL in this process, behind a socket),
 * each with a virtual plotter; one is killed during a job.
 */
import { once } from "node:events";
import { afterAll, beforeAll, describe, expect, it } from "vitest";
import type { Job, SharedJob, SharedTarget } from "../../../../src/schema/index.js";
import { countFor } from "../../../support/runs/full-run.js";
import { temporaryFolder } from "../../../support/processes/folders.js";
import { startServerProcess, type ServerProcess } from "../../../support/processes/server-process.js";
import {
  MACHINE,
  SharedDatabase,
  introduce,
  linesSvg,
  send,
  share,
  sharedJobsOf,
  stateOf,
  type AtUrl,
} from "../../../support/servers/shared-servers.js";

const JOB_COUNT = countFor("PLOTWRIGHT_SHARED_JOBS", 40, 6);
/** For the whole test; each of its three waits has a third of it. */
const LIMIT_MS = 30_000 * JOB_COUNT;
const LINES = 8;
/** The second job of the left server: long enough that the kill meets it in the middle. */
const LONG_INDEX = 4;
const MANY_LINES = 120;

const jobsOf = async (server: AtUrl): Promise<Job[]> => (await stateOf(server)).jobs;
const countOf = (jobs: readonly Job[], ...states: Job["state"][]): number =>
  jobs.filter(({ state }) => states.includes(state)).length;

/** The operator's part: resumes what a busy computer or a kill has interrupted, and starts what waits. */
async function goOn(server: AtUrl): Promise<void> {
  const action: Partial<Record<Job["state"], string>> = {
    failed: "requeue",
    interrupted: "recover",
    paused: "resume",
    queued: "start",
  };
  for (const { id, state } of await jobsOf(server)) {
    const name = action[state];
    if (name !== undefined) await send(server.url, "POST", `/jobs/${id}/${name}`);
  }
}

describe("two servers that share a queue", { timeout: LIMIT_MS }, () => {
  const folders = [temporaryFolder("shared-left"), temporaryFolder("shared-right")] as const;
  let database: SharedDatabase;
  const servers: ServerProcess[] = [];

  const start = (side: 0 | 1): Promise<ServerProcess> =>
    startServerProcess({
      dataDir: folders[side].path,
      virtualSpeed: 40,
      args: ["--shared-queue", database.url],
    });
  beforeAll(async () => {
    database = await SharedDatabase.open();
    for (const side of [0, 1] as const) {
      const server = await start(side);
      servers.push(server);
      await introduce(server, side === 0 ? "Left" : "Right", MACHINE);
      await send(server.url, "PATCH", "/queue", { runOn: true });
    }
  });
  afterAll(async () => {
    for (const server of servers) await server.stop();
    await database.close();
    for (const folder of folders) folder.remove();
  });

  it(`plots each of ${JOB_COUNT} jobs once on its plotter, though one server is killed during a job`, async () => {
    const [left, right] = servers as [ServerProcess, ServerProcess];
    const names: string[] = [];
    for (let index = 0; index < JOB_COUNT; index++) {
      const target: SharedTarget =
        index % 4 === 0 ? { plotter: "Left" } : index % 4 === 1 ? { plotter: "right" } : { machine: MACHINE };
      const name = `${index} ${Object.values(target).join("")}`;
      names.push(name);
      const drawing = linesSvg(index === LONG_INDEX ? MANY_LINES : LINES);
      await share(index % 2 === 0 ? left : right, name, target, drawing);
    }

    await expect
      .poll(
        async () => {
          for (const server of [left, right]) await goOn(server);
          const jobs = await jobsOf(left);
          const long = jobs.find(({ name }) => name === names[LONG_INDEX]);
          return countOf(jobs, "done") >= 1 && long?.state === "plotting";
        },
        { timeout: LIMIT_MS / 3 },
      )
      .toBe(true);
    const gone = once(left.process, "exit");
    left.process.kill("SIGKILL");
    await gone;
    // The other one continues, with everything that is not for the missing one.
    await expect
      .poll(
        async () => {
          await goOn(right);
          const isForRight = ({ state, target }: SharedJob): boolean =>
            state === "waiting" && target !== "plotter left";
          return (await sharedJobsOf(right)).filter(isForRight).length;
        },
        { timeout: LIMIT_MS / 3 },
      )
      .toBe(0);

    const again = await start(0);
    servers[0] = again;
    await expect
      .poll(
        async () => {
          for (const server of [again, right]) await goOn(server);
          return countOf([...(await jobsOf(again)), ...(await jobsOf(right))], "done");
        },
        { timeout: LIMIT_MS / 3 },
      )
      .toBe(JOB_COUNT);

    const [onLeft, onRight] = [await jobsOf(again), await jobsOf(right)];
    expect([...onLeft, ...onRight].map(({ name }) => name).sort()).toEqual([...names].sort());
    expect(onLeft.filter(({ name }) => name.endsWith("right"))).toEqual([]);
    expect(onRight.filter(({ name }) => name.endsWith("Left"))).toEqual([]);
    // A job may be plotted before its server has recorded its claim in the database.
    await expect
      .poll(async () => (await sharedJobsOf(right)).map(({ state }) => state))
      .toEqual(Array(JOB_COUNT).fill("stored"));
  });
});
