/** A shared job begins only if all servers know that it does; a plotter without a known model is asked for it. */
import { afterAll, beforeAll, describe, expect, it } from "vitest";
import type { PlotwrightServer } from "../../../../server/index.js";
import { CaughtIo, cliWith } from "../../../support/processes/command-line.js";
import { temporaryFolder } from "../../../support/processes/folders.js";
import {
  MACHINE,
  SharedDatabase,
  introduce,
  jobsOf,
  linesSvg,
  noticesOf,
  send,
  share,
  sharedJobsOf,
  sharedOf,
  startOf,
  stateOf,
} from "../../../support/servers/shared-servers.js";

const data = temporaryFolder("shared-begin");
const logged: string[] = [];
let database: SharedDatabase;
let server: PlotwrightServer;

const jobNamed = async (name: string): Promise<string> =>
  (await stateOf(server)).jobs.find((job) => job.name === name)!.id;
const start = async (name: string): Promise<string> => startOf(server, await jobNamed(name));

beforeAll(async () => {
  database = await SharedDatabase.open();
  server = await database.serve(data.path, { log: (line) => logged.push(line) });
  await introduce(server, "Left");
});
afterAll(async () => {
  await server.close();
  await database.close();
  data.remove();
});

describe("a plotter without a known model", () => {
  it("gets no jobs for any plotter of a model, says so, and gets them once its model is set", async () => {
    await expect
      .poll(() => logged)
      .toContainEqual(
        expect.stringMatching(/takes only jobs sent to .* by name, because its machine is not set/),
      );
    await share(server, "fern", { machine: MACHINE });
    await share(server, "moss", { plotter: "Left" });
    await expect.poll(() => jobsOf(server)).toEqual(["moss queued"]);
    await send(server.url, "DELETE", `/jobs/${await jobNamed("moss")}`);
    expect((await stateOf(server)).plotters[0].machine).toBe(null);
    await introduce(server, "Left", MACHINE);
    await expect.poll(() => jobsOf(server)).toEqual(["fern queued"]);
  });
});

describe("a claimed shared job that has not begun", () => {
  it("does not begin while the database can't be reached, and says why, but a copy of it does", async () => {
    await database.cut();
    expect(await start("fern")).toMatch(/^409 .*another server may have been given/);
    expect(await jobsOf(server)).toEqual(["fern queued"]);
    await send(server.url, "PATCH", `/jobs/${await jobNamed("fern")}`, { name: "fern here" });
    const copy = (await (
      await send(server.url, "POST", `/jobs/${await jobNamed("fern here")}/duplicate`)
    ).json()) as { id: string };
    await send(server.url, "PATCH", `/jobs/${copy.id}`, { name: "copy" });
    expect(await start("copy")).toBe("200");
    await expect.poll(() => jobsOf(server)).toEqual(["fern here queued", "copy done"]);
  });

  it("is skipped by a queue that runs automatically, and the next job begins", async () => {
    const duplicate = async (name: string): Promise<void> => {
      const id = await jobNamed("copy");
      const answer = await send(server.url, "POST", `/jobs/${id}/duplicate`);
      const { id: fresh } = (await answer.json()) as { id: string };
      await send(server.url, "PATCH", `/jobs/${fresh}`, { name });
    };
    await duplicate("behind");
    await duplicate("first");
    await send(server.url, "PATCH", "/queue", { runOn: true });
    expect(await start("first")).toBe("200");
    await expect
      .poll(async () => (await jobsOf(server)).slice(0, 3))
      .toEqual(["fern here queued", "behind done", "first done"]);
    const { jobs } = await stateOf(server);
    expect(jobs[0].message).toMatch(/can't be reached/);
    await send(server.url, "PATCH", "/queue", { runOn: false });
  });

  it("begins when the database is back, and is exclusive from that instant on", async () => {
    await database.restore();
    await expect.poll(() => start("fern here")).toBe("200");
    expect(await sharedOf(server, "fern")).toMatchObject({ hasBegun: true });
    await expect.poll(async () => (await jobsOf(server)).includes("fern here done")).toBe(true);
  });

  it("is removed from the queue if it belongs to another server", async () => {
    await share(server, "ivy", { plotter: "left" });
    await expect.poll(async () => (await jobsOf(server))[0]).toBe("ivy queued");
    // A running one: for one that has gone there would be a notice.
    await database.query(`INSERT INTO plotwright_servers (id, seen_at) VALUES ('other', now());
      UPDATE plotwright_jobs SET server_id = 'other' WHERE name = 'ivy'`);
    await expect.poll(() => start("ivy")).toMatch(/^409 .*was given to another server/);
    expect((await jobsOf(server)).some((job) => job.startsWith("ivy"))).toBe(false);
    expect(await noticesOf(server)).toEqual(['"ivy" was given to another server while this one was away.']);
  });

  it("begins once when two requests arrive in the same instant", async () => {
    await share(server, "oak", { plotter: "left" });
    await expect.poll(async () => (await jobsOf(server))[0]).toBe("oak queued");
    await expect.poll(() => Promise.all([start("oak"), start("oak")])).toEqual(["200", "200"]);
    await expect.poll(async () => (await jobsOf(server)).includes("oak done")).toBe(true);
  });
});

describe("a shared job that was cancelled in the middle", () => {
  it("resumes where it was cancelled while the database can't be reached, and stays with its server", async () => {
    await share(server, "elm", { plotter: "left" }, linesSvg(200));
    await expect.poll(async () => (await jobsOf(server))[0]).toBe("elm queued");
    await expect.poll(() => start("elm")).toBe("200");
    const id = await jobNamed("elm");
    const elm = async () => (await stateOf(server)).jobs.find((job) => job.id === id)!;
    await expect.poll(async () => (await elm()).progress).toBeGreaterThan(0.05);
    await send(server.url, "POST", `/jobs/${id}/cancel`);
    await expect.poll(async () => (await elm()).state).toBe("cancelled");
    const { progress, place } = await elm();
    expect(place).not.toBe(null);
    expect(await sharedOf(server, "elm")).toMatchObject({ state: "stored", hasBegun: true });
    await database.cut();
    expect((await send(server.url, "POST", `/jobs/${id}/recover`)).status).toBe(200);
    await expect.poll(async () => (await elm()).state).toBe("paused");
    expect((await elm()).progress).toBeCloseTo(progress, 2);
    expect((await send(server.url, "POST", `/jobs/${id}/resume`)).status).toBe(200);
    await expect.poll(async () => (await elm()).state).toBe("done");
    await database.restore();
    await expect.poll(() => sharedOf(server, "elm")).toMatchObject({ state: "stored", hasBegun: true });
  });
});

describe("plotwright serve --shared-queue", () => {
  it("shows the jobs of that database", { timeout: 120_000 }, async () => {
    const own = temporaryFolder("shared-serve");
    const io = new CaughtIo();
    const where = ["--port", "0", "--no-mdns", "--device", "virtual", "--data", own.path];
    const running = cliWith(io, "serve", "--shared-queue", database.url, ...where);
    try {
      await expect.poll(() => io.outText + io.errText).toMatch(/plotwright is at/);
      const url = /plotwright is at (\S+)/.exec(io.outText)?.[1] ?? "";
      await share({ url }, "sedge", { machine: "axidraw-v3-a3" });
      expect((await sharedJobsOf({ url })).map(({ name }) => name)).toContain("sedge");
    } finally {
      io.interrupt();
      await running;
      own.remove();
    }
  });
});
