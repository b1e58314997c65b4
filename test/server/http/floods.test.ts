/**
 * Clients that send far more than they should: they cost little, can't empty the log, and never keep a paired device
 * from stopping the plot.
 */
import { connect } from "node:net";
import { request as httpRequest } from "node:http";
import { afterEach, beforeEach, describe, expect, it } from "vitest";
import { jobSchema, type Job } from "../../../src/schema/index.js";
import { startApp, type TestApp } from "../../support/servers/app.js";

const SVG = '<svg xmlns="http://www.w3.org/2000/svg"><path d="M0 0h10"/></svg>';
/** More than a minute's requests of one client. */
const FLOOD = 640;

let app: TestApp;
/** Headers of the operator, and of a watcher. */
let operator: Record<string, string>;
let watcher: Record<string, string>;
let job: Job;

beforeEach(async () => {
  app = await startApp({ trustsLoopback: false });
  operator = { Cookie: await pair("operate") };
  watcher = { Cookie: await pair("watch") };
  job = await addJob();
});
afterEach(() => app.close());

async function pair(role: "operate" | "watch"): Promise<string> {
  const response = await fetch(`${app.url}${app.access.pairingPath(role)}`);
  expect(response.status).toBe(200);
  return (response.headers.get("set-cookie") ?? "").split(";")[0] ?? "";
}

/** A job that plots. */
async function addJob(): Promise<Job> {
  const init = { method: "POST", headers: operator };
  const added = await fetch(`${app.url}/api/v1/jobs?name=a`, { ...init, body: SVG });
  const { id } = jobSchema.parse(await added.json());
  const started = await fetch(`${app.url}/api/v1/jobs/${id}/start`, init);
  return jobSchema.parse(await started.json());
}

/** On its own connection; fetch would choose the Host header itself. */
function statusOf(path: string, headers: Record<string, string>, method = "GET"): Promise<number> {
  const { hostname, port } = new URL(app.url);
  return new Promise((resolve, reject) => {
    const request = httpRequest({ hostname, port, path, method, headers, agent: false }, (response) => {
      response.resume().on("end", () => resolve(response.statusCode ?? 0));
    });
    request.on("error", reject).end();
  });
}

/** The statuses of many requests, some at a time. */
async function flood(path: string, headers: Record<string, string>, count = FLOOD): Promise<number[]> {
  const statuses: number[] = [];
  while (statuses.length < count) {
    const some = Array.from({ length: 40 }, () => statusOf(path, headers));
    statuses.push(...(await Promise.all(some)));
  }
  return statuses;
}

/** Writes requests without waiting for answers; resolves with what came until the connection was closed. */
function pipelined(count: number, headers: Record<string, string>, last = ""): Promise<string> {
  const { hostname, port } = new URL(app.url);
  const lines = Object.entries(headers).map(([name, value]) => `${name}: ${value}\r\n`);
  const one = `GET /api/v1/me HTTP/1.1\r\nHost: 127.0.0.1\r\n${lines.join("")}`;
  return new Promise((resolve) => {
    let text = "";
    const socket = connect(Number(port), hostname, () => {
      socket.write(`${one}\r\n`.repeat(count - 1) + `${one}${last}\r\n`);
    });
    socket.on("data", (chunk: Buffer) => (text += chunk.toString()));
    socket.on("error", () => undefined);
    socket.on("close", () => resolve(text));
  });
}
const answersIn = (text: string): string[] => text.match(/HTTP\/1\.1 \d+/g) ?? [];

describe("a connection with requests that do not wait for the answers", () => {
  it("is closed at the second request of an unknown client", async () => {
    const { total } = app.refusals;
    const text = await pipelined(2_000, {});
    expect(answersIn(text).length).toBeLessThanOrEqual(1);
    expect(app.refusals.total - total).toBe(1);
  });

  it("is answered in order for a paired device, one request at a time", async () => {
    const text = await pipelined(8, watcher, "Connection: close\r\n");
    expect(answersIn(text)).toEqual(Array(8).fill("HTTP/1.1 200"));
    expect(text.match(/"role":"watch"/g)).toHaveLength(8);
  });

  it("is closed for a paired device too when many requests wait", async () => {
    expect(answersIn(await pipelined(2_000, watcher)).length).toBeLessThanOrEqual(1);
    expect(await statusOf("/api/v1/me", watcher)).toBe(200);
  });

  it("is closed when an unknown client expects a special answer first", async () => {
    const text = await pipelined(500, { Expect: "something" });
    expect(answersIn(text).length).toBeLessThanOrEqual(1);
  });
});

describe("a flood of requests", () => {
  it("a flood from another site is limited, and takes nothing from the device in whose browser it runs", async () => {
    const own = await flood("/api/v1/state", { ...watcher, Origin: "https://evil.example" });
    expect([own.filter((status) => status === 403).length, own.at(-1)]).toEqual([600, 429]);
    expect(await statusOf("/api/v1/state", watcher)).toBe(200);
  });

  it("a flood to another host name is limited as well", async () => {
    const foreign = await flood("/", { Host: "evil.example" });
    expect([foreign.filter((status) => status === 403).length, foreign.at(-1)]).toEqual([600, 429]);
  });

  it("a flood of unknown clients leaves each device at that address its own requests, and its pairing", async () => {
    expect((await flood("/x.png", {})).at(-1)).toBe(429);
    expect(await statusOf("/api/v1/state", operator)).toBe(200);
    expect(await statusOf("/api/v1/state", watcher)).toBe(200);
    const fresh = await pair("watch");
    for (const path of ["/", "/api/v1/state", "/favicon.ico"]) {
      expect([path, await statusOf(path, { Cookie: fresh })]).not.toEqual([path, 429]);
    }
  });

  it("a flood of one device leaves the others their own requests, and all of them the stops", async () => {
    expect((await flood("/api/v1/state", watcher)).at(-1)).toBe(429);
    expect((await flood("/api/v1/state", operator)).at(-1)).toBe(429);
    const path = `/api/v1/jobs/${job.id}`;
    expect(await statusOf(`${path}/pause`, watcher, "POST")).toBe(200);
    expect(await statusOf(`${path}/emergency-stop`, operator, "POST")).toBe(200);
    expect(await statusOf(`${path}/cancel`, watcher, "POST")).toBe(200);
    expect(await statusOf(`${path}/resume`, operator, "POST")).toBe(429);
    await expect.poll(() => app.queue.get(job.id).state).toBe("cancelled");
    expect(await statusOf("/api/v1/plotters/virtual/stop", watcher, "POST")).toBe(200);
    expect(await statusOf("/api/v1/plotters/virtual/home", operator, "POST")).toBe(429);
    const evil = { ...watcher, Origin: "https://evil.example" };
    expect(await statusOf(`${path}/pause`, evil, "POST")).toBe(403);
  });

  it("fills the log with a few short lines and a count", async () => {
    app.logged.length = 0;
    await flood(`/api/v1/${"x".repeat(10_000)}`, {});
    app.refusals.close();
    expect(app.logged).toHaveLength(11);
    expect(Math.max(...app.logged.map(({ length }) => length))).toBeLessThan(200);
    expect(app.logged[0]).toMatch(/^refused GET \/api\/v1\/x+… from 127\.0\.0\.1: not paired$/);
    expect(app.logged[10]).toBe(`refused more requests: ${FLOOD - 10} from 127.0.0.1`);
  });
});
