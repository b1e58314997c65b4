/** The state that every client gets: always the current one, cheap to give out, and bounded in size. */
import { connect, type Socket } from "node:net";
import fc from "fast-check";
import { afterEach, beforeEach, describe, expect, it } from "vitest";
import { EventHub } from "../../../server/http/events.js";
import { DEFAULT_PLOT_SETTINGS, snapshotSchema, type Snapshot } from "../../../src/schema/index.js";
import { cases } from "../../support/runs/full-run.js";
import { startApp, type TestApp } from "../../support/servers/app.js";
import { EventStream } from "../../support/servers/event-stream.js";
import { drawingOf, makeJob } from "../../support/jobs/jobs.js";

const SVG = '<svg xmlns="http://www.w3.org/2000/svg"><path d="M0 0h10"/></svg>';

let app: TestApp;
const sockets: Socket[] = [];
beforeEach(async () => {
  app = await startApp();
});
afterEach(async () => {
  sockets.splice(0).forEach((socket) => socket.destroy());
  await app.close();
});

const post = (path: string, body: unknown, method = "POST", headers = {}): Promise<Response> =>
  fetch(`${app.url}/api/v1${path}`, {
    method,
    body: JSON.stringify(body),
    headers: { "Content-Type": "application/json", ...headers },
  });
const state = async (): Promise<Snapshot> =>
  snapshotSchema.parse(await (await fetch(`${app.url}/api/v1/state`)).json());

/** Settings of almost the greatest size, or of `layerCount` layers. */
const settingsOf = (layerCount: number): typeof DEFAULT_PLOT_SETTINGS => ({
  ...DEFAULT_PLOT_SETTINGS,
  layerPens: Object.fromEntries(Array.from({ length: layerCount }, (_, i) => [`layer ${i}`, "a pen"])),
});
const LARGE = settingsOf(3_800);

/** Sends a request, and reads nothing of the answer. */
async function unread(path: string, headers = ""): Promise<Socket> {
  const { hostname, port } = new URL(app.url);
  const socket = connect(Number(port), hostname);
  sockets.push(socket);
  socket.on("error", () => undefined).pause();
  await new Promise((resolve) => {
    socket.write(`GET /api/v1${path} HTTP/1.1\r\nHost: 127.0.0.1\r\n${headers}\r\n`, resolve);
  });
  return socket;
}

/** Sends requests, and reads only the first bytes of each answer. `begun` has those whose answer has begun. */
async function hardlyRead(path: string, count: number): Promise<{ begun: Set<Socket>; all: Socket[] }> {
  const begun = new Set<Socket>();
  const all = await Promise.all(Array.from({ length: count }, () => unread(path)));
  for (const socket of all) {
    socket.once("data", () => {
      begun.add(socket);
      socket.pause();
    });
    socket.resume();
  }
  return { begun, all };
}

/** One change of the state, by any way in. */
const CHANGES: Record<string, (ids: readonly string[]) => unknown> = {
  add: () => post("/jobs", { name: "a", drawing: SVG, settings: DEFAULT_PLOT_SETTINGS, copies: 2 }),
  rename: ([id]) => id && post(`/jobs/${id}`, { name: "b" }, "PATCH"),
  cancel: ([id]) => id && post(`/jobs/${id}/cancel`, {}),
  requeue: (ids) => ids[0] && post(`/jobs/${ids.at(-1)}/requeue`, {}),
  duplicate: ([id]) => id && post(`/jobs/${id}/duplicate`, {}),
  move: (ids) => ids[1] && post(`/jobs/${ids[0]}/move`, { beforeId: null }),
  remove: (ids) => ids[0] && fetch(`${app.url}/api/v1/jobs/${ids.at(-1)}`, { method: "DELETE" }),
  "run on": () => post("/queue", { runOn: true }, "PATCH"),
  notice: () => app.notices.add("something"),
  plotter: () => post("/plotters", { name: "more", device: "virtual" }),
  "plotter settings": () =>
    post("/plotters/virtual/settings", { pen: DEFAULT_PLOT_SETTINGS.pen, pens: [], presets: [] }, "PUT"),
};

describe("the state", () => {
  it("is the current one after any change", async () => {
    const names = fc.array(fc.constantFrom(...Object.keys(CHANGES)), { minLength: 1, maxLength: 12 });
    const plain = (value: unknown): unknown => JSON.parse(JSON.stringify(value));
    await fc.assert(
      fc.asyncProperty(names, async (changes) => {
        for (const change of changes) {
          const ids = (await state()).jobs.map(({ id }) => id);
          await CHANGES[change]?.(ids);
          const now = await state();
          expect(now.jobs).toEqual(plain(app.queue.list().slice(0, now.jobs.length)));
          expect(now.queues).toEqual(app.queue.allSettings());
          expect(now.serverNotices).toEqual(app.notices.list());
          expect(now.plotters).toHaveLength(1 + app.more.length);
          expect(now.plotterSettings["virtual"] !== undefined).toBe(
            app.store.plotterSettings()["virtual"] !== undefined,
          );
        }
      }),
      { numRuns: cases(100, 10), endOnFailure: true },
    );
  });

  it("is made again only after a change, and at times for progress", () => {
    const hub = new EventHub();
    let made = 0;
    const make = (): Snapshot => ({ ...snapshotSchema.parse(SMALL), version: String(++made) });
    expect(hub.snapshotText(make)).toBe(hub.snapshotText(make));
    const progress = { jobId: "a", plotterId: "virtual", progress: 0.1, elapsedS: 1, remainingS: 1 };
    const moment = { planS: 1, xMm: 1, yMm: 1, penUp: true, penMoving: false };
    hub.announce({ type: "progress", ...progress, ...moment, atMs: 0, heldBackMs: 0, ahead: [] });
    hub.snapshotText(make);
    expect(made).toBe(1);
    hub.announce({ type: "job", job: makeJob("a") });
    expect(snapshotSchema.parse(JSON.parse(hub.snapshotText(make).toString()))).toEqual({
      ...snapshotSchema.parse(SMALL),
      version: "2",
    });
    hub.close();
  });
  const SMALL = { version: "", plotters: [], jobs: [makeJob("a"), makeJob("b", { settings: LARGE })] };

  it("has the whole queue and the last 50 of the history; the rest is fetched in parts", async () => {
    app.store.transaction(() => {
      for (let i = 0; i < 120; i++) {
        const endedAt = new Date(Date.parse("2026-01-01") + 1_000 * i).toISOString();
        app.store.addJob(makeJob(`ended-${i}`, { state: "done", endedAt }), drawingOf("a"));
      }
      for (let i = 0; i < 70; i++) app.store.addJob(makeJob(`queued-${i}`), drawingOf("a"));
    });
    app = await restarted(app);
    const first = await state();
    expect(first.jobs.filter(({ state }) => state === "queued")).toHaveLength(70);
    expect([first.jobs.length, first.hasOlderJobs]).toEqual([120, true]);
    const ids = first.jobs.slice(70).map(({ id }) => id);
    for (let hasOlderJobs = true; hasOlderJobs;) {
      const page = snapshotSchema
        .pick({ jobs: true, hasOlderJobs: true })
        .parse(await (await fetch(`${app.url}/api/v1/history?after=${ids.at(-1)}`)).json());
      ids.push(...page.jobs.map(({ id }) => id));
      ({ hasOlderJobs } = page);
    }
    expect(ids).toEqual(Array.from({ length: 120 }, (_, i) => `ended-${119 - i}`));
    const events = await EventStream.open(app.url);
    const { snapshot } = await events.find("snapshot");
    expect(snapshot.jobs).toHaveLength(120);
    await post("/jobs/queued-0/move", { beforeId: null });
    expect((await events.find("order")).ids).toHaveLength(120);
    events.close();
    expect((await fetch(`${app.url}/api/v1/history?after=none`)).status).toBe(404);
    expect((await fetch(`${app.url}/api/v1/history?after=a&after=b`)).status).toBe(400);
  });

  it("can't be made huge by the settings of a job", async () => {
    const wanted = { name: "a", drawing: SVG, copies: 100 };
    const refused = await post("/jobs", { ...wanted, settings: settingsOf(9_000) });
    expect(refused.status).toBe(413);
    expect(await refused.text()).toMatch(/take \d+ kB, more than the 100 kB .*fewer layers/);
    expect(app.drawingsOnDisk()).toEqual([]);
    const added = await post("/jobs", { ...wanted, settings: LARGE });
    expect(added.status).toBe(201);
    const { id } = (await added.json()) as { id: string };
    expect((await post(`/jobs/${id}`, { settings: settingsOf(5_500) }, "PATCH")).status).toBe(413);
    const { jobs } = await state();
    expect(jobs).toHaveLength(100);
    expect(JSON.stringify(jobs).length).toBeLessThan(11_000_000);
  });

  it("is kept once for all clients that do not read it, and these are disconnected", async () => {
    await hurry({ trustsLoopback: false });
    const count = 30;
    const keys = Array.from({ length: count }, () => `Bearer ${app.access.createKey("a", "operate").secret}`);
    const wanted = { name: "a", drawing: SVG, copies: 100, settings: LARGE };
    expect((await post("/jobs", wanted, "POST", { Authorization: keys[0] })).status).toBe(201);
    const before = process.memoryUsage().external;
    for (const path of ["/state", "/events"]) {
      await Promise.all(keys.map((key) => unread(path, `Authorization: ${key}\r\n`)));
      await expect.poll(() => app.connectionCount()).toBeGreaterThanOrEqual(count);
      expect(process.memoryUsage().external - before).toBeLessThan(100_000_000);
      await expect.poll(() => app.connectionCount()).toBeLessThan(count / 2);
    }
  });

  it("is sent to one client of a session at a time, and to the next when that one reads no more", async () => {
    await post("/jobs", { name: "a", drawing: SVG, copies: 100, settings: LARGE });
    const { begun } = await hardlyRead("/state", 3);
    await expect.poll(() => begun.size).toBe(1);
    // Nothing else waits for it.
    for (let count = 0; count < 20; count++) {
      expect((await fetch(`${app.url}/api/v1/me`)).status).toBe(200);
    }
    expect(begun.size).toBe(1);
    expect((await state()).jobs).toHaveLength(100);
    await expect.poll(() => begun.size).toBe(3);
  });

  // 20 clients that are still there and do not read would take longer.
  it("does not wait for clients that have closed their connection", { timeout: 35_000 }, async () => {
    await post("/jobs", { name: "a", drawing: SVG, copies: 100, settings: LARGE });
    const { begun, all } = await hardlyRead("/events", 20);
    await expect.poll(() => begun.size).toBeGreaterThan(0);
    for (const socket of all) socket.destroy();
    const answers = await Promise.all([1, 2, 3].map(() => fetch(`${app.url}/api/v1/state`)));
    const texts = await Promise.all(answers.map((answer) => answer.text()));
    for (const text of texts) expect(text.length).toBeGreaterThan(5_000_000);
  });

  it("has what changed while a client waited for its turn, and events tell the rest", async () => {
    await post("/jobs", { name: "a", drawing: SVG, copies: 100, settings: LARGE });
    const { begun, all } = await hardlyRead("/state", 1);
    await expect.poll(() => begun.size).toBe(1);
    const page = await EventStream.open(app.url);
    app.notices.add("before");
    expect(page.seen).toEqual([]);
    all[0]?.destroy();
    const { snapshot } = await page.find("snapshot");
    expect(snapshot.serverNotices.map(({ message }) => message)).toEqual(["before"]);
    app.notices.add("after");
    await page.find("notice", ({ notice }) => notice.message === "after");
    expect(page.seen.map(({ type }) => type)).toEqual(["snapshot", "notice"]);
    page.close();
  });

  it("reaches a client that reads slowly, and its event stream stays open", async () => {
    await hurry();
    await post("/jobs", { name: "a", drawing: SVG, copies: 100, settings: LARGE });
    const text = await (await fetch(`${app.url}/api/v1/state`)).text();
    const socket = await unread("/events");
    let bytes = 0;
    socket.on("data", (chunk: Buffer) => {
      bytes += chunk.length;
      socket.pause();
      setTimeout(() => socket.resume(), 2);
    });
    socket.resume();
    await expect.poll(() => bytes).toBeGreaterThan(text.length);
    // Longer than the time limit: nothing is unread, so that the stream stays open.
    await new Promise((resolve) => setTimeout(resolve, 3_000));
    const before = bytes;
    app.notices.add("something");
    await expect.poll(() => bytes).toBeGreaterThan(before);
  });
});

/** From now on, clients that do not read are disconnected soon. */
async function hurry(options: Parameters<typeof startApp>[0] = {}): Promise<void> {
  await app.close();
  app = await startApp({ ...options, times: { unreadTimeout: 2_000 } });
}

/** The same data folder, opened again. */
async function restarted(running: TestApp): Promise<TestApp> {
  await running.close({ keepsData: true });
  return startApp({ dir: running.dir });
}
