/** Several plotters on one server: stored, changed while it runs, each with its queue, side by side. */
import { afterEach, beforeEach, describe, expect, it, vi } from "vitest";
import { createServer } from "../../../server/index.js";
import {
  DEFAULT_PLOT_SETTINGS,
  apiErrorSchema,
  deviceSchema,
  jobSchema,
  plotterDefaultsSchema,
  plotterSchema,
  snapshotSchema,
  withPreset,
  type Job,
  type Plotter,
  type PlotterDefaults,
  type Snapshot,
} from "../../../src/schema/index.js";
import { startApp, type TestApp } from "../../support/servers/app.js";
import { EventStream } from "../../support/servers/event-stream.js";
import { folderOfTest } from "../../support/processes/folders.js";

const SVG =
  '<svg xmlns="http://www.w3.org/2000/svg" width="50mm" height="50mm" viewBox="0 0 50 50"><path d="M5 5h30" stroke="black"/></svg>';

const LONG = SVG.replace("M5 5h30", Array.from({ length: 400 }, (_, i) => `M5 ${5 + i / 10}h40`).join(""));

async function send(url: string, method: string, path: string, body?: unknown): Promise<Response> {
  const json = { body: JSON.stringify(body), headers: { "Content-Type": "application/json" } };
  return fetch(`${url}/api/v1${path}`, { method, ...(body === undefined ? {} : json) });
}
const snapshotOf = async (url: string): Promise<Snapshot> =>
  snapshotSchema.parse(await (await send(url, "GET", "/state")).json());
const faultOf = async (response: Response): Promise<{ status: number; code: string }> => ({
  status: response.status,
  code: apiErrorSchema.parse(await response.json()).error.code,
});

describe("the plotters of a server", () => {
  let app: TestApp;
  beforeEach(async () => {
    app = await startApp({
      boards: [{ path: "/dev/ttyACM0", description: "EiBotBoard", serialNumber: "Axi1" }],
    });
  });
  afterEach(() => app.close());

  const add = async (name: string, device = "virtual"): Promise<Plotter> => {
    const response = await send(app.url, "POST", "/plotters", { name, device });
    expect(response.status).toBe(201);
    return plotterSchema.parse(await response.json());
  };
  const upload = async (name: string, plotterId: string): Promise<Job> => {
    const body = { name, drawing: SVG, settings: DEFAULT_PLOT_SETTINGS, plotterId };
    return jobSchema.parse(await (await send(app.url, "POST", "/jobs", body)).json());
  };

  it("say which settings their jobs start from, with their presets as settings to give with a job", async () => {
    const { id } = await add("Upstairs");
    const defaultsOf = async (): Promise<PlotterDefaults> =>
      plotterDefaultsSchema.parse(await (await send(app.url, "GET", `/plotters/${id}/defaults`)).json());
    expect(await defaultsOf()).toEqual({
      settings: DEFAULT_PLOT_SETTINGS,
      isModelSet: false,
      presets: [],
    });
    await send(app.url, "PATCH", `/plotters/${id}`, { machine: "axidraw-v3-a3" });
    const { pen } = DEFAULT_PLOT_SETTINGS;
    const drawn = { ...DEFAULT_PLOT_SETTINGS, pen: { ...pen, downPct: 11, liftPctPerS: 90 } };
    const presets = withPreset([], "Brush", {
      ...drawn,
      pen: { ...drawn.pen, liftPctPerS: undefined, extraDropMs: 444 },
      prepare: { ...drawn.prepare, hiddenLayers: ["guides"] },
    });
    await send(app.url, "PUT", `/plotters/${id}/settings`, { pen: drawn.pen, pens: [], presets });
    const { settings, isModelSet, presets: given } = await defaultsOf();
    expect(isModelSet).toBe(true);
    const jobWith = async (body: object): Promise<Job> => {
      const wanted = { name: "a", drawing: SVG, plotterId: id, ...body };
      return jobSchema.parse(await (await send(app.url, "POST", "/jobs", wanted)).json());
    };
    expect((await jobWith({})).settings).toEqual(settings);
    expect([settings.machine, settings.pen.downPct]).toEqual(["axidraw-v3-a3", 11]);
    expect(given.map(({ name }) => name)).toEqual(["Brush"]);
    const brush = (await jobWith({ settings: given[0]?.settings })).settings;
    // The lift rate of the plotter is not the preset's.
    expect([brush.pen.extraDropMs, brush.pen.liftPctPerS ?? null]).toEqual([444, null]);
    expect([brush.machine, brush.prepare.hiddenLayers]).toEqual(["axidraw-v3-a3", ["guides"]]);
    expect((await send(app.url, "GET", "/plotters/none/defaults")).status).toBe(404);
  });

  it("are added, renamed and removed while it runs, and every browser is notified", async () => {
    const events = await EventStream.open(app.url);
    const second = await add("Upstairs");
    const added = await events.find("plotters", ({ plotters }) => plotters.length === 2);
    expect(added.plotters.map(({ name }) => name)).toEqual(["Virtual plotter", "Upstairs"]);
    expect(app.store.plotters().map(({ name }) => name)).toEqual([null, "Upstairs"]);
    await send(app.url, "PATCH", `/plotters/${second.id}`, { name: "Attic" });
    await events.find("plotters", ({ plotters }) => plotters[1]?.name === "Attic");
    expect((await send(app.url, "DELETE", `/plotters/${second.id}`)).status).toBe(200);
    await events.find("plotters", ({ plotters }) => plotters.length === 1);
    expect((await snapshotOf(app.url)).plotters).toHaveLength(1);
    events.close();
  });

  it("are all kept if several with names in other scripts are added in the same millisecond", async () => {
    const now = vi.spyOn(Date, "now").mockReturnValue(Date.now());
    const added = [await add("左"), await add("右")];
    now.mockRestore();
    expect(new Set(added.map(({ id }) => id)).size).toBe(2);
    expect(app.store.plotters().map(({ name }) => name)).toEqual([null, "左", "右"]);
  });

  it("have unique names and devices, and at least one remains", async () => {
    const { id } = await add("Upstairs", "/dev/ttyACM0");
    expect(
      await faultOf(await send(app.url, "POST", "/plotters", { name: "UPSTAIRS", device: "virtual" })),
    ).toEqual({
      status: 409,
      code: "conflict",
    });
    const sameDevice = { name: "Other", device: "/dev/ttyACM0" };
    expect((await send(app.url, "POST", "/plotters", sameDevice)).status).toBe(409);
    expect((await send(app.url, "POST", "/plotters", { name: " ", device: "virtual" })).status).toBe(400);
    expect((await send(app.url, "DELETE", "/plotters/virtual")).status).toBe(200);
    expect((await send(app.url, "DELETE", `/plotters/${id}`)).status).toBe(409);
    expect((await send(app.url, "DELETE", "/plotters/none")).status).toBe(404);
  });

  it("are offered the connected boards, with the plotter that uses each", async () => {
    const listed = async (): Promise<unknown> => {
      const { devices } = (await (await send(app.url, "GET", "/devices")).json()) as { devices: unknown[] };
      return devices.map((device) => deviceSchema.parse(device));
    };
    expect(await listed()).toEqual([{ path: "/dev/ttyACM0", description: "EiBotBoard Axi1", inUseBy: null }]);
  });

  it("are asked what they are", async () => {
    expect(await (await send(app.url, "POST", "/devices/ask")).json()).toEqual({
      devices: [
        {
          path: "/dev/ttyACM0",
          description: "EiBotBoard Axi1",
          inUseBy: null,
          answer: "Grbl 1.1h",
          fault: null,
        },
      ],
    });
  });

  it("plot side by side, each at most one job, and a queued job moves to another one", async () => {
    const { id } = await add("Upstairs");
    const [a, b, c] = [
      await upload("a", "virtual"),
      await upload("b", "virtual"),
      await upload("c", "virtual"),
    ];
    await send(app.url, "POST", `/jobs/${a.id}/start`);
    expect(await faultOf(await send(app.url, "POST", `/jobs/${b.id}/start`))).toEqual({
      status: 409,
      code: "busy",
    });
    const moved = await send(app.url, "PATCH", `/jobs/${b.id}`, { plotterId: id });
    expect(jobSchema.parse(await moved.json()).plotterId).toBe(id);
    expect((await send(app.url, "POST", `/jobs/${b.id}/start`)).status).toBe(200);
    const states = (await snapshotOf(app.url)).jobs.map(({ name, state }) => `${name} ${state}`);
    expect(states).toEqual(["a plotting", "b plotting", "c queued"]);
    expect((await send(app.url, "PATCH", `/jobs/${a.id}`, { plotterId: id })).status).toBe(409);
    expect((await send(app.url, "PATCH", `/jobs/${c.id}`, { plotterId: "none" })).status).toBe(404);
    const run = await app.more[0]?.nextRun();
    run?.end({ kind: "done" });
    await expect.poll(() => app.queue.get(b.id).state).toBe("done");
    expect(app.queue.get(a.id).state).toBe("plotting");
  });

  it("are not removed while they have jobs, and keep their device", async () => {
    const { id } = await add("Upstairs");
    const job = await upload("a", id);
    expect((await send(app.url, "DELETE", `/plotters/${id}`)).status).toBe(409);
    await send(app.url, "POST", `/jobs/${job.id}/start`);
    const change = { device: "/dev/ttyACM0" };
    expect(await faultOf(await send(app.url, "PATCH", `/plotters/${id}`, change))).toEqual({
      status: 409,
      code: "busy",
    });
    expect((await send(app.url, "PATCH", `/plotters/${id}`, { name: "Attic" })).status).toBe(200);
    const run = await app.more[0]?.nextRun();
    run?.end({ kind: "done" });
    await expect.poll(() => app.queue.get(job.id).state).toBe("done");
    expect((await send(app.url, "DELETE", `/plotters/${id}`)).status).toBe(200);
    // History stays, and can be plotted again on any plotter.
    const again = await send(app.url, "POST", `/jobs/${job.id}/requeue`);
    expect(jobSchema.parse(await again.json())).toMatchObject({ state: "queued", plotterId: "virtual" });
  });

  it("have separate queues that continue or wait", async () => {
    const { id } = await add("Upstairs");
    const events = await EventStream.open(app.url);
    expect((await send(app.url, "PATCH", `/plotters/${id}/queue`, { runOn: true })).status).toBe(200);
    await events.find("queues", ({ queues }) => queues[id]?.runOn === true);
    const { queue, queues } = await snapshotOf(app.url);
    expect([queue, queues]).toEqual([{ runOn: false }, { virtual: { runOn: false }, [id]: { runOn: true } }]);
    expect((await send(app.url, "PATCH", "/plotters/none/queue", { runOn: true })).status).toBe(404);
    const [a, b] = [await upload("a", "virtual"), await upload("b", id)];
    const [c, d] = [await upload("c", "virtual"), await upload("d", id)];
    for (const job of [a, b]) await send(app.url, "POST", `/jobs/${job.id}/start`);
    (await app.plotter.nextRun()).end({ kind: "done" });
    (await app.more[0]?.nextRun())?.end({ kind: "done" });
    await expect.poll(() => app.queue.get(d.id).state).toBe("plotting");
    expect(app.queue.get(c.id).state).toBe("queued");
    events.close();
  });
});

describe("a plotter that is changed to another machine", () => {
  it("stays connected, and home stays", async () => {
    const dataDir = folderOfTest();
    const server = await createServer({ port: 0, device: "virtual", virtualSpeed: 50, dataDir });
    const main = async (): Promise<Plotter> => (await snapshotOf(server.url)).plotters[0];
    try {
      await expect.poll(async () => (await main()).connection).toBe("idle");
      expect((await send(server.url, "POST", "/plotters/main/move-to", { xMm: 20, yMm: 15 })).status).toBe(
        200,
      );
      const patched = await send(server.url, "PATCH", "/plotters/main", { machine: "axidraw-v3-a3" });
      expect(plotterSchema.parse(await patched.json())).toMatchObject({
        machine: "axidraw-v3-a3",
        connection: "idle",
        xMm: 20,
        yMm: 15,
      });
      const unknown = await send(server.url, "PATCH", "/plotters/main", { machine: "none-such" });
      expect(await faultOf(unknown)).toEqual({ status: 400, code: "bad-setting" });
      expect((await main()).machine).toBe("axidraw-v3-a3");
    } finally {
      await server.close();
    }
  });
});

describe("a server with two virtual plotters", () => {
  it("plots on both at once and knows them after a restart", async () => {
    const dataDir = folderOfTest();
    const options = { port: 0, device: "virtual", virtualSpeed: 5, dataDir };
    let server = await createServer(options);
    try {
      expect((await snapshotOf(server.url)).plotters.map(({ id }) => id)).toEqual(["main"]);
      const added = await send(server.url, "POST", "/plotters", { name: "Second", device: "virtual" });
      const { id: second } = plotterSchema.parse(await added.json());
      const jobs: Job[] = [];
      for (const plotterId of ["main", second]) {
        const response = await fetch(`${server.url}/api/v1/jobs?name=a&plotterId=${plotterId}`, {
          method: "POST",
          body: LONG,
        });
        jobs.push(jobSchema.parse(await response.json()));
      }
      const events = await EventStream.open(server.url);
      for (const { id } of jobs)
        await expect.poll(async () => (await send(server.url, "POST", `/jobs/${id}/start`)).status).toBe(200);
      // Long enough that neither can have ended while the other is still being planned.
      for (const { id } of jobs) await events.find("progress", ({ jobId }) => jobId === id);
      expect((await snapshotOf(server.url)).jobs.map(({ state }) => state)).toEqual(["plotting", "plotting"]);
      for (const { id } of jobs) await send(server.url, "POST", `/jobs/${id}/cancel`);
      for (const { id } of jobs)
        await events.find("job", ({ job }) => job.id === id && job.state === "cancelled");
      events.close();
      await server.close();
      server = await createServer(options);
      expect((await snapshotOf(server.url)).plotters.map(({ name, kind }) => [name, kind])).toEqual([
        ["Virtual plotter", "virtual"],
        ["Second", "virtual"],
      ]);
    } finally {
      await server.close();
    }
  });
});
