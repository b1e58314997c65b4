/** Webhooks against a receiver with scripted answers. */
import { createHmac } from "node:crypto";
import { createServer, type IncomingHttpHeaders, type Server } from "node:http";
import type { AddressInfo } from "node:net";
import { afterEach, beforeEach, describe, expect, it, vi } from "vitest";
import { Webhooks, signatureOf } from "../../../../server/plugins/webhooks/webhooks.js";
import { WebhookStore } from "../../../../server/plugins/webhooks/webhook-store.js";
import { PlotwrightError } from "../../../../src/index.js";
import {
  DEFAULT_PLOT_SETTINGS,
  jobSchema,
  webhookMessageSchema,
  webhookSchema,
  type Job,
  type Webhook,
  type WebhookEvent,
  type WebhookMessage,
} from "../../../../src/schema/index.js";
import { makeJob } from "../../../support/jobs/jobs.js";
import type { LedRun } from "../../../support/jobs/led-plotter.js";
import { startApp, type TestApp } from "../../../support/servers/app.js";

const SVG = '<svg xmlns="http://www.w3.org/2000/svg"><path d="M0 0h10"/></svg>';

interface Received {
  readonly path: string;
  readonly headers: IncomingHttpHeaders;
  readonly body: string;
  readonly message: WebhookMessage;
}

let app: TestApp;
let receiver: Server;
let received: Received[];
/** Statuses of the next answers; 200 if there are none left. */
let answers: number[];
/** No server answers; the port stays reserved, because another program might take it. */
let isAway: boolean;
let url: string;

beforeEach(async () => {
  app = await startApp();
  received = [];
  answers = [];
  isAway = false;
  receiver = createServer((request, response) => {
    if (isAway) return void request.socket.destroy();
    let body = "";
    request.on("data", (chunk: Buffer) => (body += chunk.toString()));
    request.on("end", () => {
      const message = webhookMessageSchema.parse(JSON.parse(body));
      received.push({ path: request.url ?? "", headers: request.headers, body, message });
      response.writeHead(answers.shift() ?? 200, { Location: `${url}/elsewhere` }).end();
    });
  });
  await new Promise<void>((resolve) => receiver.listen(0, "127.0.0.1", resolve));
  url = `http://127.0.0.1:${(receiver.address() as AddressInfo).port}`;
});
afterEach(async () => {
  await app.close();
  receiver.closeAllConnections();
  await new Promise((resolve) => receiver.close(resolve));
});

async function subscribe(
  events: WebhookEvent[],
  path = "/hook/private-part",
): Promise<{ webhook: Webhook; secret: string }> {
  const response = await fetch(`${app.url}/api/v1/webhooks`, {
    method: "POST",
    headers: { "Content-Type": "application/json" },
    body: JSON.stringify({ name: "house", url: `${url}${path}`, events }),
  });
  expect(response.status).toBe(201);
  const { webhook, secret } = (await response.json()) as { webhook: unknown; secret: string };
  return { webhook: webhookSchema.parse(webhook), secret };
}
const add = async (): Promise<Job> => {
  const body = JSON.stringify({ name: "fern", drawing: SVG, settings: DEFAULT_PLOT_SETTINGS });
  const headers = { "Content-Type": "application/json" };
  return jobSchema.parse(
    await (await fetch(`${app.url}/api/v1/jobs`, { method: "POST", body, headers })).json(),
  );
};
const heard = (count: number): Promise<void> => expect.poll(() => received.length).toBe(count);
const nothingPending = (): Promise<void> =>
  expect.poll(() => app.webhooks.list().map(({ pendingCount }) => pendingCount)).toEqual([0]);

async function plot(end: "done" | Error): Promise<Job> {
  const job = await add();
  await app.queue.start(job.id);
  const run = await app.plotter.nextRun();
  if (end === "done") run.end({ kind: "done" });
  else run.fail(end);
  await expect.poll(() => app.queue.isRunning(job.id)).toBe(false);
  return job;
}

describe("a webhook", () => {
  it("is sent when a job is done, signed with its secret and the time", async () => {
    const { secret } = await subscribe(["done", "failed", "waiting"]);
    const { id } = await plot("done");
    await heard(1);
    const [{ headers, body, message, path }] = received as [Received];
    expect(path).toBe("/hook/private-part");
    expect(message).toMatchObject({ event: "done", job: { id, name: "fern", state: "done", wait: null } });
    const [, timeS = "", v1 = ""] =
      /^t=(\d+),v1=([0-9a-f]{64})$/.exec(String(headers["plotwright-signature"])) ?? [];
    expect(createHmac("sha256", secret).update(`${timeS}.${body}`).digest("hex")).toBe(v1);
    expect(signatureOf(`${secret}x`, Number(timeS), body)).not.toBe(v1);
    expect(headers["plotwright-event"]).toBe("done");
    expect(headers["plotwright-delivery"]).toBe(message.id);
  });

  it("is sent only the selected events: failures, and waits for a pen or after an interruption", async () => {
    await subscribe(["failed", "waiting"]);
    await plot("done");
    await plot(new PlotwrightError("internal", "The planner broke."));
    await heard(1);
    expect(received[0]?.message).toMatchObject({ event: "failed", job: { message: "The planner broke." } });
    const { id } = await add();
    await app.queue.start(id);
    const run = await app.plotter.nextRun();
    await expect.poll(() => app.queue.get(id).state).toBe("plotting");
    run.held(true, { kind: "pen", layerName: "sky", penName: "Blue 0.3", color: "#00f" });
    await heard(2);
    expect(received[1]?.message).toMatchObject({ event: "waiting", job: { id, wait: "Blue 0.3 for sky" } });
    app.queue.plots.resume(id);
    run.record({});
    run.fail(new PlotwrightError("disconnected", "The board was unplugged."));
    await heard(3);
    expect(received[2]?.message).toMatchObject({ event: "waiting", job: { id, state: "interrupted" } });
  });

  it("is retried until the message is accepted, in order, and does not follow redirects", async () => {
    answers = [500, 302];
    await subscribe(["done"]);
    await plot("done");
    await plot("done");
    await heard(4);
    await nothingPending();
    const ids = received.map(({ message }) => message.id);
    expect(new Set(ids.slice(0, 3)).size).toBe(1);
    expect(ids[3]).not.toBe(ids[0]);
    expect(new Set(received.map(({ path }) => path))).toEqual(new Set(["/hook/private-part"]));
    expect(app.logged.some((line) => line.includes("redirects are not followed"))).toBe(true);
  });

  it("is dropped after its last try, or at once if the receiver reports that it is gone", async () => {
    answers = [500, 500, 500, 500];
    await subscribe(["done"]);
    await plot("done");
    await nothingPending();
    expect(received).toHaveLength(4);
    expect(app.webhooks.list()[0]?.last).toMatchObject({ isDelivered: false, message: "answered 500" });
    answers = [410];
    await plot("done");
    await nothingPending();
    expect(received).toHaveLength(5);
  });

  it("is sent after a restart if it could not be sent before", async () => {
    const { webhook } = await subscribe(["done"]);
    isAway = true;
    await app.webhooks.close();
    const { id } = await plot("done");
    await expect.poll(() => app.webhooks.list()[0]?.pendingCount).toBe(1);
    isAway = false;
    const again = new Webhooks({
      store: new WebhookStore(app.store.database),
      plotterName: (one) => one,
      log: () => undefined,
    });
    again.start();
    await heard(1);
    expect(received[0]?.message.job.id).toBe(id);
    await expect.poll(() => again.list()[0]?.pendingCount).toBe(0);
    await again.close();
    expect(again.list().map((one) => one.id)).toEqual([webhook.id]);
  });

  it("waits longer after each failed try", async () => {
    await subscribe(["done"]);
    await app.webhooks.close();
    await plot("done");
    answers = [500];
    let nowMs = Date.now() + 1000;
    const patient = new Webhooks({
      store: new WebhookStore(app.store.database),
      plotterName: (one) => one,
      log: () => undefined,
      nowMs: () => nowMs,
      pausesS: [60, 600],
    });
    patient.start();
    await heard(1);
    const [{ id }] = app.webhooks.list() as [Webhook];
    const next = (): number => new WebhookStore(app.store.database).deliveries(id)[0]?.nextAtMs ?? 0;
    await expect.poll(next).toBe(nowMs + 60_000);
    await patient.close();
    nowMs += 60_000;
    answers = [500];
    const later = new Webhooks({
      store: new WebhookStore(app.store.database),
      plotterName: (one) => one,
      log: () => undefined,
      nowMs: () => nowMs,
      pausesS: [60, 600],
    });
    later.start();
    await expect.poll(next).toBe(nowMs + 600_000);
    await later.close();
  });

  it("keeps its secret and the private part of its address out of lists and logs", async () => {
    answers = [500];
    const { secret, webhook } = await subscribe(["done"]);
    await plot("done");
    await nothingPending();
    const listed = await (await fetch(`${app.url}/api/v1/webhooks`)).text();
    expect(listed).not.toContain(secret);
    const logs = await (await fetch(`${app.url}/api/v1/logs`)).text();
    for (const text of [logs, app.logged.join("\n")]) {
      expect(text).toContain("house");
      expect(text).not.toContain(secret);
      expect(text).not.toContain("private-part");
    }
    const remove = (): Promise<Response> =>
      fetch(`${app.url}/api/v1/webhooks/${webhook.id}`, { method: "DELETE" });
    expect([(await remove()).status, (await remove()).status]).toEqual([200, 404]);
    await plot("done");
    expect(received).toHaveLength(2);
  });

  it.each(["ftp://example.org/", "javascript:alert(1)", "not a url", "file:///etc/passwd"])(
    "is refused with the address %s",
    async (address) => {
      const response = await fetch(`${app.url}/api/v1/webhooks`, {
        method: "POST",
        headers: { "Content-Type": "application/json" },
        body: JSON.stringify({ name: "x", url: address, events: ["done"] }),
      });
      expect(response.status).toBe(400);
      expect(await response.text()).toContain(
        "url: it must be an address that begins with http:// or https://",
      );
    },
  );
});

describe("a webhook for starts and progress", () => {
  const progressOf = ({ message }: Received): number => message.job.progress;
  const at = (progress: number): Parameters<LedRun["progress"]>[0] => ({
    progress,
    elapsedS: 100 * progress,
    remainingS: 100 - 100 * progress,
    planS: 0,
    xMm: 0,
    yMm: 0,
    penUp: true,
    penMoving: false,
  });

  it("is sent when a plot starts, and not when it is paused and resumed", async () => {
    await subscribe(["started"]);
    const { id } = await add();
    await app.queue.start(id);
    const run = await app.plotter.nextRun();
    await heard(1);
    expect(received[0]?.message).toMatchObject({
      event: "started",
      job: { id, state: "plotting", progress: 0 },
    });
    run.held(true);
    await expect.poll(() => app.queue.get(id).state).toBe("paused");
    app.queue.plots.resume(id);
    await expect.poll(() => app.queue.get(id).state).toBe("plotting");
    run.end({ kind: "done" });
    await expect.poll(() => app.queue.get(id).state).toBe("done");
    app.queue.requeue(id);
    await app.queue.start(id);
    await heard(2);
    expect(received[1]?.message.event).toBe("started");
  });

  it("says nothing of either to those that were made for other events", async () => {
    await subscribe(["done", "waiting", "failed"]);
    const { id } = await add();
    await app.queue.start(id);
    const run = await app.plotter.nextRun();
    for (const share of [0.2, 0.6, 0.9]) run.progress(at(share));
    run.end({ kind: "done" });
    await heard(1);
    expect(received.map(({ message }) => message.event)).toEqual(["done"]);
  });

  /** Webhooks with a clock of the test, beside those of the server. */
  function withClock(progress: { everyPct: number; everyS: number }, pausesS: readonly number[] = []) {
    let nowMs = 1_000_000;
    const hooks = new Webhooks({
      store: new WebhookStore(app.store.database),
      plotterName: (one) => one,
      log: () => undefined,
      nowMs: () => nowMs,
      pausesS,
    });
    const { webhook } = hooks.add({ name: "bar", url, events: ["progress"], progress });
    return { hooks, webhook, passS: (s: number) => (nowMs += 1000 * s) };
  }

  it("is sent at most once in so many seconds and so many per cent", async () => {
    const { hooks, passS } = withClock({ everyPct: 10, everyS: 60 });
    const job = makeJob("a", { state: "plotting" });
    // Ten reports a second for 100 s in which half is drawn, then for 900 s.
    for (let s = 0; s < 100; s += 0.1) {
      hooks.progressed({ ...job, progress: s / 200 });
      passS(0.1);
    }
    await heard(1);
    for (let s = 0; s < 900; s += 0.1) {
      hooks.progressed({ ...job, progress: 0.5 + s / 1800 });
      passS(0.1);
      if (Math.round(10 * s) % 500 === 0) await nothingPending();
    }
    await nothingPending();
    const shares = received.map(progressOf);
    expect(shares[0]).toBeCloseTo(0.3, 2);
    for (const [index, share] of shares.slice(1).entries()) {
      expect(share - (shares[index] ?? 0)).toBeGreaterThanOrEqual(0.0999);
    }
    expect(shares).toHaveLength(6);
    expect(received.every(({ message }) => message.event === "progress")).toBe(true);
    await hooks.close();
  });

  it("keeps only the newest message of a job while the receiver is away", async () => {
    isAway = true;
    const { hooks, webhook, passS } = withClock({ everyPct: 5, everyS: 5 }, [40, 400, 400]);
    const pending = () => new WebhookStore(app.store.database).deliveries(webhook.id);
    const report = (id: string, progress: number): void => {
      hooks.progressed(makeJob(id, { state: "plotting", progress }));
      passS(6);
    };
    report("a", 0);
    report("a", 0.1);
    await expect.poll(() => pending()[0]?.tryCount).toBe(1);
    const [{ nextAtMs = 0 } = {}] = pending();
    for (const share of [0.2, 0.3, 0.4]) report("a", share);
    report("b", 0);
    report("b", 0.5);
    const waiting = pending().map(({ body, tryCount }) => {
      const { job } = webhookMessageSchema.parse(JSON.parse(body));
      return [job.id, job.progress, tryCount];
    });
    expect(waiting).toEqual([
      ["a", 0.4, 1],
      ["b", 0.5, 0],
    ]);
    expect(pending()[0]?.nextAtMs).toBe(nextAtMs);
    await hooks.close();
  });

  it("has defaults for how often, and limits", async () => {
    const { webhook } = await subscribe(["progress"]);
    expect(webhook.progress).toEqual({ everyPct: 5, everyS: 30 });
    for (const progress of [{ everyPct: 0 }, { everyS: 1 }, { everyS: "x" }]) {
      const body = JSON.stringify({ name: "x", url, events: ["progress"], progress });
      const headers = { "Content-Type": "application/json" };
      const made = await fetch(`${app.url}/api/v1/webhooks`, { method: "POST", headers, body });
      expect(made.status).toBe(400);
    }
  });

  it("does not end a plot if the disk is full", async () => {
    const { hooks, webhook, passS } = withClock({ everyPct: 5, everyS: 5 });
    const refuse = vi.spyOn(WebhookStore.prototype, "addDelivery").mockImplementation(() => {
      throw new Error("database or disk is full");
    });
    hooks.progressed(makeJob("a", { state: "plotting", progress: 0 }));
    passS(6);
    expect(() => hooks.progressed(makeJob("a", { state: "plotting", progress: 0.5 }))).not.toThrow();
    expect(refuse).toHaveBeenCalledTimes(1);
    refuse.mockRestore();
    passS(6);
    hooks.progressed(makeJob("a", { state: "plotting", progress: 0.6 }));
    await heard(1);
    expect(received[0]?.message.job.progress).toBe(0.6);
    hooks.remove(webhook.id);
    await hooks.close();
  });
});

describe("a stored webhook with an event of another version", () => {
  it("is listed with the events that this version knows", () => {
    const store = new WebhookStore(app.store.database);
    const hook = {
      id: "w",
      name: "Bell",
      url,
      createdAt: new Date().toISOString(),
      progress: { everyPct: 5, everyS: 30 },
      pendingCount: 0,
      last: null,
    };
    store.add({ ...hook, events: ["dreaming" as WebhookEvent, "done"] }, "secret");
    expect(store.list()).toEqual([{ ...hook, events: ["done"] }]);
  });
});
