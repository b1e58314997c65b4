/** One operator at a time: several browsers, each with its own cookie. */
import { afterEach, beforeEach, describe, expect, it, vi } from "vitest";
import { OperatorLock } from "../../../server/security/operator-lock.js";
import {
  apiErrorSchema,
  jobSchema,
  meSchema,
  snapshotSchema,
  type Job,
  type Operator,
} from "../../../src/schema/index.js";
import { startApp, type TestApp } from "../../support/servers/app.js";
import { EventStream } from "../../support/servers/event-stream.js";

const SVG = '<svg xmlns="http://www.w3.org/2000/svg"><path d="M0 0h10"/></svg>';
const DESKTOP = "Mozilla/5.0 (X11; Linux x86_64; rv:140.0) Gecko/20100101 Firefox/140.0";
const PHONE =
  "Mozilla/5.0 (iPhone; CPU iPhone OS 18_0 like Mac OS X) AppleWebKit/605.1.15 Version/18.0 Safari/604.1";

let app: TestApp;

interface Browser {
  readonly headers: Record<string, string>;
  call(method: string, path: string, body?: unknown): Promise<Response>;
}

/** Loads the page, as a browser does first. */
async function openBrowser(agent: string): Promise<Browser> {
  const page = await fetch(`${app.url}/`, { headers: { "User-Agent": agent } });
  const cookie = page.headers.get("set-cookie") ?? "";
  expect(cookie).toMatch(/^plotwright_browser=[\w-]{32};.*HttpOnly.*SameSite=Strict/);
  const headers = { "User-Agent": agent, Cookie: cookie.split(";")[0] ?? "" };
  const call: Browser["call"] = (method, path, body) =>
    fetch(`${app.url}/api/v1${path}`, {
      method,
      headers: { ...headers, ...(body === undefined ? {} : { "Content-Type": "application/json" }) },
      ...(body === undefined ? {} : { body: JSON.stringify(body) }),
    });
  return { headers, call };
}
const addJob = async (): Promise<Job> =>
  jobSchema.parse(await (await fetch(`${app.url}/api/v1/jobs?name=a`, { method: "POST", body: SVG })).json());
const codeOf = async (response: Response): Promise<string> =>
  `${response.status} ${apiErrorSchema.parse(await response.json()).error.code}`;
const operator = async (): Promise<Operator | null> =>
  snapshotSchema.parse(await (await fetch(`${app.url}/api/v1/state`)).json()).operator;

describe("the operator lock", () => {
  beforeEach(async () => {
    app = await startApp();
  });
  afterEach(() => app.close());

  it("distinguishes two browsers of the same kind by name", async () => {
    const [first, second] = [await openBrowser(DESKTOP), await openBrowser(DESKTOP)];
    const nameOf = async (browser: Browser): Promise<string | null> =>
      meSchema.parse(await (await browser.call("GET", "/me")).json()).name;
    expect(await nameOf(first)).toBe("Firefox on Linux (this computer)");
    expect(await nameOf(second)).toBe("Firefox (2) on Linux (this computer)");
    expect(await nameOf(first)).toBe("Firefox on Linux (this computer)");
    expect(await nameOf(second)).toBe("Firefox (2) on Linux (this computer)");
  });

  it("goes to the browser that acts first; another one changes nothing until it takes over", async () => {
    const [desktop, phone] = [await openBrowser(DESKTOP), await openBrowser(PHONE)];
    const streams = [
      await EventStream.open(app.url, desktop.headers),
      await EventStream.open(app.url, phone.headers),
    ];
    const { id } = await addJob();
    expect(await operator()).toBeNull();
    expect((await desktop.call("PATCH", `/jobs/${id}`, { name: "fern" })).status).toBe(200);
    const me = meSchema.parse(await (await desktop.call("GET", "/me")).json());
    expect(me).toMatchObject({ role: "operate", name: "Firefox on Linux (this computer)" });
    expect(await operator()).toEqual({ id: me.id, name: me.name });

    for (const [method, path, body] of [
      ["PATCH", `/jobs/${id}`, { name: "moss" }],
      ["POST", `/jobs/${id}/start`],
      ["POST", `/jobs/${id}/cancel`],
      ["DELETE", `/jobs/${id}`],
      ["POST", "/plotters/virtual/pen", { up: true }],
      ["PATCH", "/queue", { runOn: true }],
    ] as const) {
      expect([path, await codeOf(await phone.call(method, path, body))]).toEqual([path, "409 not-operator"]);
    }
    expect(app.queue.get(id)).toMatchObject({ name: "fern", state: "queued" });

    const taken = await phone.call("POST", "/operator/take");
    expect(((await taken.json()) as { operator: Operator }).operator.name).toMatch(/^Safari on iPhone/);
    for (const stream of streams) {
      await stream.find("operator", (event) => event.operator?.name.startsWith("Safari on iPhone") === true);
      stream.close();
    }
    expect((await phone.call("PATCH", `/jobs/${id}`, { name: "moss" })).status).toBe(200);
    expect(await codeOf(await desktop.call("POST", `/jobs/${id}/start`))).toBe("409 not-operator");
    expect(app.logged.filter((line) => line.startsWith("operator: "))).toEqual([
      expect.stringMatching(/Firefox on Linux .*acts first/),
      expect.stringMatching(/Safari on iPhone .*takes over from Firefox on Linux/),
    ]);
  });

  it("is not needed to stop a plot", async () => {
    const [desktop, phone] = [await openBrowser(DESKTOP), await openBrowser(PHONE)];
    const stream = await EventStream.open(app.url, desktop.headers);
    const { id } = await addJob();
    await desktop.call("POST", `/jobs/${id}/start`);
    const run = await app.plotter.nextRun();
    for (const action of ["pause", "emergency-stop", "cancel"]) {
      expect([action, (await phone.call("POST", `/jobs/${id}/${action}`)).status]).toEqual([action, 200]);
    }
    expect(run.asked).toEqual(["pause", "emergency stop", "cancel"]);
    stream.close();
  });

  it("expires when its browser has gone, and stays with one that is present", async () => {
    await app.close();
    app = await startApp({ lapseMs: 100 });
    const [desktop, phone] = [await openBrowser(DESKTOP), await openBrowser(PHONE)];
    const watching = await EventStream.open(app.url, phone.headers);
    const stream = await EventStream.open(app.url, desktop.headers);
    const { id } = await addJob();
    await desktop.call("PATCH", `/jobs/${id}`, { name: "fern" });
    await watching.find("operator", (event) => event.operator !== null);
    stream.close();
    await watching.find("operator", (event) => event.operator === null);
    expect((await phone.call("PATCH", `/jobs/${id}`, { name: "moss" })).status).toBe(200);
    expect((await operator())?.name).toMatch(/iPhone/);
    watching.close();
  });

  it("is not needed by scripts or keys", async () => {
    const desktop = await openBrowser(DESKTOP);
    const stream = await EventStream.open(app.url, desktop.headers);
    const { id } = await addJob();
    await desktop.call("PATCH", `/jobs/${id}`, { name: "fern" });
    const script = await fetch(`${app.url}/api/v1/jobs/${id}/start`, { method: "POST" });
    expect(script.status).toBe(200);
    const { secret } = app.access.createKey("cron", "operate");
    const keyed = await fetch(`${app.url}/api/v1/jobs/${id}/pause`, {
      method: "POST",
      headers: { ...desktop.headers, Authorization: `Bearer ${secret}` },
    });
    expect(keyed.status).toBe(200);
    expect(await codeOf(await fetch(`${app.url}/api/v1/operator/take`, { method: "POST" }))).toBe(
      "400 bad-setting",
    );
    stream.close();
  });

  it("shows other browsers no cookie, and recognises a forged one", async () => {
    const desktop = await openBrowser(DESKTOP);
    const stream = await EventStream.open(app.url, desktop.headers);
    const { id } = await addJob();
    await desktop.call("PATCH", `/jobs/${id}`, { name: "fern" });
    const { id: operatorId = "" } = (await operator()) ?? {};
    expect(desktop.headers["Cookie"]).not.toContain(operatorId);
    const forged = { "User-Agent": PHONE, Cookie: `plotwright_browser=${operatorId.padEnd(32, "0")}` };
    const response = await fetch(`${app.url}/api/v1/jobs/${id}`, { method: "DELETE", headers: forged });
    expect(await codeOf(response)).toBe("409 not-operator");
    stream.close();
  });
});

describe("the operator lock of a browser", () => {
  const [ANNA, BEN] = [
    { id: "a", name: "Anna" },
    { id: "b", name: "Ben" },
  ];
  const LAPSE_MS = 30_000;
  const kept: { value?: unknown } = {};
  const newLock = (): OperatorLock =>
    new OperatorLock({
      store: { setting: () => kept.value, saveSetting: (_key, value) => void (kept.value = value) },
      announce: () => undefined,
      log: () => undefined,
    });
  let lock: OperatorLock;
  beforeEach(() => {
    vi.useFakeTimers();
    kept.value = undefined;
    lock = newLock();
  });
  afterEach(() => {
    lock.close();
    vi.useRealTimers();
  });

  it("survives a restart of the server with its holder, who may then return within 30 s", () => {
    const stream = lock.streamOpened("a");
    lock.act(ANNA);
    lock.close();
    stream();
    vi.advanceTimersByTime(10 * LAPSE_MS);
    lock = newLock();
    expect(lock.operator).toEqual(ANNA);
    expect(() => lock.act(BEN)).toThrow("Anna is operating");
    vi.advanceTimersByTime(LAPSE_MS - 1);
    expect(() => lock.act(BEN)).toThrow("Anna is operating");
    vi.advanceTimersByTime(1);
    expect(lock.operator).toBeNull();
  });

  it("stays with it while one of its tabs is open", () => {
    const [first, second] = [lock.streamOpened("a"), lock.streamOpened("a")];
    lock.act(ANNA);
    first();
    vi.advanceTimersByTime(10 * LAPSE_MS);
    expect(lock.operator).toEqual(ANNA);
    second();
    vi.advanceTimersByTime(LAPSE_MS);
    expect(lock.operator).toBeNull();
  });

  it("stays with it if it is back in time, as after a reload", () => {
    const first = lock.streamOpened("a");
    lock.act(ANNA);
    first();
    vi.advanceTimersByTime(LAPSE_MS - 1);
    lock.streamOpened("a");
    vi.advanceTimersByTime(10 * LAPSE_MS);
    expect(lock.operator).toEqual(ANNA);
  });

  it("is not lost by the timer of the one who had it before", () => {
    lock.act(ANNA);
    vi.advanceTimersByTime(LAPSE_MS - 1);
    lock.streamOpened("b");
    lock.take(BEN);
    vi.advanceTimersByTime(10 * LAPSE_MS);
    expect(lock.operator).toEqual(BEN);
  });

  it("lasts 30 s from the last action of one without an event stream", () => {
    lock.act(ANNA);
    vi.advanceTimersByTime(LAPSE_MS - 1);
    lock.act(ANNA);
    vi.advanceTimersByTime(LAPSE_MS - 1);
    expect(lock.operator).toEqual(ANNA);
    vi.advanceTimersByTime(1);
    expect(lock.operator).toBeNull();
  });
});
