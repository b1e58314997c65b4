/**
 * Attacks from others while a plot runs. Each attempt is refused and logged, and the plot continues: its run
 * gets no request, and its progress still reaches the browsers.
 */
import { readFileSync } from "node:fs";
import { request as httpRequest } from "node:http";
import { request as httpsRequest } from "node:https";
import { connect } from "node:net";
import { afterEach, beforeEach, describe, expect, it } from "vitest";
import { createServer } from "../../../server/index.js";
import { DEFAULT_PLOT_SETTINGS, jobSchema, pairingSchema, type Job } from "../../../src/schema/index.js";
import { startApp, type TestApp } from "../../support/servers/app.js";
import { EventStream } from "../../support/servers/event-stream.js";
import type { LedRun } from "../../support/jobs/led-plotter.js";
import { folderOfTest } from "../../support/processes/folders.js";

const SVG = '<svg xmlns="http://www.w3.org/2000/svg"><path d="M0 0h10"/></svg>';
const TLS = {
  cert: readFileSync(new URL("../../fixtures/tls/cert.pem", import.meta.url), "utf8"),
  key: readFileSync(new URL("../../fixtures/tls/key.pem", import.meta.url), "utf8"),
};

interface Answer {
  readonly status: number;
  readonly text: string;
}

let app: TestApp;
let cookie: string;
let job: Job;
let run: LedRun;
let events: EventStream;
let elapsedS: number;

beforeEach(() => begin());
afterEach(() => end());

/** A server with a running plot, and its operator's cookie. */
async function begin(options: Parameters<typeof startApp>[0] = {}): Promise<void> {
  app = await startApp({ trustsLoopback: false, ...options });
  const paired = await fetch(`${app.url}${app.access.pairingPath("operate")}`);
  cookie = (paired.headers.get("set-cookie") ?? "").split(";")[0] ?? "";
  const added = await fetch(`${app.url}/api/v1/jobs?name=a`, {
    method: "POST",
    body: SVG,
    headers: { Cookie: cookie },
  });
  job = jobSchema.parse(await added.json());
  events = await EventStream.open(app.url, { Cookie: cookie });
  await fetch(`${app.url}/api/v1/jobs/${job.id}/start`, { method: "POST", headers: { Cookie: cookie } });
  run = await app.plotter.nextRun();
  await events.find("job", ({ job: { state } }) => state === "plotting");
  elapsedS = 0;
  app.logged.length = 0;
}
async function end(): Promise<void> {
  events.close();
  await app.close();
}

/** Sent unchanged: fetch would normalise paths, and set some headers itself. */
function raw(
  path: string,
  {
    method = "GET",
    headers = {},
    body = "",
  }: { method?: string; headers?: Record<string, string>; body?: string } = {},
): Promise<Answer> {
  const { hostname, port } = new URL(app.url);
  return new Promise((resolve, reject) => {
    const request = httpRequest({ hostname, port, path, method, headers }, (response) => {
      let text = "";
      response.on("data", (chunk: Buffer) => (text += chunk.toString()));
      response.on("end", () => resolve({ status: response.statusCode ?? 0, text }));
    });
    request.on("error", reject);
    request.end(body);
  });
}

/** Writes bytes, and returns what came until the server closed the connection. */
function overSocket(
  first: string,
  then: (write: (text: string) => void) => void = () => undefined,
): Promise<string> {
  const { hostname, port } = new URL(app.url);
  return new Promise((resolve) => {
    let text = "";
    const socket = connect(Number(port), hostname, () => {
      socket.write(first);
      then((more) => void socket.write(more));
    });
    socket.on("data", (chunk: Buffer) => (text += chunk.toString()));
    socket.on("error", () => undefined);
    socket.on("close", () => resolve(text));
  });
}

async function plotGoesOn(): Promise<void> {
  expect(run.asked).toEqual([]);
  expect(app.plotter.asked).toEqual([]);
  expect(app.queue.list().map(({ id, state }) => [id, state])).toEqual([[job.id, "plotting"]]);
  elapsedS++;
  run.progress({
    progress: elapsedS / 100,
    elapsedS,
    remainingS: 9,
    planS: 1,
    xMm: 1,
    yMm: 1,
    penUp: false,
    penMoving: false,
  });
  await events.find("progress", (event) => event.elapsedS === elapsedS);
}
/** Refused with one of the statuses, and counted for the log. */
async function refused(
  what: string,
  attempt: Promise<Answer>,
  statuses: readonly number[] = [403],
): Promise<Answer> {
  const { total } = app.refusals;
  const answer = await attempt;
  expect([what, statuses.includes(answer.status), answer.status]).toEqual([what, true, answer.status]);
  expect([what, app.refusals.total]).toEqual([what, total + 1]);
  await plotGoesOn();
  return answer;
}

describe("while a plot runs", () => {
  it("a client without a token, or with a wrong one, changes and sees nothing", async () => {
    const secrets: Record<string, string>[] = [
      {},
      { Cookie: "plotwright_session=" },
      { Cookie: `plotwright_session=${"a".repeat(43)}` },
      { Cookie: cookie.slice(0, -1) },
      { Authorization: `Bearer ${"a".repeat(43)}` },
      { Authorization: `Bearer ${cookie.split("=")[1]?.slice(1) ?? ""}` },
      { Authorization: "Basic YWRtaW46YWRtaW4=" },
      { "X-Forwarded-For": "127.0.0.1" },
      { Forwarded: "for=127.0.0.1" },
    ];
    for (const headers of secrets) {
      for (const [method, path] of [
        ["GET", "/api/v1/state"],
        ["GET", "/api/v1/logs"],
        ["POST", `/api/v1/jobs/${job.id}/cancel`],
        ["POST", "/api/v1/pairing"],
        ["POST", "/api/v1/operator/take"],
      ] as const) {
        await refused(`${method} ${path} ${JSON.stringify(headers)}`, raw(path, { method, headers }));
      }
    }
    await refused("pairing", raw("/pair?token=guess"));
  });

  it("a page of another site changes nothing with the operator's own cookie (CSRF), by any kind of request", async () => {
    const forms = [
      { "Content-Type": "text/plain" },
      { "Content-Type": "application/x-www-form-urlencoded" },
      { "Content-Type": "multipart/form-data; boundary=x" },
      { "Content-Type": "application/json" },
    ];
    for (const origin of [
      "https://evil.example",
      "null",
      "http://127.0.0.1:1",
      "http://localhost.evil.example",
    ]) {
      for (const form of forms) {
        const headers = { Cookie: cookie, Origin: origin, ...form };
        for (const path of [`/api/v1/jobs/${job.id}/cancel`, "/api/v1/jobs?name=x", "/api/v1/access/keys"]) {
          await refused(`${origin} ${path}`, raw(path, { method: "POST", headers, body: "{}" }));
        }
      }
    }
    for (const site of ["cross-site", "same-site"]) {
      const headers = { Cookie: cookie, "Sec-Fetch-Site": site };
      await refused(site, raw("/api/v1/state", { headers }));
      await refused(site, raw(`/api/v1/jobs/${job.id}/cancel`, { method: "POST", headers }));
    }
    await refused(
      "preflight",
      raw("/api/v1/jobs", { method: "OPTIONS", headers: { Origin: "https://evil.example" } }),
    );
  });

  it("another site's name is refused (rebinding), on any path", async () => {
    for (const host of [
      "evil.example",
      "127.0.0.1.evil.example",
      "localhost.evil.example:80",
      "plotwright.local.evil",
    ]) {
      for (const path of ["/", "/api/v1/state", "/api/v1/events", "/pair?token=x"]) {
        await refused(`${host} ${path}`, raw(path, { headers: { Host: host, Cookie: cookie } }));
      }
    }
  });

  it("only the server's own name on the network is accepted", async () => {
    const headers = { Host: "plotwright-2.local:9080", Cookie: cookie };
    expect((await raw("/api/v1/state", { headers })).status).toBe(200);
  });

  it("a WebSocket is not opened, with any origin or none", async () => {
    for (const origin of ["Origin: https://evil.example\r\n", ""]) {
      const lines = `GET /api/v1/events HTTP/1.1\r\nHost: 127.0.0.1\r\nCookie: ${cookie}\r\n${origin}Connection: Upgrade\r\nUpgrade: websocket\r\nSec-WebSocket-Version: 13\r\nSec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n\r\n`;
      await refused(
        "upgrade",
        overSocket(lines).then((text) => ({ status: Number(text.slice(9, 12)), text })),
      );
    }
  });

  it("a connection that is reset during the refusal of an upgrade does not end the server", async () => {
    const faults: Error[] = [];
    const note = (error: Error): void => void faults.push(error);
    process.on("uncaughtException", note);
    const { hostname, port } = new URL(app.url);
    const lines = "GET / HTTP/1.1\r\nHost: x\r\nConnection: Upgrade\r\nUpgrade: x\r\n\r\n";
    const count = 20;
    const { total } = app.refusals;
    for (let index = 0; index < count; index++) {
      const socket = connect(Number(port), hostname, () =>
        socket.write(lines, () => socket.resetAndDestroy()),
      );
      await new Promise((resolve) => socket.on("close", resolve));
    }
    await expect.poll(() => app.refusals.total).toBe(total + count);
    await plotGoesOn();
    process.off("uncaughtException", note);
    expect(faults).toEqual([]);
  });

  it("no path leads out of the server's folders", async () => {
    const climbs = [
      "/../../../../etc/passwd",
      "/assets/../../../../etc/passwd",
      "/assets/..%2f..%2f..%2f..%2fetc%2fpasswd",
      "/assets/%2e%2e/%2e%2e/package.json",
      "/..%5c..%5cetc%5cpasswd",
      "/%252e%252e%252f%252e%252e%252fetc%252fpasswd",
      "/api/v1/samples/..%2f..%2fpackage.json",
      "/api/v1/samples/..%00.svg",
      `/api/v1/jobs/..%2f..%2f..%2fetc%2fpasswd/drawing`,
      "/api/v1/jobs/../access",
    ];
    for (const path of climbs) {
      const { text } = await refused(path, raw(path, { headers: { Cookie: cookie } }), [400, 403, 404]);
      expect(text).not.toMatch(/root:|"dependencies"|entries/);
    }
    const machine = { method: "PUT", headers: { Cookie: cookie, "Content-Type": "application/json" } };
    await refused("machine", raw("/api/v1/machines/..%2f..%2fserver", { ...machine, body: "{}" }), [404]);
  });

  it("an upload is limited in size and time", async () => {
    const headers = { Cookie: cookie };
    const large = "x".repeat(3_100_000);
    await refused("file", raw("/api/v1/jobs?name=x", { method: "POST", headers, body: large }), [413]);
    const json = { method: "POST", headers: { ...headers, "Content-Type": "application/json" } };
    await refused("json", raw("/api/v1/jobs", { ...json, body: JSON.stringify({ drawing: large }) }), [413]);
    await refused(
      "patch",
      raw(`/api/v1/jobs/${job.id}`, { ...json, method: "PATCH", body: `"${large}"` }),
      [413],
    );
    await end();
    await begin({ times: { connectionsCheckingInterval: 100 } });
    app.hurry(1_500, 2_500);
    const status = (text: string): Answer => ({ status: Number(text.slice(9, 12)), text });
    const slowHead = `POST /api/v1/jobs HTTP/1.1\r\nHost: 127.0.0.1\r\nCookie: ${cookie}\r\n`;
    await refused("slow headers", overSocket(slowHead).then(status), [408]);
    const slowBody = `${slowHead}Content-Length: 1000\r\n\r\n<svg`;
    await refused("slow body", overSocket(slowBody, (write) => write(" ")).then(status), [408]);
    await expect.poll(() => app.drawingsOnDisk()).toHaveLength(1);
  });

  it("scripts in drawings and names are returned as data only, under a policy that runs none", async () => {
    const evil = '"><script>alert(1)</script><img src=x onerror=alert(1)>';
    const drawing = `<svg xmlns="http://www.w3.org/2000/svg" onload="alert(1)"><script>alert(1)</script><g id="${"&lt;script&gt;"}"><path d="M0 0h10"/></g></svg>`;
    const settings = {
      ...DEFAULT_PLOT_SETTINGS,
      prepare: { ...DEFAULT_PLOT_SETTINGS.prepare, hiddenLayers: [evil], layerOrder: [evil] },
    };
    const headers = { Cookie: cookie, "Content-Type": "application/json" };
    const body = JSON.stringify({ name: evil, drawing, settings });
    const added = await fetch(`${app.url}/api/v1/jobs`, { method: "POST", headers, body });
    const { id } = jobSchema.parse(await added.json());
    for (const [path, type] of [
      [`/api/v1/jobs/${id}/drawing`, "text/plain"],
      [`/api/v1/jobs/${id}`, "application/json"],
      ["/api/v1/state", "application/json"],
      ["/api/v1/logs", "text/plain"],
      [`/api/v1/jobs/${encodeURIComponent(evil)}`, "application/json"],
    ] as const) {
      const response = await fetch(`${app.url}${path}`, { headers: { Cookie: cookie } });
      expect([path, response.headers.get("content-type")?.split(";")[0]]).toEqual([path, type]);
      expect(response.headers.get("x-content-type-options")).toBe("nosniff");
      const policy = response.headers.get("content-security-policy") ?? "";
      expect(policy).toContain("script-src 'self';");
      expect(policy).toContain("default-src 'self'");
      await response.text();
    }
    const saved = await fetch(`${app.url}/api/v1/jobs/${id}/drawing`, { headers: { Cookie: cookie } });
    const disposition = saved.headers.get("content-disposition") ?? "";
    expect(disposition).toMatch(/^attachment; filename=/);
    expect(disposition).not.toMatch(/[<>\r\n]/);
    app.queue.plots.cancel(id);
    await app.queue.remove(id);
    await plotGoesOn();
  });
});

describe("a server with a certificate", () => {
  it("speaks TLS, marks its cookies for it, and refuses foreign pages as before", async () => {
    await app.close();
    app = await startApp({ trustsLoopback: false, tls: TLS });
    const { port } = new URL(app.url);
    const get = (
      path: string,
      headers: Record<string, string> = {},
    ): Promise<{ status: number; cookie: string }> =>
      new Promise((resolve, reject) => {
        const request = httpsRequest(
          { hostname: "127.0.0.1", port, path, headers, ca: TLS.cert },
          (response) => {
            response.resume();
            resolve({ status: response.statusCode ?? 0, cookie: response.headers["set-cookie"]?.[0] ?? "" });
          },
        );
        request.on("error", reject);
        request.end();
      });
    const paired = await get(app.access.pairingPath("operate"));
    expect(paired.status).toBe(200);
    expect(paired.cookie).toMatch(/; Secure/);
    const session = paired.cookie.split(";")[0] ?? "";
    expect((await get("/api/v1/state", { Cookie: session })).status).toBe(200);
    expect((await get("/api/v1/state")).status).toBe(403);
    const own = { Cookie: session, Origin: `https://127.0.0.1:${port}` };
    expect((await get("/api/v1/state", own)).status).toBe(200);
    expect((await get("/api/v1/state", { ...own, Origin: "https://evil.example" })).status).toBe(403);
    // Without TLS there is no such header.
    await expect(fetch(`http://127.0.0.1:${port}/api/v1/state`)).rejects.toThrow();
  });

  it("explains what is wrong with a certificate that can't be used", async () => {
    const dataDir = folderOfTest();
    const options = { port: 0, device: "virtual", dataDir };
    await expect(createServer({ ...options, tls: { cert: "x", key: "y" } })).rejects.toThrow(
      "The certificate or its key can't be used",
    );
  });
});

describe("pairing links", () => {
  it("are shown on the server's own computer, with QR codes", async () => {
    await app.close();
    app = await startApp();
    const links = pairingSchema.parse(
      await (await fetch(`${app.url}/api/v1/pairing`, { method: "POST" })).json(),
    );
    expect(links.operateUrl).toMatch(/^http:\/\/192\.168\.1\.4:9080\/pair/);
    expect(links.watchUrl).not.toBe(links.operateUrl);
    expect(links.operateQrSvg).toMatch(/^<svg /);
    expect(links.operateQrSvg).not.toMatch(/script|onload/);
  });

  it("are shown to no other device, even one that may operate", async () => {
    await refused("pairing", raw("/api/v1/pairing", { method: "POST", headers: { Cookie: cookie } }));
  });
});
