/** A sample through the whole server on a virtual Grbl: its machine is a stored profile. */
import { readFileSync } from "node:fs";
import { join } from "node:path";
import { afterEach, beforeEach, expect, it } from "vitest";
import { createServer, type PlotwrightServer } from "../../../server/index.js";
import {
  DEFAULT_PLOT_SETTINGS,
  jobSchema,
  snapshotSchema,
  type Job,
  type Snapshot,
} from "../../../src/schema/index.js";
import { GRBL } from "../../support/machines/machine.js";
import { folderOfTest } from "../../support/processes/folders.js";

const SAMPLE = readFileSync(join(import.meta.dirname, "../../../samples/whirling-triangles.svg"), "utf8");
const SETTINGS = { ...DEFAULT_PLOT_SETTINGS, machine: GRBL.id };

let dataDir: string;
let server: PlotwrightServer;
beforeEach(async () => {
  dataDir = folderOfTest();
  server = await createServer({ port: 0, device: "virtual", virtualSpeed: 150, dataDir });
});
afterEach(async () => {
  await server.close();
});

const call = (method: string, path: string, body?: unknown): Promise<Response> =>
  fetch(`${server.url}/api/v1${path}`, {
    method,
    ...(body === undefined
      ? {}
      : { body: JSON.stringify(body), headers: { "content-type": "application/json" } }),
  });
const state = async (): Promise<Snapshot> => snapshotSchema.parse(await (await call("GET", "/state")).json());
const plotter = async () => (await state()).plotters[0];
const stateOf = async (id: string): Promise<string | undefined> =>
  (await state()).jobs.find((job) => job.id === id)?.state;
const until = (id: string, wanted: string) =>
  expect.poll(() => stateOf(id), { timeout: 60_000, interval: 30 }).toBe(wanted);

async function add(): Promise<Job> {
  const settings = encodeURIComponent(JSON.stringify(SETTINGS));
  const response = await fetch(`${server.url}/api/v1/jobs?name=whirling-triangles.svg&settings=${settings}`, {
    method: "POST",
    body: SAMPLE,
  });
  expect(response.status).toBe(201);
  return jobSchema.parse(await response.json());
}

it(
  "the server queues, plots, pauses, resumes and cancels on a virtual Grbl",
  { timeout: 120_000 },
  async () => {
    expect((await call("PUT", `/machines/${GRBL.id}`, GRBL)).status).toBe(200);
    expect((await call("PATCH", "/plotters/main", { machine: GRBL.id })).status).toBe(200);
    await expect.poll(plotter).toMatchObject({ connection: "idle", firmware: "Grbl 1.1h" });

    const { id, stats, warnings } = await add();
    expect(stats?.durationS).toBeGreaterThan(20);
    expect(warnings).toEqual([]);
    expect((await call("POST", `/jobs/${id}/start`)).status).toBe(200);
    await expect
      .poll(async () => (await state()).jobs[0]?.progress, { timeout: 30_000, interval: 20 })
      .toBeGreaterThan(0.1);
    expect((await call("POST", `/jobs/${id}/pause`)).status).toBe(200);
    await until(id, "paused");
    await expect.poll(async () => (await plotter()).penUp).toBe(true);
    expect((await call("POST", `/jobs/${id}/resume`)).status).toBe(200);
    await until(id, "done");
    expect(await plotter()).toMatchObject({ connection: "idle", penUp: true, xMm: 0, yMm: 0 });

    const second = await add();
    expect((await call("POST", `/jobs/${second.id}/start`)).status).toBe(200);
    await until(second.id, "plotting");
    expect((await call("POST", `/jobs/${second.id}/cancel`)).status).toBe(200);
    await until(second.id, "cancelled");
    await expect.poll(plotter).toMatchObject({ connection: "idle", penUp: true, xMm: 0, yMm: 0 });
  },
);
