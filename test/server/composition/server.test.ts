/** The whole server, embedded or served: real threads, real disk, the virtual board. */
import { existsSync, readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { afterEach, beforeEach, describe, expect, it } from "vitest";
import { createServer, type PlotwrightServer, type ServerOptions } from "../../../server/index.js";
import {
  DEFAULT_PLOT_SETTINGS,
  apiErrorSchema,
  jobSchema,
  snapshotSchema,
  type Job,
  type Pairing,
  type PlotSettings,
  type Snapshot,
} from "../../../src/schema/index.js";
import { EventStream } from "../../support/servers/event-stream.js";
import { folderOfTest } from "../../support/processes/folders.js";

const svg = (content: string, attributes = 'width="100mm" height="100mm" viewBox="0 0 100 100"'): string =>
  `<svg xmlns="http://www.w3.org/2000/svg" xmlns:xlink="http://www.w3.org/1999/xlink" ${attributes} fill="none" stroke="black">${content}</svg>`;
/** Enough lines that the test meets a running plot, however busy the computer is. */
const lines = (count: number): string =>
  svg(Array.from({ length: count }, (_, i) => `<path d="M10 ${5 + (90 / count) * i}h80"/>`).join(""));
const LINE = svg('<path d="M10 10h60"/><path d="M10 30h60"/>');

let dataDir: string;
let server: PlotwrightServer;
beforeEach(async () => {
  dataDir = folderOfTest();
  await start();
});
afterEach(async () => {
  await server.close();
});

async function start(options: ServerOptions = {}): Promise<void> {
  server = await createServer({ port: 0, device: "virtual", virtualSpeed: 50, dataDir, ...options });
}
const state = async (): Promise<Snapshot> =>
  snapshotSchema.parse(await (await fetch(`${server.url}/api/v1/state`)).json());
const post = (path: string): Promise<Response> => fetch(`${server.url}/api/v1${path}`, { method: "POST" });
const upload = (text: string, settings: PlotSettings = DEFAULT_PLOT_SETTINGS): Promise<Response> =>
  fetch(`${server.url}/api/v1/jobs?name=test.svg&settings=${encodeURIComponent(JSON.stringify(settings))}`, {
    method: "POST",
    body: text,
  });
async function add(text: string): Promise<Job> {
  const response = await upload(text);
  expect(response.status).toBe(201);
  return jobSchema.parse(await response.json());
}

describe("a server", () => {
  it("shows new pairing links after a device was removed", async () => {
    let newLinkCount = 0;
    await server.close();
    await start({ onNewPairing: () => newLinkCount++ });
    const before = server.pairing;
    expect((await fetch(`${server.url}${before.watchPath}`)).status).toBe(200);
    const listed = await fetch(`${server.url}/api/v1/access`);
    const { entries } = (await listed.json()) as { entries: { id: string }[] };
    await fetch(`${server.url}/api/v1/access/${entries[0]?.id}`, { method: "DELETE" });
    expect(newLinkCount).toBe(1);
    const now = server.pairing;
    const shown = (await (await post("/pairing")).json()) as Pairing;
    expect(shown.operateUrl.endsWith(now.operatePath) && shown.watchUrl.endsWith(now.watchPath)).toBe(true);
    for (const path of [before.operatePath, before.watchPath]) {
      expect((await fetch(`${server.url}${path}`)).status).toBe(403);
    }
    expect((await fetch(`${server.url}${now.operatePath}`)).status).toBe(200);
  });

  it("plans, plots and finishes a drawing, and still knows it after a restart", async () => {
    const drawn = lines(30);
    const { id, stats } = await add(drawn);
    expect(stats).toMatchObject({ strokeCount: 30, pointCount: 60 });
    const events = await EventStream.open(server.url);
    expect((await post(`/jobs/${id}/start`)).status).toBe(200);
    await events.find("progress", (event) => event.jobId === id && !event.penUp);
    const { job } = await events.find("job", (event) => event.job.state === "done");
    expect(job).toMatchObject({ id, progress: 1, remainingS: 0 });
    const waiting = await add(LINE);
    events.close();
    await server.close();
    await start();
    const after = await state();
    expect(after.jobs.map((one) => [one.id, one.state])).toEqual([
      [waiting.id, "queued"],
      [id, "done"],
    ]);
    expect(after.jobs[1]).toEqual(job);
    const drawing = await fetch(`${server.url}/api/v1/jobs/${id}/drawing`);
    expect(await drawing.text()).toBe(drawn);
  });

  it("pauses with the pen up, continues to the end, and cancels another", async () => {
    const many = lines(80);
    const { id } = await add(many);
    const events = await EventStream.open(server.url);
    await post(`/jobs/${id}/start`);
    await events.find("progress", (event) => event.progress > 0.05);
    await post(`/jobs/${id}/pause`);
    await events.find("job", (event) => event.job.state === "paused");
    expect((await state()).plotters[0]?.penUp).toBe(true);
    await post(`/jobs/${id}/resume`);
    await events.find("job", (event) => event.job.id === id && event.job.state === "done");
    const second = await add(many);
    await post(`/jobs/${second.id}/start`);
    await events.find("progress", (event) => event.jobId === second.id);
    await post(`/jobs/${second.id}/cancel`);
    const { job } = await events.find("job", (event) => event.job.state === "cancelled");
    expect(job.progress).toBeLessThan(1);
    events.close();
    const [plotter] = (await state()).plotters;
    expect(plotter).toMatchObject({ connection: "idle", penUp: true });
    expect(Math.hypot(plotter?.xMm ?? NaN, plotter?.yMm ?? NaN)).toBeLessThan(0.02);
  });

  it("offers a job that a stop of the server interrupted, and plots the rest when asked", async () => {
    const { id } = await add(lines(120));
    const events = await EventStream.open(server.url);
    await post(`/jobs/${id}/start`);
    await events.find("progress", (event) => event.progress > 0.02);
    events.close();
    await server.close();
    await start({ virtualSpeed: 200 });
    const [job] = (await state()).jobs;
    expect(job).toMatchObject({ id, state: "interrupted", message: expect.stringMatching(/server stopped/) });
    expect(job?.place?.strokeIndex).toBeGreaterThan(0);
    const again = await EventStream.open(server.url);
    expect((await post(`/jobs/${id}/recover`)).status).toBe(200);
    await again.find("job", (event) => event.job.state === "paused");
    expect((await state()).jobs[0]?.place).toEqual(job?.place);
    expect((await post(`/jobs/${id}/resume`)).status).toBe(200);
    await again.find("job", (event) => event.job.state === "done");
    again.close();
  });

  it("refuses what can't be plotted with the reason, and keeps the queue unchanged", async () => {
    const kept = await add(LINE);
    const trueSize: PlotSettings = {
      ...DEFAULT_PLOT_SETTINGS,
      prepare: {
        ...DEFAULT_PLOT_SETTINGS.prepare,
        paper: { widthMm: 1_000, heightMm: 1_000 },
        fit: false,
        marginMm: 0,
      },
    };
    const refused: readonly (readonly [string, string, number, PlotSettings?])[] = [
      ["not an SVG", "hello", 422],
      ["empty", "", 422],
      ["truncated", LINE.slice(0, -12), 422],
      ["without lines", svg(""), 422],
      [
        "larger than the machine",
        svg('<path d="M0 0L900 900"/>', 'width="900mm" height="900mm" viewBox="0 0 900 900"'),
        422,
        trueSize,
      ],
      ["unknown machine", LINE, 400, { ...DEFAULT_PLOT_SETTINGS, machine: "typewriter" }],
    ];
    for (const [what, text, status, settings] of refused) {
      const response = await upload(text, settings);
      const { error } = apiErrorSchema.parse(await response.json());
      expect([what, response.status, error.message.length > 15]).toEqual([what, status, true]);
    }
    expect((await state()).jobs).toEqual([kept]);
  });

  it("takes a drawing that leaves the paper only with a choice, by every way into the queue, and tells its size", async () => {
    // 330 mm long on a page of A4: too long to be moved, and out of the machine's reach.
    const wide = svg('<path d="M10 20H330"/>', 'width="297mm" height="210mm" viewBox="0 0 297 210"');
    const withPrepare = (change: Partial<PlotSettings["prepare"]>): PlotSettings => ({
      ...DEFAULT_PLOT_SETTINGS,
      prepare: { ...DEFAULT_PLOT_SETTINGS.prepare, ...change },
    });
    const refusal = async (response: Response): Promise<string> => {
      const { error } = apiErrorSchema.parse(await response.json());
      return `${response.status} ${error.code} ${error.message}`;
    };
    const REFUSED =
      /^422 out-of-bounds .* paper of 297 × 210 mm: 1 stroke reaches up to 33 mm over its right edge\. Choose .*: cut \(at the paper's edge\), fit \(to the paper\)\. /;
    const asFile = (settings: string): Promise<Response> =>
      fetch(`${server.url}/api/v1/jobs?name=wide.svg${settings}`, {
        method: "POST",
        headers: { "Content-Type": "image/svg+xml" },
        body: wide,
      });
    expect(await refusal(await upload(wide))).toMatch(REFUSED);
    expect(await refusal(await asFile(""))).toMatch(REFUSED);
    expect((await state()).jobs).toEqual([]);

    const fitted = jobSchema.parse(await (await upload(wide, withPrepare({ outside: "fit" }))).json());
    expect(fitted.stats?.size).toMatchObject({ widthMm: expect.closeTo(267, 3), turnedDeg: 0 });
    const cut = encodeURIComponent(JSON.stringify(withPrepare({ outside: "cut" })));
    const job = jobSchema.parse(await (await asFile(`&settings=${cut}`)).json());
    expect(job.stats?.size).toMatchObject({ widthMm: 287.5, heightMm: 0, scaleX: 1, scaleY: 1 });
    expect(job.warnings.join()).toContain("33 mm of line lie outside the paper and are cut off");

    const changed = await fetch(`${server.url}/api/v1/jobs/${job.id}`, {
      method: "PATCH",
      headers: { "Content-Type": "application/json" },
      body: JSON.stringify({ settings: DEFAULT_PLOT_SETTINGS }),
    });
    expect(await refusal(changed)).toMatch(REFUSED);
    expect((await state()).jobs.find(({ id }) => id === job.id)?.settings.prepare.outside).toBe("cut");

    await server.close();
    const watchDir = folderOfTest();
    writeFileSync(join(watchDir, "watched.svg"), wide);
    await start({ watchDir });
    await expect
      .poll(async () => (await state()).serverNotices.map(({ message }) => message).join())
      .toMatch(/watched\.svg.*33 mm over its right edge/);
  });

  it("accepts odd drawings that can be plotted", async () => {
    const odd = {
      "NaN coordinates": svg('<path d="M NaN NaN L 10 10"/><path d="M10 10h50"/>'),
      "huge coordinates": svg('<path d="M0 0L1e300 1e300"/><path d="M10 10h50"/>'),
      "circular use": svg('<g id="a"><path d="M10 10h50"/><use xlink:href="#a"/></g>'),
      "entity bomb": `<!DOCTYPE svg [<!ENTITY a "aaaaaaaaaa"><!ENTITY b "&a;&a;&a;&a;&a;&a;&a;&a;&a;&a;">]>${svg("<text>&b;</text>")}`,
      "one point": svg('<path d="M20 20z"/><path d="M10 10h50"/>'),
      "100 000 nested groups": svg(`${"<g>".repeat(100_000)}<path d="M10 10h50"/>${"</g>".repeat(100_000)}`),
      "50 MB": svg(`<path d="M10 10h50"/><!--${"x".repeat(50_000_000)}-->`),
    };
    for (const [what, text] of Object.entries(odd)) {
      const response = await upload(text);
      expect([what, [201, 422].includes(response.status)]).toEqual([what, true]);
      const answer: unknown = await response.json();
      const figures = jobSchema.safeParse(answer);
      expect([what, figures.success || apiErrorSchema.safeParse(answer).success]).toEqual([what, true]);
    }
    expect((await state()).plotters).toHaveLength(1);
  });

  it("shows a missing device in the state, and still takes jobs", async () => {
    await server.close();
    await start({ device: join(dataDir, "no-such-device") });
    const { id } = await add(LINE);
    await expect
      .poll(async () => (await state()).plotters[0])
      .toMatchObject({ connection: "absent", message: expect.stringMatching(/no-such-device/) });
    const response = await post(`/jobs/${id}/start`);
    expect(response.status).toBe(503);
    expect(apiErrorSchema.parse(await response.json()).error.code).toBe("no-board");
    expect((await state()).jobs[0]?.state).toBe("queued");
  });

  it("distinguishes a taken port from a taken data folder, and releases both when closed", async () => {
    const port = Number(new URL(server.url).port);
    const other = folderOfTest();
    await expect(createServer({ port, device: "virtual", dataDir: other })).rejects.toThrow(
      `Port ${port} is taken by another program`,
    );
    await expect(createServer({ port: 0, device: "virtual", dataDir })).rejects.toThrow(
      "uses the data folder",
    );
    await server.close();
    await start({ port });
    expect(server.url).toBe(`http://127.0.0.1:${port}`);
  });

  it("refuses an option that it does not know, before it touches a folder", async () => {
    const folder = join(dataDir, "new");
    const options = { dataDir: folder, prot: 0 };
    await expect(createServer(options)).rejects.toThrow(/no option "prot"\. Options: port,/);
    expect(existsSync(folder)).toBe(false);
  });

  it("returns every sample exactly as on disk", async () => {
    const response = await fetch(`${server.url}/api/v1/samples`);
    const { samples } = (await response.json()) as { samples: { name: string; title: string }[] };
    for (const { name } of samples) {
      const text = await (await fetch(`${server.url}/api/v1/samples/${name}`)).text();
      expect(text).toBe(readFileSync(new URL(`../../../samples/${name}`, import.meta.url), "utf8"));
    }
  });
});
