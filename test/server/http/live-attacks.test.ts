/** Attacks on the WebSocket of live drawings, which is the one upgrade that the server allows. */
import { request as httpRequest } from "node:http";
import { Socket } from "node:net";
import { afterEach, beforeEach, describe, expect, it, vi } from "vitest";
import { WebSocket } from "ws";
import { DEFAULT_PLOT_SETTINGS, liveReportSchema, type LiveReport } from "../../../src/schema/index.js";
import { startApp, type TestApp } from "../../support/servers/app.js";

let app: TestApp;
let cookies: Record<"operate" | "watch" | "submit", string>;
const sockets: WebSocket[] = [];

beforeEach(async () => {
  app = await startApp({ trustsLoopback: false, allowedOrigins: ["https://art.example"] });
  const pair = async (role: "operate" | "watch" | "submit"): Promise<string> => {
    const paired = await fetch(`${app.url}${app.access.pairingPath(role)}`);
    return (paired.headers.get("set-cookie") ?? "").split(";")[0];
  };
  cookies = { operate: await pair("operate"), watch: await pair("watch"), submit: await pair("submit") };
});
afterEach(async () => {
  for (const socket of sockets.splice(0)) socket.terminate();
  await app.close();
});

interface Opened {
  readonly socket: WebSocket;
  readonly reports: LiveReport[];
  readonly closed: Promise<number>;
}

/** Opens a WebSocket; rejects with the status of a refusal. */
function open(
  headers: Record<string, string>,
  { path = "/api/v1/plotters/virtual/live", protocols = ["plotwright-live"] } = {},
): Promise<Opened> {
  const socket = new WebSocket(app.url.replace("http", "ws") + path, protocols, { headers });
  sockets.push(socket);
  const reports: LiveReport[] = [];
  socket.on("message", (data: Buffer) => reports.push(liveReportSchema.parse(JSON.parse(data.toString()))));
  const closed = new Promise<number>((resolve) => socket.on("close", resolve));
  return new Promise((resolve, reject) => {
    socket.on("open", () => resolve({ socket, reports, closed }));
    socket.on("unexpected-response", (_request, response) => {
      reject(new Error(`refused with ${response.statusCode}`));
      socket.terminate();
    });
    socket.on("error", (error) => reject(error));
  });
}

const operator = (): Record<string, string> => ({ Cookie: cookies.operate });
const say = ({ socket }: Opened, ...messages: unknown[]): void =>
  messages.forEach((message) => socket.send(JSON.stringify(message)));
const found = async (opened: Opened, type: LiveReport["type"]): Promise<LiveReport> => {
  await expect.poll(() => opened.reports.map((report) => report.type)).toContain(type);
  return opened.reports.find((report) => report.type === type)!;
};
async function begun(): Promise<Opened> {
  const opened = await open(operator());
  say(opened, { begin: {} });
  await found(opened, "begun");
  return opened;
}
/** The one job; what its run was asked. */
const state = (): readonly string[] => app.queue.list().map((job) => job.state);

describe("the WebSocket of live drawings", () => {
  it("is refused to whoever is not paired, before anything else is done", async () => {
    const wrong: Record<string, string>[] = [
      {},
      { Cookie: `plotwright_session=${"a".repeat(43)}` },
      { Authorization: `Bearer ${"a".repeat(43)}` },
    ];
    for (const headers of wrong) {
      const { total } = app.refusals;
      await expect(open(headers)).rejects.toThrow("403");
      expect(app.refusals.total).toBe(total + 1);
    }
    const key = { protocols: ["plotwright-live", `plotwright-key.${"a".repeat(43)}`] };
    await expect(open({}, key)).rejects.toThrow("403");
    expect(state()).toEqual([]);
  });

  it("is refused to pages of other sites with the operator's cookie, and by another name", async () => {
    for (const origin of ["https://evil.example", "null", "http://127.0.0.1:1", "https://art.example"]) {
      await expect(open({ ...operator(), Origin: origin })).rejects.toThrow("403");
    }
    await expect(open({ ...operator(), Host: "evil.example" })).rejects.toThrow("403");
    await expect(open({ ...operator(), Origin: app.url })).resolves.toBeDefined();
  });

  it("is refused to watchers and to those who only submit, and so is the request with lines", async () => {
    for (const Cookie of [cookies.watch, cookies.submit]) {
      await expect(open({ Cookie })).rejects.toThrow("403");
      const sent = await fetch(`${app.url}/api/v1/plotters/virtual/live`, {
        method: "POST",
        body: "1 1\n",
        headers: { Cookie },
      });
      expect(sent.status).toBe(403);
    }
    expect(state()).toEqual([]);
  });

  it("is the only upgrade: no other path, protocol or method has one", async () => {
    for (const path of ["/", "/api/v1/events", "/api/v1/plotters/virtual", "/api/v1/plotters/a/b/live"]) {
      await expect(open(operator(), { path })).rejects.toThrow("403");
    }
    await expect(open(operator(), { path: "/api/v1/plotters/virtual/live/" })).rejects.toThrow("403");
    const plain = await fetch(`${app.url}/api/v1/plotters/virtual/live`, { headers: operator() });
    expect(plain.status).toBe(400);
  });

  it("takes a key as one of its protocols, also from an allowed page of another site", async () => {
    const { secret } = app.access.createKey("drawer", "operate");
    const protocols = ["plotwright-live", `plotwright-key.${secret}`];
    const opened = await open({ Origin: "https://art.example" }, { protocols });
    expect(opened.socket.protocol).toBe("plotwright-live");
    const watcher = app.access.createKey("watcher", "watch").secret;
    await expect(open({}, { protocols: ["plotwright-live", `plotwright-key.${watcher}`] })).rejects.toThrow(
      "403",
    );
  });

  it("is closed when its session or key is revoked, and the job is paused", async () => {
    const { secret, entry } = app.access.createKey("drawer", "operate");
    const opened = await open({ Authorization: `Bearer ${secret}` });
    say(opened, { begin: {} });
    await found(opened, "begun");
    const run = await app.plotter.nextRun();
    say(opened, { lineTo: [10, 10] });
    await expect.poll(() => opened.reports.at(-1)).toMatchObject({ type: "progress", points: 1 });
    app.access.revoke(entry.id);
    await opened.closed;
    await expect.poll(state).toEqual(["paused"]);
    expect(run.asked).toEqual(["pause"]);
    expect(app.queue.list()[0].message).toMatch(/sender of this live drawing was lost/);
  });

  it("is closed after a message that is too large, damaged or not allowed, and the drawing goes no further", async () => {
    const damaged: (string | Buffer)[] = [
      "x".repeat(250_000),
      "not JSON",
      "{}",
      '{"lineTo":[1]}',
      '{"lineTo":[1e999,1]}',
      '{"lineTo":[1,2],"end":true}',
      `{"stroke":${JSON.stringify(Array(2_001).fill([1, 1]))}}`,
      '{"begin":{}}',
      Buffer.from([1, 2, 3]),
    ];
    for (const data of damaged) {
      const opened = await begun();
      const run = await app.plotter.nextRun();
      opened.socket.send(data);
      expect([1008, 1009]).toContain(await opened.closed);
      run.end({ kind: "done" });
      await expect.poll(() => app.queue.list().every((job) => job.state === "done")).toBe(true);
    }
  }, 60_000);

  it("is closed when a sender sends more points than there is room for, or floods it with messages", async () => {
    const tooMany = await begun();
    const run = await app.plotter.nextRun();
    const stroke = Array.from({ length: 2_000 }, (_, i) => [i / 100, 10]);
    for (let i = 0; i < 11; i++) say(tooMany, { stroke });
    expect(await tooMany.closed).toBe(1008);
    expect(tooMany.reports.at(-1)).toMatchObject({ type: "error", code: "too-large" });
    await expect.poll(() => run.asked).toEqual(["pause"]);
    run.end({ kind: "done" });
    await expect.poll(state).toEqual(["done"]);
    const flood = await begun();
    for (let i = 0; i < 5_000; i++) say(flood, { penUp: true });
    expect(await flood.closed).toBe(1008);
    expect(flood.reports.at(-1)).toMatchObject({ type: "error", code: "busy" });
  });

  it("has one live drawing on a plotter, and says to others what is being drawn", async () => {
    await begun();
    await app.plotter.nextRun();
    const second = await open(operator());
    say(second, { begin: { name: "Second" } });
    expect(await found(second, "error")).toMatchObject({
      code: "busy",
      message: expect.stringMatching(/"Live drawing" is being plotted/) as string,
    });
    expect(await second.closed).toBe(1008);
    expect(state()).toEqual(["plotting"]);
    const other = await open(operator(), { path: "/api/v1/plotters/none/live" });
    say(other, { begin: {} });
    expect(await found(other, "error")).toMatchObject({ code: "not-found" });
    const settings = { ...DEFAULT_PLOT_SETTINGS, pen: { upPct: 500 } };
    const odd = await open(operator());
    say(odd, { begin: { settings } });
    expect(await found(odd, "error")).toMatchObject({ code: "bad-setting" });
  });

  it("asks a browser for its turn as any change does", async () => {
    const browser = { ...operator(), "User-Agent": "Mozilla/5.0 Firefox/1" };
    const take = await fetch(`${app.url}/api/v1/operator/take`, { method: "POST", headers: browser });
    expect(take.status).toBe(200);
    const paired = await fetch(`${app.url}${app.access.pairingPath("operate")}`);
    const Cookie = (paired.headers.get("set-cookie") ?? "").split(";")[0];
    const other = await open({ ...browser, Cookie });
    expect(await found(other, "error")).toMatchObject({ code: "not-operator" });
    expect(await other.closed).toBe(1008);
  });
});

describe("a request with the lines of a live drawing", () => {
  /** Sends lines, with time between them. */
  function sending() {
    const { hostname, port } = new URL(app.url);
    const path = "/api/v1/plotters/virtual/live";
    const request = httpRequest({ hostname, port, path, method: "POST", headers: operator() });
    request.on("error", () => undefined);
    const answered = new Promise<number>((resolve) =>
      request.on("response", (response) => {
        response.resume();
        resolve(response.statusCode ?? 0);
      }),
    );
    return { request, answered };
  }

  it("may take longer than any other request, and is answered when all is drawn", async () => {
    await app.close();
    app = await startApp({ times: { connectionsCheckingInterval: 50 } });
    app.hurry(200, 300);
    const { request, answered } = sending();
    for (let i = 0; i < 8; i++) {
      request.write(`${10 + i} 10\n`);
      await new Promise((resolve) => setTimeout(resolve, 100));
    }
    const run = await app.plotter.nextRun();
    request.end();
    await expect.poll(() => run.start.live?.isEnded).toBe(true);
    expect(run.start.live?.pointCount).toBe(8);
    run.end({ kind: "done" });
    expect(await answered).toBe(200);
  });

  it("pauses the job when it breaks off, or has a line that is too long", async () => {
    for (const last of [null, "1".repeat(300_000)]) {
      const { request } = sending();
      request.write("10 10\n20 10\n");
      const run = await app.plotter.nextRun();
      await expect.poll(() => run.start.live?.pointCount).toBe(2);
      if (last === null) request.destroy();
      else request.write(last);
      await expect.poll(() => run.asked).toEqual(["pause"]);
      expect(app.queue.list()[0]).toMatchObject({
        state: "paused",
        message: expect.stringMatching(/sender of this live drawing was lost/) as string,
      });
      run.end({ kind: "done" });
      await expect.poll(() => state().every((one) => one === "done")).toBe(true);
    }
  });

  it("is answered when its job is cancelled, although more lines may come", async () => {
    const { request, answered } = sending();
    request.write("10 10\n20 10\n");
    const run = await app.plotter.nextRun();
    await expect.poll(() => run.start.live?.pointCount).toBe(2);
    app.queue.plots.cancel(app.queue.list()[0].id);
    expect(await answered).toBe(200);
    request.destroy();
  });

  it("is asked for by the network itself whether its sender is still there", async () => {
    const kept = vi.spyOn(Socket.prototype, "setKeepAlive");
    const { request } = sending();
    request.write("10 10\n");
    const run = await app.plotter.nextRun();
    await expect.poll(() => run.start.live?.pointCount).toBe(1);
    expect(kept.mock.calls).toContainEqual([true, 1_000]);
    kept.mockRestore();
    request.destroy();
    await expect.poll(() => run.asked).toEqual(["pause"]);
  });
});
