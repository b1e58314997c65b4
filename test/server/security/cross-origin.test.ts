/** Pages of other origins: which requests of theirs the server answers, and with whose rights. */
import { afterEach, beforeEach, describe, expect, it } from "vitest";
import { originsOf } from "../../../server/composition/server-options.js";
import { jobSchema } from "../../../src/schema/index.js";
import { startApp, type TestApp } from "../../support/servers/app.js";

const SVG = '<svg xmlns="http://www.w3.org/2000/svg"><path d="M0 0h10"/></svg>';
const ALLOWED = "https://editor.example";
/** Like the allowed one, but other origins. */
const OTHERS = [
  "null",
  "https://evil.example",
  "http://editor.example",
  "https://editor.example:8443",
  "https://editor.example.evil.example",
  "https://evileditor.example",
  "https://sub.editor.example",
  "https://editor.example.",
  "https://editor.example/",
  "https://editor.example@evil.example",
  "HTTPS://EDITOR.EXAMPLE",
  "https://editor.example, https://evil.example",
  "*",
  "",
];

let app: TestApp;
afterEach(() => app.close());

const keyOf = (role: "operate" | "watch"): string => app.access.createKey("sketch", role).secret;
const bearer = (secret: string): Record<string, string> => ({ Authorization: `Bearer ${secret}` });
const send = (method: string, path: string, headers: Record<string, string>, body?: string) =>
  fetch(`${app.url}${path}`, { method, headers, ...(body === undefined ? {} : { body }) });
const corsHeaders = ({ headers }: Response): string[] =>
  [...headers.keys()].filter((name) => name.startsWith("access-control-"));
const preflight = (path: string, origin: string, more: Record<string, string> = {}): Promise<Response> =>
  send("OPTIONS", path, {
    Origin: origin,
    "Access-Control-Request-Method": "POST",
    "Access-Control-Request-Headers": "authorization,content-type",
    ...more,
  });
const routes = (): (readonly [method: string, path: string])[] =>
  app.routes().map((route) => {
    const [method = "", path = ""] = route.split(" ");
    return [method.toUpperCase(), `/api/v1${path.replace(/:\w+/, "virtual")}`] as const;
  });

async function sessionOf(): Promise<string> {
  const response = await fetch(`${app.url}${app.access.pairingPath("operate")}`);
  return (response.headers.get("set-cookie") ?? "").split(";")[0] ?? "";
}

async function plottingJob(): Promise<string> {
  const headers = bearer(keyOf("operate"));
  const { id } = jobSchema.parse(await (await send("POST", "/api/v1/jobs?name=a", headers, SVG)).json());
  expect((await send("POST", `/api/v1/jobs/${id}/start`, headers)).status).toBe(200);
  return id;
}

describe("a server without --allow-origin", () => {
  beforeEach(async () => {
    app = await startApp();
  });

  it("refuses every route to pages of other origins, whatever they send, and sends no permission", async () => {
    const key = keyOf("operate");
    for (const origin of [ALLOWED, ...OTHERS.slice(0, 2)]) {
      for (const [method, path] of routes()) {
        const asked = await preflight(path, origin);
        const answered = await send(method, path, { Origin: origin, ...bearer(key) });
        for (const response of [asked, answered]) {
          expect([method, path, response.status, corsHeaders(response)]).toEqual([method, path, 403, []]);
        }
      }
    }
    expect((await send("GET", "/api/v1/state", {})).headers.get("vary")).toBeNull();
  }, 60_000);
});

describe("a server with --allow-origin", () => {
  beforeEach(async () => {
    app = await startApp({ allowedOrigins: [ALLOWED, "http://localhost:8080"] });
  });

  it.each(OTHERS)(
    "refuses every route to other origins, also to those that look like it: %s",
    async (origin) => {
      const key = keyOf("operate");
      for (const [method, path] of routes()) {
        const asked = await preflight(path, origin);
        const answered = await send(method, path, { Origin: origin, ...bearer(key) });
        for (const response of [asked, answered]) {
          const permission = response.headers.get("access-control-allow-origin");
          expect([path, response.status, permission]).toEqual([path, 403, null]);
        }
      }
    },
  );

  it("answers the browser's question for every route, with methods and headers and without credentials", async () => {
    for (const [method, path] of routes()) {
      const asked = await preflight(path, ALLOWED, { "Access-Control-Request-Method": method });
      expect([path, asked.status, await asked.text()]).toEqual([path, 204, ""]);
      expect(asked.headers.get("access-control-allow-origin")).toBe(ALLOWED);
      expect(asked.headers.get("access-control-allow-methods")?.split(", ")).toContain(method);
      expect(asked.headers.get("access-control-allow-headers")).toBe("Authorization, Content-Type");
      expect(asked.headers.get("access-control-allow-credentials")).toBeNull();
      expect(asked.headers.get("access-control-allow-private-network")).toBeNull();
      expect(asked.headers.get("vary")).toMatch(/\bOrigin\b/);
      expect(asked.headers.get("set-cookie")).toBeNull();
    }
    const fromOutside = await preflight("/API/v1/jobs", ALLOWED, {
      "Access-Control-Request-Private-Network": "true",
      "User-Agent": "Mozilla/5.0",
    });
    expect(fromOutside.headers.get("access-control-allow-private-network")).toBe("true");
    expect(fromOutside.headers.get("set-cookie")).toBeNull();
  });

  it("refuses every route without a key, although the request comes from this computer", async () => {
    const session = await sessionOf();
    const secret = session.split("=")[1] ?? "";
    const key = keyOf("operate");
    for (const [method, path] of routes()) {
      for (const [query, headers] of [
        ["", {}],
        ["", { Cookie: session }],
        ["", bearer(secret)],
        ["", bearer(`${key}x`)],
        ["", { Authorization: `Basic ${Buffer.from(`key:${key}`).toString("base64")}` }],
        [`?key=${key}&access_token=${key}&authorization=Bearer%20${key}`, {}],
      ] as [string, Record<string, string>][]) {
        const response = await send(method, path + query, { Origin: ALLOWED, ...headers });
        expect([method, path, headers, response.status]).toEqual([method, path, headers, 403]);
        // The page can read why.
        expect(response.headers.get("access-control-allow-origin")).toBe(ALLOWED);
      }
    }
    const why = await send("GET", "/api/v1/state", { Origin: ALLOWED });
    expect(await why.text()).toMatch(/another site needs an access key/);
  }, 60_000);

  it("gives every route to a page with a key, except what only this computer may", async () => {
    const key = keyOf("operate");
    for (const [method, path] of routes()) {
      if (path.endsWith("/events") || path.startsWith("/api/v1/access")) continue;
      // A live drawing is answered when its plotter has drawn it.
      if (method === "POST" && path.endsWith("/live")) continue;
      const response = await send(method, path, { Origin: ALLOWED, ...bearer(key) });
      const isRefused = path === "/api/v1/pairing";
      expect([method, path, response.status === 403]).toEqual([method, path, isRefused]);
      expect(response.headers.get("access-control-allow-origin")).toBe(ALLOWED);
      expect(response.headers.get("access-control-allow-credentials")).toBeNull();
      expect(response.headers.get("vary")).toMatch(/\bOrigin\b/);
      expect(response.headers.get("set-cookie")).toBeNull();
    }
  }, 60_000);

  it("streams events to a page with a key until that is revoked", async () => {
    const { entry, secret } = app.access.createKey("sketch", "watch");
    const stream = await send("GET", "/api/v1/events", { Origin: ALLOWED, ...bearer(secret) });
    expect(stream.headers.get("access-control-allow-origin")).toBe(ALLOWED);
    const reader = stream.body?.getReader();
    expect(new TextDecoder().decode((await reader?.read())?.value)).toContain("retry:");
    app.access.revoke(entry.id);
    while ((await reader?.read())?.done === false);
    expect((await send("GET", "/api/v1/events", { Origin: ALLOWED, ...bearer(secret) })).status).toBe(403);
  });

  it("lets a page with a key to watch stop a plot, and change nothing", async () => {
    const id = await plottingJob();
    const run = await app.plotter.nextRun();
    const headers = { Origin: ALLOWED, ...bearer(keyOf("watch")) };
    expect((await send("POST", `/api/v1/jobs/${id}/resume`, headers)).status).toBe(403);
    expect((await send("POST", "/api/v1/jobs?name=b", headers, SVG)).status).toBe(403);
    for (const action of ["pause", "cancel"]) {
      expect((await send("POST", `/api/v1/jobs/${id}/${action}`, headers)).status).toBe(200);
    }
    expect(run.asked).toEqual(["pause", "cancel"]);
  });

  it("never limits stops of a page with a key, nor the questions before them", async () => {
    const id = await plottingJob();
    const headers = { Origin: ALLOWED, ...bearer(keyOf("operate")) };
    for (const flood of [headers, { Origin: ALLOWED }]) {
      const answers: Response[] = [];
      // Fewer at a time than an unknown client may have connections.
      while (answers.length < 620) {
        const some = Array.from({ length: 31 }, () => send("GET", "/api/v1/me", flood));
        answers.push(...(await Promise.all(some)));
      }
      expect(answers.filter(({ status }) => status === 429)).toHaveLength(20);
      // A page must be able to read that it is too fast.
      expect(answers.at(-1)?.headers.get("access-control-allow-origin")).toBe(ALLOWED);
    }
    expect((await preflight(`/api/v1/jobs/${id}/pause`, ALLOWED)).status).toBe(204);
    expect((await send("POST", `/api/v1/jobs/${id}/pause`, headers)).status).toBe(200);
  }, 60_000);

  it("answers no name of its own computer that another site has made up", async () => {
    const { port } = new URL(app.url);
    const { request } = await import("node:http");
    const statusOf = (method: string, host: string): Promise<number | undefined> =>
      new Promise((resolve, reject) => {
        const headers = {
          Host: host,
          Origin: ALLOWED,
          "Access-Control-Request-Method": "GET",
          ...bearer(keyOf("operate")),
        };
        request({ port, path: "/api/v1/state", method, headers }, (response) => {
          response.resume();
          resolve(response.statusCode);
        })
          .on("error", reject)
          .end();
      });
    for (const method of ["GET", "OPTIONS"]) {
      expect(await statusOf(method, `rebound.example:${port}`)).toBe(403);
      expect(await statusOf(method, "editor.example")).toBe(403);
      expect(await statusOf(method, `localhost:${port}`)).toBe(method === "GET" ? 200 : 204);
    }
  });

  it("gives the page's own files and the pairing links to no other origin", async () => {
    const token = app.access.pairingPath("operate");
    for (const path of ["/", "/assets/x.js", "/pair", token, "/api", "/apis/v1/state"]) {
      const response = await send("GET", path, { Origin: ALLOWED, ...bearer(keyOf("operate")) });
      expect([path, response.status]).toEqual([path, 403]);
      expect((await preflight(path, ALLOWED)).status).toBe(403);
    }
  });

  it("still refuses what a page of an allowed origin sends without saying so", async () => {
    for (const site of ["cross-site", "same-site"]) {
      expect((await send("GET", "/api/v1/state", { "Sec-Fetch-Site": site })).status).toBe(403);
    }
  });
});

describe("the origins of --allow-origin", () => {
  beforeEach(async () => {
    app = await startApp();
  });

  it.each([
    ["https://editor.p5js.org", "https://editor.p5js.org"],
    ["https://Editor.P5JS.org/", "https://editor.p5js.org"],
    ["https://editor.p5js.org:443", "https://editor.p5js.org"],
    ["http://localhost:8080", "http://localhost:8080"],
    ["http://[::1]:8080", "http://[::1]:8080"],
    ["https://bücher.example", "https://xn--bcher-kva.example"],
  ])("%s is %s", (url, origin) => {
    expect(originsOf([url])).toEqual([origin]);
  });

  it.each([
    "*",
    "null",
    "",
    "editor.p5js.org",
    "file://",
    "ftp://editor.p5js.org",
    "https://",
    "https://*.p5js.org",
    "https://editor.p5js.org/sketches",
    "https://editor.p5js.org?a",
    "https://editor.p5js.org#a",
    "https://user@editor.p5js.org",
    "https://editor.p5js.org https://evil.example",
    "https://editor.p5js.org:99999",
    "javascript:alert(1)",
  ])("%s is refused", (url) => {
    expect(() => originsOf([url])).toThrow(/is not an origin/);
  });
});
