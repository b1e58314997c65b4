/** Even if others hold connections open, a client that may stop the plot must always get one. */
import { once } from "node:events";
import { request as httpRequest } from "node:http";
import { connect, type Socket } from "node:net";
import { afterEach, beforeEach, describe, expect, it } from "vitest";
import { jobSchema, type Job } from "../../../src/schema/index.js";
import { startApp, type TestApp } from "../../support/servers/app.js";

const SVG = '<svg xmlns="http://www.w3.org/2000/svg"><path d="M0 0h10"/></svg>';
const COUNT = 1_000;

let app: TestApp;
let cookie: string;
let job: Job;
const held: Socket[] = [];

beforeEach(async () => {
  app = await startApp({ trustsLoopback: false });
  const paired = await fetch(`${app.url}${app.access.pairingPath("operate")}`);
  cookie = (paired.headers.get("set-cookie") ?? "").split(";")[0] ?? "";
  const added = await post("/jobs?name=a", SVG);
  job = jobSchema.parse(JSON.parse(added.text));
  await post(`/jobs/${job.id}/start`);
  await app.plotter.nextRun();
});
afterEach(async () => {
  held.splice(0).forEach((socket) => socket.destroy());
  await app.close();
});

interface Answer {
  readonly status: number;
  readonly connection: string | undefined;
  readonly text: string;
}

/** On its own connection, as the paired device by default. */
function send(path: string, method: string, headers: Record<string, string>, body = ""): Promise<Answer> {
  const { hostname, port } = new URL(app.url);
  return new Promise((resolve, reject) => {
    const request = httpRequest(
      { hostname, port, path, method, headers, agent: false, timeout: 20_000 },
      (response) => {
        let text = "";
        response.on("data", (chunk: Buffer) => (text += chunk.toString()));
        response.on("end", () =>
          resolve({ status: response.statusCode ?? 0, connection: response.headers.connection, text }),
        );
      },
    );
    request.on("timeout", () => request.destroy(new Error("no answer within 20 s")));
    request.on("error", reject);
    request.end(body);
  });
}
const post = (path: string, body = ""): Promise<Answer> =>
  send(`/api/v1${path}`, "POST", { Cookie: cookie }, body);

/** Opens connections from an address and holds them as long as the server does. */
async function hold(count: number, localAddress: string, text: string): Promise<void> {
  const { hostname, port } = new URL(app.url);
  for (let i = 0; i < count; i++) {
    const socket = connect({ host: hostname, port: Number(port), localAddress });
    socket.on("error", () => undefined).resume();
    held.push(socket);
    await Promise.race([once(socket, "connect"), once(socket, "close")]);
    if (text !== "") socket.write(text);
  }
}
const open = (): number => held.filter((socket) => !socket.destroyed && socket.readyState === "open").length;

describe("while a stranger holds a thousand connections", () => {
  const refused = "GET /api/v1/state HTTP/1.1\r\nHost: 127.0.0.1\r\n\r\n";
  const page = "GET / HTTP/1.1\r\nHost: 127.0.0.1\r\n\r\n";
  for (const [what, text] of [
    ["that were refused", refused],
    ["that ask for the page", page],
    ["that send nothing", ""],
    [
      "that never end their request",
      "POST /api/v1/jobs HTTP/1.1\r\nHost: 127.0.0.1\r\nContent-Length: 9\r\n",
    ],
  ] as const) {
    it(`${what}, an emergency stop is answered`, async () => {
      await hold(COUNT, "127.0.0.2", text);
      const answer = await post(`/jobs/${job.id}/emergency-stop`);
      expect([answer.status, jobSchema.parse(JSON.parse(answer.text)).state]).toEqual([200, "paused"]);
      await expect.poll(open).toBeLessThanOrEqual(60);
    });
  }

  it("an emergency stop is answered, and a connection of a paired device stays open, while strangers at many addresses hold a thousand connections", async () => {
    const watching = httpRequest(`${app.url}/api/v1/events`, { headers: { Cookie: cookie }, agent: false });
    watching.end();
    const [stream] = (await once(watching, "response")) as [NodeJS.ReadableStream];
    let isCut = false;
    stream.on("close", () => (isCut = true)).resume();
    for (let i = 0; i < 25; i++) await hold(COUNT / 25, `127.0.1.${i + 1}`, "");
    expect((await post(`/jobs/${job.id}/emergency-stop`)).status).toBe(200);
    await expect.poll(open).toBeLessThanOrEqual(300);
    expect(isCut).toBe(false);
    watching.destroy();
  });
});

describe("while a paired watcher holds a thousand connections", () => {
  const events = (secret: string): string =>
    `GET /api/v1/events HTTP/1.1\r\nHost: 127.0.0.1\r\nAuthorization: Bearer ${secret}\r\n\r\n`;

  it("it keeps a few, and an emergency stop is answered", async () => {
    const { secret } = app.access.createKey("wall", "watch");
    await hold(COUNT, "127.0.0.2", events(secret));
    expect((await post(`/jobs/${job.id}/emergency-stop`)).status).toBe(200);
    await expect.poll(open).toBeLessThanOrEqual(50);
  });

  it("watchers with many keys together keep their share of connections, and an emergency stop is answered", async () => {
    for (let i = 0; i < 20; i++) {
      const { secret } = app.access.createKey(`wall ${i}`, "watch");
      await hold(COUNT / 20, `127.0.0.${i + 2}`, events(secret));
    }
    expect((await post(`/jobs/${job.id}/emergency-stop`)).status).toBe(200);
    await expect.poll(open).toBeLessThanOrEqual(300);
  });

  it("a device whose connections were closed gets a new one at once", async () => {
    const { secret } = app.access.createKey("wall", "watch");
    await hold(200, "127.0.0.2", events(secret));
    const headers = { Authorization: `Bearer ${secret}` };
    expect((await send(`/api/v1/jobs/${job.id}/pause`, "POST", headers)).status).toBe(200);
  });
});

describe("a connection", () => {
  it("ends with the answer for a stranger, and stays open for a paired device", async () => {
    const stranger = await send("/api/v1/state", "GET", { Connection: "keep-alive" });
    expect([stranger.status, stranger.connection]).toEqual([403, "close"]);
    const paired = await send("/api/v1/state", "GET", { Connection: "keep-alive", Cookie: cookie });
    expect([paired.status, paired.connection]).toEqual([200, "keep-alive"]);
  });
});
