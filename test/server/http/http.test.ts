import { request as httpRequest } from "node:http";
import { connect } from "node:net";
import { afterEach, beforeEach, describe, expect, it } from "vitest";
import { PlotwrightError } from "../../../src/index.js";
import {
  DEFAULT_PLOT_SETTINGS,
  apiErrorSchema,
  jobSchema,
  plotterSchema,
  snapshotSchema,
  type Job,
} from "../../../src/schema/index.js";
import { startApp, type TestApp } from "../../support/servers/app.js";
import { EventStream } from "../../support/servers/event-stream.js";
import { LED_PLANNING } from "../../support/jobs/led-plotter.js";

const SVG = '<svg xmlns="http://www.w3.org/2000/svg"><path d="M0 0h10"/></svg>';
let app: TestApp;
beforeEach(async () => {
  app = await startApp();
});
afterEach(() => app.close());

async function call(method: string, path: string, body?: unknown): Promise<Response> {
  return fetch(`${app.url}/api/v1${path}`, {
    method,
    ...(body === undefined
      ? {}
      : { body: JSON.stringify(body), headers: { "Content-Type": "application/json" } }),
  });
}
async function add(name: string): Promise<Job> {
  const response = await call("POST", "/jobs", { name, drawing: SVG, settings: DEFAULT_PLOT_SETTINGS });
  expect(response.status).toBe(201);
  return jobSchema.parse(await response.json());
}
async function fault(response: Response): Promise<{ status: number; code: string; message: string }> {
  const { error } = apiErrorSchema.parse(await response.json());
  return { status: response.status, ...error };
}

describe("the HTTP interface", () => {
  it("takes a job as JSON, shows it in the state, and returns its drawing as plain text to download", async () => {
    const job = await add('fern "<b>".svg');
    const state = snapshotSchema.parse(await (await call("GET", "/state")).json());
    expect(state.jobs).toEqual([job]);
    expect(state.plotters.map((plotter) => plotter.id)).toEqual(["virtual"]);
    const drawing = await call("GET", `/jobs/${job.id}/drawing`);
    expect(await drawing.text()).toBe(SVG);
    expect(drawing.headers.get("content-type")).toBe("text/plain; charset=utf-8");
    expect(drawing.headers.get("content-disposition")).toMatch(/^attachment; filename="fern/);
    expect(drawing.headers.get("x-content-type-options")).toBe("nosniff");
  });

  it("takes the file itself as the body, as curl --data-binary sends it", async () => {
    const response = await fetch(`${app.url}/api/v1/jobs?name=../../moss.svg`, {
      method: "POST",
      body: SVG,
      headers: { "Content-Type": "application/x-www-form-urlencoded" },
    });
    expect(response.status).toBe(201);
    const job = jobSchema.parse(await response.json());
    expect(job).toMatchObject({ name: "moss.svg", settings: DEFAULT_PLOT_SETTINGS, state: "queued" });
    expect(response.headers.get("location")).toBe(`/api/v1/jobs/${job.id}`);
  });

  it("takes settings beside a file body, and names what is wrong in them", async () => {
    const settings = { ...DEFAULT_PLOT_SETTINGS, sendAheadMs: 300 };
    const post = (text: string): Promise<Response> =>
      fetch(`${app.url}/api/v1/jobs?settings=${encodeURIComponent(text)}`, { method: "POST", body: SVG });
    expect(jobSchema.parse(await (await post(JSON.stringify(settings))).json()).settings).toEqual(settings);
    expect(await fault(await post("{"))).toMatchObject({ status: 400, code: "bad-setting" });
    const wrong = { ...settings, pen: { ...settings.pen, upPct: 130 } };
    expect((await fault(await post(JSON.stringify(wrong)))).message).toMatch(/pen\.upPct/);
  });

  it("takes a large drawing as a file first, byte for byte, then its job with the drawing's id", async () => {
    const drawing = `${SVG}<!-- ${"ü🖊\n".repeat(300_000)} -->`;
    const upload = await fetch(`${app.url}/api/v1/drawings`, { method: "POST", body: drawing });
    expect(upload.status).toBe(201);
    const { id: drawingId } = (await upload.json()) as { id: string };
    const job = { name: "large", drawingId, settings: DEFAULT_PLOT_SETTINGS, copies: 2 };
    const response = await call("POST", "/jobs", job);
    expect([response.status, app.logged]).toEqual([201, []]);
    const { id, settings } = jobSchema.parse(await response.json());
    expect(settings).toEqual(DEFAULT_PLOT_SETTINGS);
    expect(await (await call("GET", `/jobs/${id}/drawing`)).text()).toBe(drawing);
    expect([app.queue.list().length, app.drawingsOnDisk().length]).toEqual([2, 1]);
    // An upload serves one request.
    expect(await fault(await call("POST", "/jobs", job))).toMatchObject({ status: 404, code: "not-found" });
    expect(app.drawingsOnDisk()).toHaveLength(1);
  });

  it("adds several copies in one change, with one new order", async () => {
    const events = await EventStream.open(app.url);
    const before = await add("before");
    const body = { name: "fern", drawing: SVG, settings: DEFAULT_PLOT_SETTINGS, copies: 100 };
    const first = jobSchema.parse(await (await call("POST", "/jobs", body)).json());
    const ids = app.queue.list().map((job) => job.id);
    expect(ids.slice(0, 2)).toEqual([before.id, first.id]);
    expect([ids.length, new Set(ids).size]).toEqual([101, 101]);
    await events.find("order", (event) => event.ids.length === 101);
    const seen = events.seen.map((event) => event.type);
    expect(seen).toEqual(["snapshot", "job", "order", ...Array<string>(100).fill("job"), "order"]);
    expect(app.drawingsOnDisk()).toHaveLength(2);
    events.close();
  });

  it("needs either the drawing or the id of an upload by the same client", async () => {
    const job = { name: "a", settings: DEFAULT_PLOT_SETTINGS };
    for (const [more, status, message] of [
      [{}, 400, /either drawing or drawingId/],
      [{ drawing: SVG, drawingId: "a" }, 400, /either drawing or drawingId/],
      [{ drawingId: "../../etc/passwd" }, 404, /send the file again/],
      [{ drawingId: "0".repeat(32) }, 404, /send the file again/],
    ] as const) {
      expect(await fault(await call("POST", "/jobs", { ...job, ...more }))).toMatchObject({
        status,
        message: expect.stringMatching(message) as string,
      });
    }
    expect(app.drawingsOnDisk()).toEqual([]);
  });

  it("takes a job through start, pause, resume, cancel and requeue", async () => {
    const { id } = await add("fern");
    const act = async (name: string): Promise<Job> =>
      jobSchema.parse(await (await call("POST", `/jobs/${id}/${name}`)).json());
    expect((await act("start")).state).toBe("plotting");
    await app.plotter.nextRun();
    expect((await act("pause")).state).toBe("paused");
    expect((await act("resume")).state).toBe("plotting");
    await act("cancel");
    const events = await EventStream.open(app.url);
    const { snapshot } = await events.find("snapshot");
    expect(snapshot.jobs[0]?.state).toBe("cancelled");
    events.close();
    expect((await act("requeue")).state).toBe("queued");
  });

  it("reorders, renames and removes", async () => {
    const [a, b, c] = [await add("a"), await add("b"), await add("c")];
    expect((await call("POST", `/jobs/${c.id}/move`, { beforeId: a.id })).status).toBe(200);
    expect((await call("PATCH", `/jobs/${b.id}`, { name: "bee" })).status).toBe(200);
    expect((await call("DELETE", `/jobs/${a.id}`)).status).toBe(200);
    expect(app.queue.list().map((job) => job.name)).toEqual(["c", "bee"]);
    expect((await fault(await call("GET", `/jobs/${a.id}`))).status).toBe(404);
  });

  it("sends every browser a snapshot first and then the same changes", async () => {
    await add("before");
    const [one, two] = [await EventStream.open(app.url), await EventStream.open(app.url)];
    const { id } = await add("after");
    await call("POST", `/jobs/${id}/start`);
    const run = await app.plotter.nextRun();
    await one.find("job", (event) => event.job.state === "plotting");
    run.progress({
      progress: 0.25,
      elapsedS: 3,
      remainingS: 9,
      planS: 3,
      xMm: 5,
      yMm: 6,
      penUp: false,
      penMoving: false,
    });
    run.end({ kind: "done" });
    for (const stream of [one, two]) {
      await stream.find("job", (event) => event.job.id === id && event.job.state === "done");
      expect(stream.seen[0]).toMatchObject({ type: "snapshot", snapshot: { jobs: [{ name: "before" }] } });
      const progress = stream.seen.findIndex((event) => event.type === "progress");
      const done = stream.seen.findIndex((event) => event.type === "job" && event.job.state === "done");
      expect(progress).toBeGreaterThan(0);
      expect(progress).toBeLessThan(done);
    }
    const untilDone = ({ seen }: EventStream): unknown[] =>
      seen.slice(1, 1 + seen.findIndex((event) => event.type === "job" && event.job.state === "done"));
    expect(untilDone(two)).toEqual(untilDone(one));
    one.close();
    two.close();
  });

  it("moves the pen by hand, but not under a job", async () => {
    const up = plotterSchema.parse(await (await call("POST", "/plotters/virtual/pen", { up: true })).json());
    expect(up.id).toBe("virtual");
    await call("POST", "/plotters/virtual/home");
    await call("POST", "/plotters/virtual/motors-off");
    expect(app.plotter.asked).toEqual(["up", "home", "motors off"]);
    const { id } = await add("fern");
    await call("POST", `/jobs/${id}/start`);
    expect(await fault(await call("POST", "/plotters/virtual/home"))).toMatchObject({
      status: 409,
      code: "busy",
    });
    expect(await fault(await call("POST", "/plotters/none/home"))).toMatchObject({ status: 404 });
    expect(await fault(await call("POST", "/plotters/virtual/pen", { up: "yes" }))).toMatchObject({
      status: 400,
      message: expect.stringMatching(/^up: /),
    });
  });

  it("lists the samples and returns only those", async () => {
    const { samples } = (await (await call("GET", "/samples")).json()) as { samples: { name: string }[] };
    expect(samples.length).toBeGreaterThan(3);
    const first = await (await call("GET", `/samples/${samples[0]?.name}`)).text();
    expect(first).toMatch(/<svg/);
    for (const name of ["nothing.svg", "..%2Fpackage.json", "%2e%2e%2fpackage.json", "....//package.json"]) {
      expect((await call("GET", `/samples/${name}`)).status).toBe(404);
    }
  });

  it("keeps a connection open longer than a busy computer may suspend a program", async () => {
    const { headers } = await call("GET", "/state");
    const [, keptS] = /timeout=(\d+)/.exec(headers.get("keep-alive") ?? "") ?? [];
    expect(Number(keptS)).toBeGreaterThanOrEqual(60);
  });

  it("answers in one form to every invalid request", async () => {
    expect(await fault(await call("GET", "/nothing"))).toEqual({
      status: 404,
      code: "not-found",
      message: "There is nothing at GET /api/v1/nothing.",
    });
    expect(await fault(await call("POST", "/jobs", { name: "x" }))).toMatchObject({ status: 400 });
    expect(await fault(await fetch(`${app.url}/api/v1/jobs`, { method: "POST" }))).toMatchObject({
      status: 422,
    });
    const broken = await fetch(`${app.url}/api/v1/jobs`, {
      method: "POST",
      body: '{"name":',
      headers: { "Content-Type": "application/json" },
    });
    expect(await fault(broken)).toMatchObject({ status: 400, message: "The request is not valid JSON." });
    expect(await fault(await call("GET", "/jobs/..%2f..%2fetc%2fpasswd/drawing"))).toMatchObject({
      status: 404,
    });
    expect(await fault(await call("GET", "/jobs/%ff"))).toMatchObject({ status: 400 });
  });

  it("refuses a request with a name that it does not have, and says which there are", async () => {
    const job = { name: "a", drawing: SVG };
    for (const [path, body, words] of [
      [
        "/jobs",
        { ...job, setings: { pen: { downPct: 3 } } },
        /^setings: there is no such field\. There is name,/,
      ],
      ["/jobs", { ...job, constructor: 3 }, /^constructor: there is no such field/],
      [
        "/plotters/virtual/move-to",
        { xMm: 1, yMm: 1, y: 3 },
        /^y: there is no such field\. There is xMm, yMm/,
      ],
      ["/plotters/virtual/frame", { boxMM: {} }, /^boxMM: there is no such field\. There is jobId, .*boxMm/],
      ["/plotters/virtual/pen", { up: true, height: 30 }, /^height: there is no such field/],
    ] as const) {
      const { status, message } = await fault(await call("POST", path, body));
      expect([path, status, message]).toEqual([path, 400, expect.stringMatching(words)]);
    }
    for (const query of ["name=a&setings=3", "Name=a"]) {
      const response = await fetch(`${app.url}/api/v1/jobs?${query}`, { method: "POST", body: SVG });
      expect([query, (await fault(response)).status]).toEqual([query, 400]);
    }
    expect((await call("GET", "/history?afterId=3")).status).toBe(400);
    expect([app.queue.list(), app.drawingsOnDisk()]).toEqual([[], []]);
  });

  it("hides internal errors from the page and logs them", async () => {
    await app.close();
    app = await startApp({
      planning: { ...LED_PLANNING, measure: () => Promise.reject(new Error("secret path /home/x")) },
    });
    const response = await call("POST", "/jobs", {
      name: "a",
      drawing: SVG,
      settings: DEFAULT_PLOT_SETTINGS,
    });
    expect(await fault(response)).toEqual({
      status: 500,
      code: "internal",
      message: "An internal error occurred. The server's log has the details.",
    });
    expect(app.logged.join("\n")).toMatch(/POST .*secret path/);
  });

  it("refuses what planning refuses, with its message, and leaves queue and disk unchanged", async () => {
    await app.close();
    app = await startApp({
      planning: {
        ...LED_PLANNING,
        measure: () => Promise.reject(new PlotwrightError("bad-file", "Not an SVG.")),
      },
    });
    const response = await fetch(`${app.url}/api/v1/jobs?name=a`, { method: "POST", body: "hello" });
    expect(await fault(response)).toEqual({ status: 422, code: "bad-file", message: "Not an SVG." });
    expect(app.queue.list()).toEqual([]);
    expect(app.drawingsOnDisk()).toEqual([]);
  });
});

describe("the guard", () => {
  const raw = (headers: Record<string, string>, path = "/api/v1/state", method = "GET"): Promise<number> =>
    new Promise((resolve, reject) => {
      const request = httpRequest(`${app.url}${path}`, { method, headers }, (response) => {
        response.resume();
        resolve(response.statusCode ?? 0);
      });
      request.on("error", reject);
      request.end();
    });

  it("answers only to addresses, localhost and configured names", async () => {
    const { port } = new URL(app.url);
    for (const host of [
      `127.0.0.1:${port}`,
      `localhost:${port}`,
      "[::1]:9080",
      "192.168.1.4",
      "PLOTTER.lan",
    ]) {
      expect([host, await raw({ Host: host })]).toEqual([host, 200]);
    }
    for (const host of [
      "evil.example",
      "127.0.0.1.evil.example",
      "localhost.evil.example:80",
      "a b",
      "evil.example:x",
    ]) {
      expect([host, await raw({ Host: host })]).toEqual([host, 403]);
    }
  });

  it("refuses requests by pages of another site", async () => {
    const { host } = new URL(app.url);
    expect(await raw({ Host: host, Origin: app.url })).toBe(200);
    for (const origin of [
      "https://evil.example",
      "null",
      `https://${host}.evil.example`,
      "http://127.0.0.1:1",
    ]) {
      for (const [path, method] of [
        ["/api/v1/state", "GET"],
        ["/api/v1/events", "GET"],
        ["/api/v1/jobs?name=x", "POST"],
        ["/api/v1/plotters/virtual/home", "POST"],
      ] as const) {
        expect([origin, path, await raw({ Host: host, Origin: origin }, path, method)]).toEqual([
          origin,
          path,
          403,
        ]);
      }
    }
    expect(await raw({ Host: host, "Sec-Fetch-Site": "cross-site" })).toBe(403);
    expect(app.plotter.asked).toEqual([]);
  });

  it("sets a policy that allows no foreign script, frame or form", async () => {
    const { headers } = await fetch(`${app.url}/api/v1/state`);
    const policy = headers.get("content-security-policy") ?? "";
    expect(policy).toContain("script-src 'self';");
    expect(policy).toContain("frame-ancestors 'none'");
    expect(policy).not.toContain("unsafe-eval");
    expect(policy).not.toContain("upgrade-insecure-requests");
    expect(headers.get("strict-transport-security")).toBeNull();
    expect(headers.get("x-powered-by")).toBeNull();
  });

  it("refuses uploads over the limit, whole or streamed, and keeps serving", async () => {
    const large = "x".repeat(3_100_000);
    const file = await fetch(`${app.url}/api/v1/jobs`, { method: "POST", body: large });
    expect(await fault(file)).toMatchObject({ status: 413, code: "too-large" });
    async function* pieces(): AsyncGenerator<Uint8Array> {
      for (let sent = 0; sent < 70; sent++) yield new Uint8Array(50_000);
    }
    const streamed = await fetch(`${app.url}/api/v1/jobs`, {
      method: "POST",
      body: pieces() as unknown as BodyInit,
      duplex: "half",
    } as RequestInit);
    expect(await fault(streamed)).toMatchObject({ status: 413, code: "too-large" });
    const json = await call("POST", "/jobs", { name: "a", drawing: large, settings: DEFAULT_PLOT_SETTINGS });
    expect(await fault(json)).toMatchObject({ status: 413, code: "too-large" });
    expect((await call("GET", "/state")).status).toBe(200);
    expect(app.queue.list()).toEqual([]);
    expect(app.drawingsOnDisk()).toEqual([]);
  });

  it("survives an upload that is cut off, and stores nothing of it", async () => {
    const { port } = new URL(app.url);
    await new Promise<void>((resolve) => {
      const socket = connect(Number(port), "127.0.0.1", () => {
        socket.write("POST /api/v1/jobs HTTP/1.1\r\nHost: 127.0.0.1\r\nContent-Length: 500000\r\n\r\n<svg");
        socket.end();
      });
      socket.on("close", () => resolve());
      socket.on("error", () => undefined);
      socket.resume();
    });
    expect((await call("GET", "/state")).status).toBe(200);
    expect(app.queue.list()).toEqual([]);
    await expect.poll(() => app.drawingsOnDisk()).toEqual([]);
    expect(app.logged).toEqual([]);
  });
});
