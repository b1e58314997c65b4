/**
 * Slow uploads, intentional or not: other clients are served meanwhile, and no work is done for clients that
 * have gone.
 */
import { request as httpRequest } from "node:http";
import { readdirSync } from "node:fs";
import { join } from "node:path";
import { afterEach, beforeEach, describe, expect, it } from "vitest";
import { PlotwrightError } from "../../../src/index.js";
import { createServer, type PlotwrightServer } from "../../../server/index.js";
import { lane } from "../../../host/planning/lane.js";
import { apiErrorSchema, DEFAULT_PLOT_SETTINGS, jobSchema } from "../../../src/schema/index.js";
import { startApp, type TestApp } from "../../support/servers/app.js";
import { folderOfTest } from "../../support/processes/folders.js";

const SVG = '<svg xmlns="http://www.w3.org/2000/svg"><path d="M0 0h10" stroke="red"/></svg>';
const JSON_TYPE = { "Content-Type": "application/json" };

describe("a lane", () => {
  /** Work that ends when the test says so; `begun` in the order in which it begins. */
  function desk(places: number): {
    readonly begun: string[];
    begin(name: string, client?: string, signal?: AbortSignal): Promise<string>;
    end(name: string): void;
  } {
    const turn = lane(places);
    const begun: string[] = [];
    const ends = new Map<string, () => void>();
    return {
      begun,
      begin: (name, client, signal) =>
        turn({ client, signal }, async () => {
          begun.push(name);
          await new Promise<void>((resolve) => ends.set(name, resolve));
          return name;
        }),
      end: (name) => ends.get(name)?.(),
    };
  }
  const settled = (): Promise<void> => new Promise((resolve) => setImmediate(resolve));

  it("gives each client one place, the others in order of arrival", async () => {
    const { begun, begin, end } = desk(2);
    const all = [begin("a1", "a"), begin("a2", "a"), begin("b1", "b"), begin("c1", "c"), begin("b2", "b")];
    await settled();
    expect(begun).toEqual(["a1", "b1"]);
    end("b1");
    await settled();
    expect(begun).toEqual(["a1", "b1", "c1"]);
    end("a1");
    await settled();
    expect(begun).toEqual(["a1", "b1", "c1", "a2"]);
    ["c1", "a2"].forEach(end);
    await settled();
    end("b2");
    expect(await Promise.all(all)).toEqual(["a1", "a2", "b1", "c1", "b2"]);
  });

  it("drops clients that disconnect while they wait, or before", async () => {
    const { begun, begin, end } = desk(1);
    const gone = new AbortController();
    const first = begin("first");
    const leaving = begin("leaving", "x", gone.signal);
    const last = begin("last");
    gone.abort();
    await expect(leaving).rejects.toMatchObject({ code: "cancelled" });
    await expect(begin("late", "x", AbortSignal.abort())).rejects.toMatchObject({ code: "cancelled" });
    end("first");
    await first;
    await settled();
    expect(begun).toEqual(["first", "last"]);
    end("last");
    await last;
  });
});

describe("uploads whose ordering takes an hour", () => {
  const scattered = `<svg xmlns="http://www.w3.org/2000/svg" width="200mm" height="200mm" viewBox="0 0 200 200"><path stroke="black" fill="none" d="${Array.from(
    { length: 20_000 },
    (_, i) => `M${(i * 7919) % 200} ${(i * 104_729) % 197}h.5`,
  ).join("")}"/></svg>`;
  const prepare = { ...DEFAULT_PLOT_SETTINGS.prepare, order: "best" as const, orderS: 3_600 };
  const body = JSON.stringify({
    name: "long",
    drawing: scattered,
    settings: { ...DEFAULT_PLOT_SETTINGS, prepare },
  });

  let dataDir: string;
  let server: PlotwrightServer;
  beforeEach(async () => {
    dataDir = folderOfTest();
    server = await createServer({ port: 0, device: "virtual", dataDir });
  });
  afterEach(async () => {
    await server.close();
  });

  it("do not delay ordinary ones, and end with their client", async () => {
    const gone = new AbortController();
    const jobs = `${server.url}/api/v1/jobs`;
    const drawings = (): string[] => readdirSync(join(dataDir, "drawings"));
    const long = [1, 2, 3].map(() =>
      fetch(jobs, { method: "POST", headers: JSON_TYPE, body, signal: gone.signal }).then(
        () => "answered",
        () => "gone",
      ),
    );
    await expect.poll(() => drawings().filter((name) => name.endsWith(".svg")).length).toBe(3);
    const answer = await fetch(`${jobs}?name=ordinary`, { method: "POST", body: SVG });
    expect([answer.status, jobSchema.parse(await answer.json()).name]).toEqual([201, "ordinary"]);
    gone.abort();
    expect(await Promise.all(long)).toEqual(["gone", "gone", "gone"]);
    // Their drawings are removed when their planning has ended.
    await expect.poll(() => drawings().length).toBe(1);
  }, 120_000);
});

describe("JSON", () => {
  let app: TestApp;
  beforeEach(async () => {
    app = await startApp({ maxUploadBytes: 40_000_000 });
  });
  afterEach(() => app.close());

  async function post(body: string): Promise<{ status: number; message: string }> {
    const answer = await fetch(`${app.url}/api/v1/jobs`, { method: "POST", headers: JSON_TYPE, body });
    const { message } = answer.ok ? { message: "" } : apiErrorSchema.parse(await answer.json()).error;
    return { status: answer.status, message };
  }
  const nested = (depth: number): string => "[".repeat(depth) + "]".repeat(depth);
  const job = (more: string): string => `{"name":"a","drawing":${JSON.stringify(SVG)},${more}}`;

  it.each([
    ["all of it", nested(400_000)],
    ["beside the drawing", job(`"settings":${nested(400_000)}`)],
    ["a small one", job(`"settings":${nested(50_000)}`)],
    ["in place of the drawing", `{"name":"a","drawing":${nested(400_000)}}`],
  ])("nested deeply, %s, is refused and nothing of it is stored", async (_what, body) => {
    const { status, message } = await post(body);
    expect([status, message]).toEqual([400, expect.stringMatching(/nested|object|expected|drawing|JSON/i)]);
    expect(app.drawingsOnDisk()).toEqual([]);
    expect(app.logged.filter((line) => line.includes("Error"))).toEqual([]);
  });

  it.each([
    ["large settings", job(`"settings":{"k":${JSON.stringify("y".repeat(9_000_000))}}`)],
    ["a large drawing", JSON.stringify({ name: "a", drawing: `<svg>${" ".repeat(9_000_000)}</svg>` })],
  ])("JSON with %s is not parsed, and the answer says how to send the drawing", async (_what, body) => {
    const { status, message } = await post(body);
    expect([status, message]).toEqual([413, expect.stringContaining("POST /api/v1/drawings")]);
    expect(app.drawingsOnDisk()).toEqual([]);
  });

  it("JSON that is broken late is refused with an explanation", async () => {
    const { status, message } = await post(job(`"x":${JSON.stringify("y".repeat(900_000))}`).slice(0, -1));
    expect([status, message]).toEqual([400, "The request is not valid JSON."]);
  });
});

describe("an uploaded drawing", () => {
  const post = (app: TestApp, body: string): Promise<Response> =>
    fetch(`${app.url}/api/v1/drawings`, { method: "POST", body });
  const add = (app: TestApp, drawingId: string): Promise<Response> =>
    fetch(`${app.url}/api/v1/jobs`, {
      method: "POST",
      headers: JSON_TYPE,
      body: JSON.stringify({ name: "a", drawingId, settings: DEFAULT_PLOT_SETTINGS }),
    });
  const idOf = async (answer: Response): Promise<string> => ((await answer.json()) as { id: string }).id;

  it("is removed when no job claims it in time, and when the server closes", async () => {
    const app = await startApp({ keepUploadsMs: 200 });
    const id = await idOf(await post(app, SVG));
    expect(app.drawingsOnDisk()).toEqual([`${id}.svg`]);
    await expect.poll(() => app.drawingsOnDisk()).toEqual([]);
    expect((await add(app, id)).status).toBe(404);
    await app.close();

    const dataDir = folderOfTest();
    const server = await createServer({ port: 0, device: "virtual", dataDir });
    await fetch(`${server.url}/api/v1/drawings`, { method: "POST", body: SVG });
    await server.close();
    expect(readdirSync(join(dataDir, "drawings"))).toEqual([]);
  }, 30_000);

  it("stays for its job, however long that waits", async () => {
    const app = await startApp({ keepUploadsMs: 200 });
    const id = await idOf(await post(app, SVG));
    expect((await add(app, id)).status).toBe(201);
    await new Promise((resolve) => setTimeout(resolve, 400));
    expect(app.drawingsOnDisk()).toEqual([`${id}.svg`]);
    await app.close();
  }, 30_000);

  it("is removed when its job can't be planned", async () => {
    const measure = (): Promise<never> =>
      Promise.reject(new PlotwrightError("bad-file", "It is not a drawing."));
    const app = await startApp({ planning: { measure, open: measure } });
    expect((await add(app, await idOf(await post(app, SVG)))).status).toBe(422);
    expect(app.drawingsOnDisk()).toEqual([]);
    await app.close();
  }, 30_000);

  it("is refused when it is empty or too large, and nothing of a half-sent one is stored", async () => {
    const app = await startApp({ maxUploadBytes: 10_000 });
    expect((await post(app, "")).status).toBe(422);
    expect((await post(app, "x".repeat(10_001))).status).toBe(413);
    const { hostname, port } = new URL(app.url);
    const half = httpRequest({ hostname, port, path: "/api/v1/drawings", method: "POST" });
    half.on("error", () => undefined);
    half.setHeader("Content-Length", 9_000);
    half.write("<svg");
    await expect.poll(() => app.drawingsOnDisk().length).toBe(1);
    half.destroy();
    await expect.poll(() => app.drawingsOnDisk()).toEqual([]);
    await app.close();
  }, 30_000);
});
