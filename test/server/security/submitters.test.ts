/** The role "submit": devices and keys that add jobs, see only their own, and move nothing. */
import { afterEach, beforeEach, describe, expect, it } from "vitest";
import { Access } from "../../../server/security/access.js";
import { Store } from "../../../server/storage/store.js";
import {
  apiErrorSchema,
  jobPageSchema,
  jobSchema,
  snapshotSchema,
  type Job,
  type Role,
} from "../../../src/schema/index.js";
import { startApp, type TestApp } from "../../support/servers/app.js";
import { EventStream } from "../../support/servers/event-stream.js";

const SVG = '<svg xmlns="http://www.w3.org/2000/svg"><path d="M0 0h10"/></svg>';
const JSON_TYPE = { "Content-Type": "application/json" };
type Headers = Record<string, string>;

let app: TestApp;
let operator: Headers;
let anna: Headers;
let ben: Headers;
beforeEach(async () => {
  app = await startApp({ trustsLoopback: false });
  operator = keyOf("operate", "teacher");
  anna = keyOf("submit", "Anna");
  ben = keyOf("submit", "Ben");
});
afterEach(() => app.close());

const keyOf = (role: Role, name: string): Headers => ({
  Authorization: `Bearer ${app.access.createKey(name, role).secret}`,
});
const call = (method: string, path: string, headers: Headers, body?: string): Promise<Response> =>
  fetch(`${app.url}/api/v1${path}`, { method, headers, ...(body === undefined ? {} : { body }) });
const statusOf = async (method: string, path: string, headers: Headers, body?: string): Promise<number> =>
  (await call(method, path, headers, body)).status;
const add = async (name: string, headers: Headers): Promise<Job> =>
  jobSchema.parse(await (await call("POST", `/jobs?name=${name}`, headers, SVG)).json());
const namesIn = async (path: string, headers: Headers): Promise<string[]> =>
  jobPageSchema.parse(await (await call("GET", path, headers)).json()).jobs.map(({ name }) => name);

/** Everything that the role may do, jobs only if they are its own. */
const ALLOWED = [
  "get /state",
  "get /history",
  "get /events",
  "get /me",
  "get /openapi.json",
  "get /queue",
  "post /drawings",
  "post /jobs",
  "get /jobs/:id",
  "get /jobs/:id/drawing",
  "get /jobs/:id/pictures",
  "get /jobs/:id/picture",
  "patch /jobs/:id",
  "post /jobs/:id/pause",
  "post /jobs/:id/cancel",
  "post /jobs/:id/requeue",
  "post /jobs/:id/emergency-stop",
  "post /jobs/:id/duplicate",
  "delete /jobs/:id",
  "get /devices",
  "get /plotters/:id",
  "get /plotters/:id/queue",
  "get /plotters/:id/settings",
  "get /plotters/:id/defaults",
  "get /machines",
  "get /samples",
  "get /samples/:name",
];

describe("a device or key that may only submit jobs", () => {
  it("is refused every other route, with every method and spelling", async () => {
    const paths = [...new Set(app.routes().map((route) => route.split(" ")[1] ?? ""))];
    for (const method of ["get", "post", "put", "patch", "delete", "head", "options"]) {
      // A key may send 600 requests a minute.
      const key = keyOf("submit", method);
      for (const path of paths) {
        if (ALLOWED.includes(`${method === "head" ? "get" : method} ${path}`)) continue;
        const at = path.replace(/:\w+/, "virtual");
        for (const spelling of [at, at.toUpperCase(), `${at}/`, `${at}?x=/jobs`]) {
          const status = await statusOf(method.toUpperCase(), spelling, key);
          expect([method, spelling, [403, 404].includes(status)]).toEqual([method, spelling, true]);
        }
      }
    }
    expect(app.plotter.asked).toEqual([]);
    const refused = await call("POST", "/plotters/virtual/home", anna);
    expect(apiErrorSchema.parse(await refused.json()).error.message).toMatch(
      /may only add drawings to the queue/,
    );
  }, 60_000);

  it("is refused by no route that it may use", async () => {
    const { id } = await add("own", anna);
    for (const route of ALLOWED.filter((one) => !one.endsWith("/events"))) {
      const [method = "", path = ""] = route.split(" ");
      const at = path.replace(":id", path.startsWith("/jobs") ? id : "virtual").replace(":name", "x");
      const status = await statusOf(method.toUpperCase(), at, { ...anna, ...JSON_TYPE }, bodyOf(method));
      expect([route, status === 403]).toEqual([route, false]);
    }
  });

  it("adds jobs, and does with its own what moves nothing", async () => {
    const job = await add("own", anna);
    expect(job.submittedBy?.name).toBe("Anna");
    const patch = JSON.stringify({ name: "renamed", settings: { pen: { downPct: 20 } } });
    expect(await statusOf("PATCH", `/jobs/${job.id}`, { ...anna, ...JSON_TYPE }, patch)).toBe(200);
    const copy = jobSchema.parse(await (await call("POST", `/jobs/${job.id}/duplicate`, anna)).json());
    expect(copy.submittedBy).toEqual(job.submittedBy);
    expect(await (await call("GET", `/jobs/${job.id}/drawing`, anna)).text()).toBe(SVG);
    for (const action of ["start", "resume", "recover", "check-place", "move", "place", "change"]) {
      expect([action, await statusOf("POST", `/jobs/${job.id}/${action}`, anna)]).toEqual([action, 403]);
    }
    expect(await statusOf("POST", `/jobs/${copy.id}/cancel`, anna)).toBe(200);
    expect(await statusOf("POST", `/jobs/${copy.id}/requeue`, anna)).toBe(200);
    expect(await statusOf("DELETE", `/jobs/${job.id}`, anna)).toBe(200);
    expect(await namesIn("/state", anna)).toEqual(["renamed"]);
    expect(app.plotter.asked).toEqual([]);
  });

  it("uploads a drawing for its own job only, and may keep three of them waiting", async () => {
    const upload = async (headers: Headers): Promise<string> =>
      ((await (await call("POST", "/drawings", headers, SVG)).json()) as { id: string }).id;
    const claim = (drawingId: string, headers: Headers): Promise<number> =>
      statusOf("POST", "/jobs", { ...headers, ...JSON_TYPE }, JSON.stringify({ name: "a", drawingId }));
    const [first, second] = [await upload(anna), await upload(anna)];
    expect(await claim(second, ben)).toBe(404);
    expect(await claim(await upload(operator), anna)).toBe(404);
    await upload(anna);
    await upload(anna);
    expect(await claim(first, anna)).toBe(404);
    expect(await claim(second, anna)).toBe(201);
  });

  it("has at most twenty jobs waiting, however they come there", async () => {
    const twenty = JSON.stringify({ name: "a", drawing: SVG, copies: 20 });
    expect(await statusOf("POST", "/jobs", { ...anna, ...JSON_TYPE }, twenty)).toBe(201);
    const refused = await call("POST", "/jobs?name=b", anna, SVG);
    expect([refused.status, await refused.text()]).toEqual([
      409,
      expect.stringMatching(/20 jobs of Anna are waiting/),
    ]);
    const [{ id = "" } = {}] = app.queue.list();
    expect(await statusOf("POST", `/jobs/${id}/duplicate`, anna)).toBe(409);
    expect(app.queue.list()).toHaveLength(20);
    expect(app.drawingsOnDisk()).toHaveLength(1);
    expect(await statusOf("POST", "/jobs?name=c", ben, SVG)).toBe(201);
    expect(await statusOf("POST", "/jobs?name=d", operator, SVG)).toBe(201);
  });

  it("stops its own plot, and leaves it in the history", async () => {
    const { id } = await add("own", anna);
    expect(await statusOf("POST", `/jobs/${id}/start`, operator)).toBe(200);
    const run = await app.plotter.nextRun();
    for (const action of ["pause", "emergency-stop", "cancel"]) {
      expect([action, await statusOf("POST", `/jobs/${id}/${action}`, anna)]).toEqual([action, 200]);
    }
    expect(run.asked).toEqual(["pause", "emergency stop", "cancel"]);
    await expect.poll(() => app.queue.get(id).state).toBe("cancelled");
    const kept = await call("DELETE", `/jobs/${id}`, anna);
    expect([kept.status, await kept.text()]).toEqual([
      409,
      expect.stringMatching(/Only an operator removes/),
    ]);
    expect(await statusOf("DELETE", `/jobs/${id}`, operator)).toBe(200);
  });
});

const bodyOf = (method: string): string | undefined => (method === "get" ? undefined : "{}");

describe("the jobs of others", () => {
  it("do not exist for it: not in the state, the history, nor by their ids", async () => {
    const others = [await add("teacher's", operator), await add("bens", ben)];
    const own = await add("annas", anna);
    for (const { id } of [...others, own]) await call("POST", `/jobs/${id}/cancel`, operator);
    const waiting = [await add("of-ben", ben), await add("of-anna", anna)];
    expect(await namesIn("/state", anna)).toEqual(["of-anna", "annas"]);
    expect(await namesIn("/state", ben)).toEqual(["of-ben", "bens"]);
    expect(await namesIn("/history", anna)).toEqual(["annas"]);
    expect(await namesIn(`/history?after=${own.id}`, anna)).toEqual([]);
    expect(await statusOf("GET", `/history?after=${others[0]?.id}`, anna)).toBe(404);
    expect(await namesIn("/state", operator)).toHaveLength(5);
    const messages = new Set<string>();
    for (const { id } of [...others, waiting[0], { id: "nothing" }]) {
      const spellings = [id, `%${id.charCodeAt(0).toString(16)}${id.slice(1)}`];
      for (const route of ALLOWED.filter((one) => one.includes("/jobs/:id"))) {
        const [method = "", path = ""] = route.split(" ");
        for (const spelling of spellings) {
          const at = path.replace(":id", spelling);
          const answer = await call(method.toUpperCase(), at, { ...anna, ...JSON_TYPE }, bodyOf(method));
          expect([route, answer.status]).toEqual([route, 404]);
          messages.add(apiErrorSchema.parse(await answer.json()).error.message.replace(id, "ID"));
        }
      }
    }
    expect([...messages]).toEqual(["There is no job ID."]);
    expect(app.queue.list().map(({ state }) => state)).toEqual([
      "queued",
      "queued",
      "cancelled",
      "cancelled",
      "cancelled",
    ]);
  });

  it("can't be stopped by it while they plot, nor a move by hand", async () => {
    const { id } = await add("bens", ben);
    await call("POST", `/jobs/${id}/start`, operator);
    const run = await app.plotter.nextRun();
    for (const action of ["pause", "emergency-stop", "cancel"]) {
      expect(await statusOf("POST", `/jobs/${id}/${action}`, anna)).toBe(404);
    }
    expect(await statusOf("POST", "/plotters/virtual/stop", anna)).toBe(403);
    expect(run.asked).toEqual([]);
  });

  it("are in none of its events", async () => {
    const before = [await add("teacher's", operator), await add("annas", anna)];
    const stream = await EventStream.open(app.url, anna);
    const watching = await EventStream.open(app.url, keyOf("watch", "wall"));
    await watching.find("snapshot");
    const { snapshot } = await stream.find("snapshot");
    expect(snapshot.jobs.map(({ name }) => name)).toEqual(["annas"]);
    app.notices.add("secret.svg in the watched folder can't be plotted");
    const bens = await add("bens", ben);
    await call("POST", `/jobs/${bens.id}/start`, operator);
    const run = await app.plotter.nextRun();
    run.progress({
      progress: 0.5,
      elapsedS: 1,
      remainingS: 1,
      planS: 1,
      xMm: 1,
      yMm: 1,
      penUp: true,
      penMoving: false,
    });
    await watching.find("progress");
    await call("POST", `/jobs/${bens.id}/cancel`, operator);
    await watching.find("job", ({ job }) => job.id === bens.id && job.state === "cancelled");
    await call("DELETE", `/jobs/${bens.id}`, operator);
    const later = await add("later", anna);
    await call("DELETE", `/jobs/${later.id}`, operator);
    await stream.find("job-removed", ({ id }) => id === later.id);
    const text = JSON.stringify(stream.seen);
    for (const hidden of [bens.id, before[0]?.id ?? "", "bens", "teacher's", "secret.svg", "Ben"]) {
      expect([hidden, text.includes(hidden)]).toEqual([hidden, false]);
    }
    const { ids } = await stream.find("order", (event) => event.ids.length === 2);
    expect(ids).toEqual([before[1]?.id, later.id]);
    expect(JSON.stringify(watching.seen)).toContain("secret.svg");
    expect(snapshotSchema.parse(await (await call("GET", "/state", anna)).json()).serverNotices).toEqual([]);
    stream.close();
    watching.close();
  });
});

describe("a browser paired to submit", () => {
  const pair = async (role: Role, cookie?: string): Promise<Headers> => {
    const headers = cookie === undefined ? {} : { Cookie: cookie };
    const response = await fetch(`${app.url}${app.access.pairingPath(role)}`, { headers });
    return { Cookie: (response.headers.get("set-cookie") ?? "").split(";")[0] ?? "" };
  };

  it("neither needs nor takes the operator's lock", async () => {
    const teacher = await pair("operate");
    expect(await statusOf("POST", "/operator/take", teacher)).toBe(200);
    const student = { ...(await pair("submit")), "User-Agent": "Mozilla/5.0 (Android) Firefox/140" };
    const job = await add("own", student);
    expect(job.submittedBy?.name).toBe("Firefox on Android (this computer)");
    expect(await statusOf("DELETE", `/jobs/${job.id}`, student)).toBe(200);
    expect(await statusOf("POST", "/operator/take", student)).toBe(403);
    const { operator: holder } = snapshotSchema.parse(await (await call("GET", "/state", teacher)).json());
    expect(holder?.id).toBe(
      app.access.list().find(({ kind, role }) => kind === "session" && role === "operate")?.id,
    );
    expect(await (await call("GET", "/me", student)).json()).toMatchObject({ role: "submit" });
  });

  it("keeps its jobs when it is paired again, and not when another device is", async () => {
    const student = await pair("submit");
    await add("own", student);
    const again = await pair("submit", student["Cookie"]);
    expect(await statusOf("GET", "/me", student)).toBe(403);
    expect(await namesIn("/state", again)).toEqual(["own"]);
    expect(await namesIn("/state", await pair("submit"))).toEqual([]);
    expect(await namesIn("/state", await pair("submit", `plotwright_session=${"a".repeat(43)}`))).toEqual([]);
    const sessions = app.access.list().filter(({ kind }) => kind === "session");
    expect(new Set(sessions.map(({ id }) => id)).size).toBe(3);
  });

  it("keeps its jobs after a restart of the server, and they are no one's when it is revoked", async () => {
    const { id } = await add("own", anna);
    const { submittedBy } = app.queue.get(id);
    app.store.close();
    const store = Store.open(app.dir);
    expect(store.jobs().map((job) => job.submittedBy)).toEqual([submittedBy]);
    const access = new Access(store);
    const key = access.list().find(({ name }) => name === "Anna");
    expect(key?.id).toBe(submittedBy?.id);
    access.revoke(key?.id ?? "");
    expect(access.createKey("Anna", "submit").entry.id).not.toBe(submittedBy?.id);
    store.close();
  });
});
