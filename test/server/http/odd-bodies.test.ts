/** Malicious bodies and names: each gets an answer, and none is stored unchanged. */
import { gzipSync } from "node:zlib";
import { request as httpRequest } from "node:http";
import { afterEach, beforeEach, describe, expect, it } from "vitest";
import {
  DEFAULT_PLOT_SETTINGS,
  apiErrorSchema,
  jobSchema,
  plotterSchema,
} from "../../../src/schema/index.js";
import { startApp, type TestApp } from "../../support/servers/app.js";

const SVG = '<svg xmlns="http://www.w3.org/2000/svg"><path d="M0 0h10"/></svg>';
let app: TestApp;
beforeEach(async () => {
  app = await startApp({ maxUploadBytes: 30_000_000 });
});
afterEach(() => app.close());

const send = (
  method: string,
  path: string,
  body: string | Buffer<ArrayBuffer>,
  headers = {},
): Promise<Response> =>
  fetch(`${app.url}/api/v1${path}`, {
    method,
    body,
    headers: { "Content-Type": "application/json", ...headers },
    signal: AbortSignal.timeout(60_000),
  });
const newJob = (more: object): string =>
  JSON.stringify({ name: "a", drawing: SVG, settings: DEFAULT_PLOT_SETTINGS, ...more });
const fault = async (response: Response) => {
  const { error } = apiErrorSchema.parse(await response.json());
  return { status: response.status, ...error };
};

describe("a body", () => {
  it("is not read for a queue that does not exist", async () => {
    const bomb = Buffer.from(gzipSync(Buffer.from(`{"a":"${"x".repeat(45_000_000)}"}`)));
    const answer = await fault(await send("POST", "/shared-jobs", bomb, { "Content-Encoding": "gzip" }));
    expect(answer).toMatchObject({
      status: 404,
      message: expect.stringMatching(/no shared queue/) as string,
    });
    // The answer is sent before the body has arrived.
    const { hostname, port } = new URL(app.url);
    const headers = { "Content-Type": "application/json", "Content-Length": "40000000" };
    const status = await new Promise<number | undefined>((resolve, reject) => {
      const request = httpRequest(
        { hostname, port, path: "/api/v1/shared-jobs", method: "POST", headers, timeout: 10_000 },
        (response) => {
          resolve(response.statusCode);
          request.destroy();
        },
      );
      request.on("timeout", () => request.destroy(new Error("no answer")));
      request.on("error", reject);
      request.write("{");
    });
    expect(status).toBe(404);
  });

  it("a body with endless layers is refused, in a job and in a change", async () => {
    const many = (count: number, value: unknown): object =>
      Object.fromEntries(Array.from({ length: count }, (_, i) => [`layer ${i}`, value]));
    const settings = { ...DEFAULT_PLOT_SETTINGS, layerPens: many(10_500, "a") };
    const refused = { status: 400, message: expect.stringMatching(/layerPens: at most 10000/) as string };
    expect(await fault(await send("POST", "/jobs", newJob({ settings })))).toMatchObject(refused);
    const job = jobSchema.parse(await (await send("POST", "/jobs", newJob({}))).json());
    expect(await fault(await send("PATCH", `/jobs/${job.id}`, JSON.stringify({ settings })))).toMatchObject(
      refused,
    );
    for (const one of [
      { ...DEFAULT_PLOT_SETTINGS, layerStops: many(10_500, true) },
      { ...DEFAULT_PLOT_SETTINGS, pen: { ...DEFAULT_PLOT_SETTINGS.pen, layers: many(10_500, {}) } },
      { ...DEFAULT_PLOT_SETTINGS, motion: { ...DEFAULT_PLOT_SETTINGS.motion, layers: many(10_500, {}) } },
      {
        ...DEFAULT_PLOT_SETTINGS,
        prepare: { ...DEFAULT_PLOT_SETTINGS.prepare, layerRepeats: many(10_500, 2) },
      },
    ]) {
      expect((await send("POST", "/jobs", newJob({ settings: one }))).status).toBe(400);
    }
    expect(app.queue.list()).toHaveLength(1);
  });

  it("nested without end is refused with an explanation, small or large", async () => {
    for (const [depth, status, code] of [
      [100_000, 400, "bad-setting"],
      [9_000_000, 413, "too-large"],
    ] as const) {
      const nested = "[".repeat(depth) + "]".repeat(depth);
      for (const text of [
        nested,
        `{"name":"a","drawing":"<svg/>","settings":${nested}}`,
        "[".repeat(depth),
      ]) {
        const answer = await fault(await send("POST", "/jobs", text));
        expect(answer).toMatchObject({ status, code });
      }
    }
    expect(app.drawingsOnDisk()).toEqual([]);
  });
});

describe("a name", () => {
  it("is stored without characters that could forge a log line or can't be written", async () => {
    const evil = "a\nrefused GET / from 1.2.3.4\u001b[2Jb\u0000\u202ec\u2028";
    const clean = "a refused GET / from 1.2.3.4 [2Jb c";
    const job = jobSchema.parse(await (await send("POST", "/jobs", newJob({ name: evil }))).json());
    expect(job.name).toBe(clean);
    const raw = await send("POST", `/jobs?name=${encodeURIComponent(evil.replace("/", "-"))}`, SVG, {
      "Content-Type": "image/svg+xml",
    });
    expect(jobSchema.parse(await raw.json()).name).toBe(clean.replace("/", "-"));
    const patched = await send("PATCH", `/jobs/${job.id}`, JSON.stringify({ name: `x${evil}` }));
    expect(jobSchema.parse(await patched.json()).name).toBe(`x${clean}`);
    const plotter = await send("POST", "/plotters", JSON.stringify({ name: evil, device: "virtual" }));
    expect(plotterSchema.parse(await plotter.json()).name).toBe(clean);
    const key = await send("POST", "/access/keys", JSON.stringify({ name: evil, role: "watch" }));
    expect(await key.json()).toMatchObject({ entry: { name: clean } });
    expect(app.logged.join("")).not.toMatch(/[\n\u001b\u0000\u202e]/);
  });

  it("a name with half a surrogate pair is answered like any other, and so is its drawing", async () => {
    const half = String.fromCharCode(0xd83d);
    for (const name of [`a${half}b`, half, `${"a".repeat(199)}🖊`]) {
      const answer = await send("POST", "/jobs", newJob({ name: name.slice(0, 200) }));
      const { id } = jobSchema.parse(await answer.json());
      expect((await fetch(`${app.url}/api/v1/jobs/${id}/drawing`)).status).toBe(200);
      const patched = await send("PATCH", `/jobs/${id}`, `{"name":"\\ud83d"}`);
      expect(jobSchema.parse(await patched.json()).name).toBe("\ufffd");
    }
  });

  it("must not be empty", async () => {
    for (const name of ["", "  ", "\u0000", "\n\t"]) {
      const json = await fault(await send("POST", "/jobs", newJob({ name })));
      expect(json).toMatchObject({ status: 400, message: expect.stringMatching(/^name: /) as string });
      const raw = await send("POST", `/jobs?name=${encodeURIComponent(name)}`, SVG, {
        "Content-Type": "x/y",
      });
      expect(raw.status).toBe(400);
      const plotter = await send("POST", "/plotters", JSON.stringify({ name, device: "virtual" }));
      expect(plotter.status).toBe(400);
    }
    const root = await send("POST", "/jobs?name=%2F", SVG, { "Content-Type": "x/y" });
    expect(root.status).toBe(400);
    expect(app.drawingsOnDisk()).toEqual([]);
  });
});

describe("a page of another site", () => {
  it("is refused however it spells the path", async () => {
    for (const path of ["/api/v1/state", "/API/v1/state", "/Api/V1/State"]) {
      const response = await fetch(`${app.url}${path}`, { headers: { "Sec-Fetch-Site": "cross-site" } });
      expect([path, response.status]).toEqual([path, 403]);
    }
  });
});
