/** Requests from the network: none is trusted because of its origin. */
import { once } from "node:events";
import { createServer, request as requestTo } from "node:http";
import type { AddressInfo } from "node:net";
import { afterEach, beforeEach, describe, expect, it } from "vitest";
import { Access } from "../../../server/security/access.js";
import { DEFAULT_PLOT_SETTINGS, accessEntrySchema, jobSchema, type Job } from "../../../src/schema/index.js";
import { startApp, type TestApp } from "../../support/servers/app.js";
import { EventStream } from "../../support/servers/event-stream.js";

const SVG = '<svg xmlns="http://www.w3.org/2000/svg"><path d="M0 0h10"/></svg>';
let app: TestApp;
beforeEach(async () => {
  app = await startApp({ trustsLoopback: false });
});
afterEach(() => app.close());

const call = (path: string, init: RequestInit = {}): Promise<Response> => fetch(`${app.url}${path}`, init);

/** Opens a pairing link as a phone does; returns the session's cookie. */
async function pair(role: "operate" | "watch"): Promise<string> {
  const response = await call(app.access.pairingPath(role));
  expect(response.status).toBe(200);
  const cookie = response.headers.get("set-cookie") ?? "";
  expect(cookie).toMatch(/HttpOnly/);
  expect(cookie).toMatch(/SameSite=Strict/);
  return cookie.split(";")[0] ?? "";
}
const as = (cookie: string, init: RequestInit = {}): RequestInit => ({
  ...init,
  headers: { ...init.headers, Cookie: cookie },
});

async function plotting(cookie: string): Promise<Job> {
  const added = await call("/api/v1/jobs?name=a", as(cookie, { method: "POST", body: SVG }));
  const job = jobSchema.parse(await added.json());
  await call(`/api/v1/jobs/${job.id}/start`, as(cookie, { method: "POST" }));
  return job;
}

describe("a server on the network", () => {
  it("refuses every path without a pairing, and says how to get one", async () => {
    for (const [method, path] of [
      ["GET", "/api/v1/state"],
      ["GET", "/api/v1/events"],
      ["GET", "/api/v1/me"],
      ["GET", "/api/v1/samples"],
      ["GET", "/api/v1/access"],
      ["POST", "/api/v1/jobs?name=a"],
      ["POST", "/api/v1/access/keys"],
      ["DELETE", "/api/v1/jobs/x"],
      ["GET", "/api/v1/../v1/state"],
      ["GET", "/API/v1/state"],
      ["GET", "/api//v1/state"],
    ] as const) {
      const response = await call(path, { method });
      expect([path, [403, 404].includes(response.status)]).toEqual([path, true]);
    }
    const refused = await call("/api/v1/state");
    expect(refused.status).toBe(403);
    expect(await refused.text()).toMatch(/Pair this device first/);
    expect(app.logged.some((line) => /^refused GET .*state from/.test(line))).toBe(true);
  });

  it("accepts a paired browser and refuses wrong, truncated and foreign secrets", async () => {
    const cookie = await pair("operate");
    expect((await call("/api/v1/me", as(cookie))).status).toBe(200);
    for (const wrong of [`${cookie}x`, cookie.slice(0, -1), "plotwright_session=", `other=${cookie}`]) {
      expect([wrong, (await call("/api/v1/state", as(wrong))).status]).toEqual([wrong, 403]);
    }
    for (const authorization of ["Bearer x", "Bearer undefined", `Bearer ${"a".repeat(43)}`, "Basic YTph"]) {
      const response = await call("/api/v1/state", { headers: { Authorization: authorization } });
      expect([authorization, response.status]).toEqual([authorization, 403]);
    }
    for (const token of ["", "x", app.access.pairingPath("operate").slice(12, -1)]) {
      expect((await call(`/pair?token=${token}`)).status).toBe(403);
    }
    expect((await call("/pair?token[]=a&token[]=b")).status).toBe(403);
  });

  it("lets a watcher see everything and stop, but change nothing", async () => {
    const operator = await pair("operate");
    const watcher = await pair("watch");
    const job = await plotting(operator);
    const run = await app.plotter.nextRun();
    const added = await call("/api/v1/jobs?name=b", as(operator, { method: "POST", body: SVG }));
    const waiting = jobSchema.parse(await added.json());
    expect((await call("/api/v1/state", as(watcher))).status).toBe(200);
    const events = await EventStream.open(app.url, { Cookie: watcher });
    await events.find("snapshot");
    events.close();
    for (const [method, path] of [
      ["POST", "/api/v1/jobs?name=b"],
      ["POST", `/api/v1/jobs/${waiting.id}/cancel`],
      ["POST", `/api/v1/jobs/${job.id}/resume`],
      ["PATCH", `/api/v1/jobs/${job.id}`],
      ["DELETE", `/api/v1/jobs/${job.id}`],
      ["POST", `/api/v1/jobs/${job.id}/pause/../resume`],
      ["POST", "/api/v1/plotters/virtual/home"],
      ["GET", "/api/v1/access"],
      ["GET", "/api/v1/webhooks"],
      ["GET", "/api/v1/logs"],
      ["POST", "/api/v1/operator/take"],
      ["POST", "/api/v1/access/keys"],
    ] as const) {
      expect([path, (await call(path, as(watcher, { method }))).status]).toEqual([path, 403]);
    }
    expect(run.asked).toEqual([]);
    expect((await call(`/api/v1/jobs/${job.id}/pause`, as(watcher, { method: "POST" }))).status).toBe(200);
    expect((await call(`/api/v1/jobs/${job.id}/cancel`, as(watcher, { method: "POST" }))).status).toBe(200);
    expect(run.asked).toEqual(["pause", "cancel"]);
  });

  it("makes keys for scripts, shows their secret once, and revokes them at once", async () => {
    const operator = await pair("operate");
    const made = await call(
      "/api/v1/access/keys",
      as(operator, {
        method: "POST",
        body: JSON.stringify({ name: "cron", role: "operate" }),
        headers: { "Content-Type": "application/json" },
      }),
    );
    const { entry, secret } = (await made.json()) as { entry: unknown; secret: string };
    const key = accessEntrySchema.parse(entry);
    const withKey: RequestInit = { headers: { Authorization: `Bearer ${secret}` } };
    expect((await call("/api/v1/state", withKey)).status).toBe(200);
    const listed = await (await call("/api/v1/access", as(operator))).text();
    expect(listed).not.toContain(secret);
    expect(listed).not.toMatch(/sha256/i);
    const events = await EventStream.open(app.url, { Authorization: `Bearer ${secret}` });
    await events.find("snapshot");
    expect((await call(`/api/v1/access/${key.id}`, as(operator, { method: "DELETE" }))).status).toBe(200);
    await events.ended;
    expect((await call("/api/v1/state", withKey)).status).toBe(403);
    expect((await call("/api/v1/state", as(operator))).status).toBe(200);
  });

  it("keeps sessions over a restart, as hashes only", async () => {
    const cookie = await pair("operate");
    const secret = cookie.split("=")[1] ?? "";
    const again = new Access(app.store);
    expect(again.roleOf(secret)).toBe("operate");
    expect(JSON.stringify(app.store.setting("access"))).not.toContain(secret);
    expect(again.pairingPath("operate")).not.toBe(app.access.pairingPath("operate"));
  });

  it("ends a session 90 days after its pairing, also after a restart, and no key", async () => {
    let at = Date.parse("2026-01-01T00:00:00Z");
    const access = new Access(app.store, { now: () => new Date(at) });
    const token = new URLSearchParams(access.pairingPath("operate").split("?")[1]).get("token") ?? "";
    const session = access.pair(token, "phone", null);
    const key = access.createKey("script", "operate").secret;
    at += 89 * 86_400_000;
    expect([access.roleOf(session), access.list().length]).toEqual(["operate", 2]);
    at += 2 * 86_400_000;
    for (const one of [access, new Access(app.store, { now: () => new Date(at) })]) {
      expect([one.roleOf(session), one.roleOf(key)]).toEqual([null, "operate"]);
      expect(one.list().map(({ kind }) => kind)).toEqual(["key"]);
    }
    access.createKey("other", "watch");
    expect(JSON.stringify(app.store.setting("access"))).not.toContain("phone");
  });

  it("ends only the streams of a removed device, and replaces the pairing links", async () => {
    const removedLink = app.access.pairingPath("watch");
    const [operator, removed, other] = [await pair("operate"), await pair("watch"), await pair("watch")];
    const [ended, kept] = [
      await EventStream.open(app.url, { Cookie: removed }),
      await EventStream.open(app.url, { Cookie: other }),
    ];
    let isKept = true;
    void kept.ended.then(() => (isKept = false));
    const [, { id = "" } = {}] = app.access.list();
    expect((await call(`/api/v1/access/${id}`, as(operator, { method: "DELETE" }))).status).toBe(200);
    await ended.ended;
    expect((await call(removedLink)).status).toBe(403);
    expect((await call("/api/v1/state", as(removed))).status).toBe(403);
    for (const cookie of [operator, other]) {
      expect((await call("/api/v1/state", as(cookie))).status).toBe(200);
    }
    expect(isKept).toBe(true);
    kept.close();
    expect((await call("/api/v1/state", as(await pair("watch")))).status).toBe(200);
  });

  it("keeps the pairing links when a key is revoked, because keys do not come from them", () => {
    const link = app.access.pairingPath("operate");
    app.access.revoke(app.access.createKey("cron", "operate").entry.id);
    expect(app.access.pairingPath("operate")).toBe(link);
  });

  it("has one session for each device: pairing again replaces the first, with either role", async () => {
    const first = await pair("operate");
    const again = await call(app.access.pairingPath("watch"), as(first));
    const second = (again.headers.get("set-cookie") ?? "").split(";")[0] ?? "";
    expect(app.access.list().map(({ role }) => role)).toEqual(["watch"]);
    expect((await call("/api/v1/state", as(first))).status).toBe(403);
    expect((await call("/api/v1/state", as(second))).status).toBe(200);
  });

  it("ends the session that was unused longest when there are too many, of the same role only", () => {
    let at = Date.parse("2026-01-01T00:00:00Z");
    const access = new Access(app.store, { now: () => new Date((at += 1_000)) });
    const pairNow = (role: "operate" | "watch"): string =>
      access.pair(access.pairingPath(role).split("=")[1] ?? "", "phone", null);
    const ended: string[] = [];
    access.onRevoke((id) => ended.push(id));
    const operator = pairNow("operate");
    const key = access.createKey("script", "watch").secret;
    const watchers = Array.from({ length: 100 }, () => pairNow("watch"));
    at += 3_600_000;
    expect(access.roleOf(watchers[0] ?? "")).toBe("watch");
    expect(ended).toEqual([]);
    const second = access.entryOf(watchers[1] ?? "")?.id;
    at += 3_600_000;
    expect(access.roleOf(watchers[0] ?? "")).toBe("watch");
    for (let more = 0; more < 99; more++) pairNow("watch");
    expect(ended).toHaveLength(99);
    expect(ended.at(-1)).toBe(second);
    expect([watchers[0] ?? "", watchers[50] ?? "", operator, key].map((one) => access.roleOf(one))).toEqual([
      "watch",
      null,
      "operate",
      "watch",
    ]);
    expect(access.list()).toHaveLength(102);
    expect(() => Array.from({ length: 100 }, () => access.createKey("more", "watch"))).toThrow("100 keys");
  });

  it("refuses a foreign page even with the browser's cookie, and the plot continues", async () => {
    const operator = await pair("operate");
    const job = await plotting(operator);
    const run = await app.plotter.nextRun();
    for (const headers of [
      { Origin: "https://evil.example" },
      { Origin: "null" },
      { "Sec-Fetch-Site": "cross-site" },
    ] as Record<string, string>[]) {
      const init = as(operator, { method: "POST", headers });
      expect((await call(`/api/v1/jobs/${job.id}/cancel`, init)).status).toBe(403);
    }
    expect(run.asked).toEqual([]);
    expect(app.queue.get(job.id).state).toBe("plotting");
  });

  it("accepts a page through a development server that adds a key and keeps the browser's Host, and no other", async () => {
    const { secret } = app.access.createKey("sketch", "operate");
    const { hostname, port } = new URL(app.url);
    let keepsHost = true;
    const forwarder = createServer((request, response) => {
      const headers = { ...request.headers, authorization: `Bearer ${secret}` };
      if (!keepsHost) headers.host = `${hostname}:${port}`;
      const { url: path, method } = request;
      const onward = requestTo({ hostname, port, path, method, headers }, (answer) => {
        response.writeHead(answer.statusCode ?? 500);
        answer.pipe(response);
      });
      request.pipe(onward);
    }).listen(0, "127.0.0.1");
    await once(forwarder, "listening");
    const page = `http://127.0.0.1:${(forwarder.address() as AddressInfo).port}`;
    const send = (origin: string): Promise<Response> =>
      fetch(`${page}/api/v1/jobs?name=a`, { method: "POST", body: SVG, headers: { Origin: origin } });
    expect((await send(page)).status).toBe(201);
    expect((await send("https://editor.example")).status).toBe(403);
    keepsHost = false;
    expect((await send(page)).status).toBe(403);
    forwarder.closeAllConnections();
    forwarder.close();
  });

  it("returns names and drawings as data only, whatever they contain", async () => {
    const operator = await pair("operate");
    const evil = '<img src=x onerror=alert(1)>"</script>';
    const body = JSON.stringify({
      name: evil,
      drawing: `<svg onload="alert(1)">${SVG}</svg>`,
      settings: DEFAULT_PLOT_SETTINGS,
    });
    const headers = { "Content-Type": "application/json" };
    const added = await call("/api/v1/jobs", as(operator, { method: "POST", body, headers }));
    const { id, name } = jobSchema.parse(await added.json());
    expect(name).toBe(evil);
    const drawing = await call(`/api/v1/jobs/${id}/drawing`, as(operator));
    expect(drawing.headers.get("content-type")).toMatch(/^text\/plain/);
    expect(drawing.headers.get("content-disposition")).toMatch(/^attachment/);
    expect(drawing.headers.get("x-content-type-options")).toBe("nosniff");
    const state = await call("/api/v1/state", as(operator));
    expect(state.headers.get("content-type")).toMatch(/^application\/json/);
  });

  it("does not count the page's files among the 600 requests a minute", async () => {
    // As of seven browsers behind one proxy that open the page for the first time.
    for (let visit = 0; visit < 7; visit++) {
      const files = Array.from({ length: 100 }, (_, k) => call(`/assets/part-${k}.js`));
      for (const { status } of await Promise.all(files)) expect(status).not.toBe(429);
    }
    const left = (await call("/")).headers.get("ratelimit");
    expect(left).toMatch(/r=599;/);
    const asked = await Promise.all(Array.from({ length: 600 }, () => call("/api/v1/state")));
    expect(asked.filter(({ status }) => status === 429)).toHaveLength(1);
  });

  it("blocks an address that guesses pairing links", async () => {
    const answers: number[] = [];
    const spellings = ["/pair", "/pair/", "/PAIR"];
    for (let guess = 0; guess < 13; guess++) {
      answers.push((await call(`${spellings[guess % 3]}?token=guess${guess}`)).status);
    }
    expect(answers.slice(0, 10)).toEqual(Array(10).fill(403));
    expect(answers.slice(10)).toEqual([429, 429, 429]);
    expect((await call(app.access.pairingPath("operate"))).status).toBe(429);
  });
});

describe("a key on the server's own computer", () => {
  it("has the rights that it has elsewhere, but a wrong one leaves those of the computer", async () => {
    const local = await startApp();
    const roleOf = async (secret: string): Promise<unknown> => {
      const headers = { Authorization: `Bearer ${secret}` };
      const me = (await (await fetch(`${local.url}/api/v1/me`, { headers })).json()) as { role?: unknown };
      return me.role;
    };
    const statusOf = async (secret: string): Promise<number> => {
      const headers = { Authorization: `Bearer ${secret}` };
      const url = `${local.url}/api/v1/plotters/virtual/motors-off`;
      return (await fetch(url, { method: "POST", headers })).status;
    };
    try {
      for (const [role, status] of [
        ["operate", 200],
        ["submit", 403],
        ["watch", 403],
      ] as const) {
        const { secret } = local.access.createKey(role, role);
        expect([await roleOf(secret), await statusOf(secret)]).toEqual([role, status]);
      }
      // As it is in the environment of somebody who also has a server elsewhere.
      expect([await roleOf("a".repeat(43)), await statusOf("a".repeat(43))]).toEqual(["operate", 200]);
    } finally {
      await local.close();
    }
  });
});
