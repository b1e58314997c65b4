/** The library over HTTP: its operations, who may perform them, and paths that lead out of it. */
import { existsSync, readdirSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { afterEach, beforeEach, describe, expect, it } from "vitest";
import { apiErrorSchema, jobSchema, libraryListSchema, type Role } from "../../../src/schema/index.js";
import { startApp, type TestApp } from "../../support/servers/app.js";

const SVG = '<svg xmlns="http://www.w3.org/2000/svg"><path d="M0 0h10"/></svg>';
let app: TestApp;
beforeEach(async () => {
  app = await startApp({ maxUploadBytes: 1_000 });
});
afterEach(() => app.close());

const call = (
  method: string,
  path: string,
  body?: string,
  headers: Record<string, string> = {},
): Promise<Response> =>
  fetch(`${app.url}/api/v1${path}`, { method, headers, ...(body === undefined ? {} : { body }) });
const at = (path: string): string => `/library/${encodeURIComponent(path)}`;
const list = async (query = "") =>
  libraryListSchema.parse(await (await call("GET", `/library${query}`)).json());
const codeOf = async (response: Response): Promise<string> =>
  apiErrorSchema.parse(await response.json()).error.code;

describe("the library", () => {
  it("stores a file, lists and finds it, returns it as plain text to download, and removes it", async () => {
    const saved = await call("PUT", at("plants/fern.svg"), SVG);
    expect([saved.status, await saved.json()]).toEqual([
      201,
      { path: "plants/fern.svg", bytes: SVG.length, changedAt: expect.any(String) as string },
    ]);
    expect(await list()).toMatchObject({ folders: ["plants"], files: [] });
    expect(await list("?folder=plants")).toMatchObject({ files: [{ path: "plants/fern.svg" }] });
    expect(await list("?name=FERN")).toMatchObject({ files: [{ path: "plants/fern.svg" }] });
    const drawing = await call("GET", at("plants/fern.svg"));
    expect(await drawing.text()).toBe(SVG);
    expect(drawing.headers.get("content-type")).toBe("text/plain; charset=utf-8");
    expect(drawing.headers.get("content-disposition")).toMatch(/^attachment; filename="?fern\.svg/);
    expect(drawing.headers.get("x-content-type-options")).toBe("nosniff");
    expect((await call("DELETE", at("plants/fern.svg"))).status).toBe(200);
    expect(await list("?folder=plants")).toMatchObject({ files: [] });
    // Nothing is left of the upload.
    expect(app.drawingsOnDisk()).toEqual([]);
  });

  it("keeps what was plotted, under the name of the job, as often as asked", async () => {
    const job = jobSchema.parse(await (await call("POST", "/jobs?name=moon.svg", SVG)).json());
    const keep = (body?: object): Promise<Response> =>
      call("POST", `/jobs/${job.id}/keep`, body && JSON.stringify(body), {
        "content-type": "application/json",
      });
    expect(await (await keep({})).json()).toMatchObject({ path: "moon.svg" });
    expect(await (await keep({})).json()).toMatchObject({ path: "moon 2.svg" });
    expect(await (await keep({ folder: "sky", name: "a/b" })).json()).toMatchObject({ path: "sky/a_b.svg" });
    expect(await codeOf(await keep({ folder: "../.." }))).toBe("bad-setting");
    // The library's copy stays when the job is removed.
    await call("DELETE", `/jobs/${job.id}`);
    expect(await (await call("GET", at("moon.svg"))).text()).toBe(SVG);
  });

  it("refuses empty and large files, names in use and names that are not of drawings, and stores nothing then", async () => {
    await call("PUT", at("a.svg"), SVG);
    expect(await codeOf(await call("PUT", at("a.svg"), SVG))).toBe("conflict");
    expect(await codeOf(await call("PUT", at("b.svg"), ""))).toBe("bad-file");
    expect(await codeOf(await call("PUT", at("b.svg"), "x".repeat(1_001)))).toBe("too-large");
    for (const name of ["b.html", "b", ".b.svg", "con.svg"]) {
      expect([name, await codeOf(await call("PUT", at(name), SVG))]).toEqual([name, "bad-setting"]);
    }
    expect(await list()).toMatchObject({ folders: [], files: [{ path: "a.svg" }] });
    expect(app.drawingsOnDisk()).toEqual([]);
  });

  it("leads nowhere else, however the path is written", async () => {
    writeFileSync(join(app.dir, "secret.svg"), "secret");
    await call("PUT", at("a/b.svg"), SVG);
    const before = readdirSync(app.dir).sort();
    for (const path of [
      ...["..%2Fsecret.svg", "%2e%2e%2fsecret.svg", "a%2F..%2F..%2Fsecret.svg", "..%5Csecret.svg"],
      ...["%2Fetc%2Fpasswd", "a%00.svg", "%252e%252e%252fsecret.svg", "a%2F%2Fb.svg", "%ff.svg"],
    ]) {
      for (const method of ["GET", "PUT", "DELETE"]) {
        const response = await call(method, `/library/${path}`, method === "PUT" ? SVG : undefined);
        expect([method, path, response.status]).toEqual([
          method,
          path,
          expect.toSatisfy((s: number) => s >= 400 && s < 500),
        ]);
      }
    }
    for (const folder of ["..", "a/..", "/", "%2e%2e", ".hidden"]) {
      expect([
        folder,
        (await call("GET", `/library?folder=${encodeURIComponent(folder)}`)).status >= 400,
      ]).toEqual([folder, folder !== "%2e%2e"]);
    }
    expect(readdirSync(app.dir).sort()).toEqual(before);
    expect(existsSync(join(app.dir, "secret.svg"))).toBe(true);
  });
});

describe("who may use the library", () => {
  it("is operators; watchers see it, and those who only submit do not", async () => {
    await app.close();
    app = await startApp({ trustsLoopback: false });
    const as = (role: Role) => ({ Authorization: `Bearer ${app.access.createKey(role, role).secret}` });
    const [operate, watch, submit] = [as("operate"), as("watch"), as("submit")];
    expect((await call("PUT", at("a.svg"), SVG, operate)).status).toBe(201);
    const statuses = async (headers: Record<string, string>): Promise<number[]> => {
      const asked = [];
      for (const [method, path] of [
        ["GET", "/library"],
        ["GET", at("a.svg")],
        ["PUT", at("b.svg")],
        ["DELETE", at("a.svg")],
      ] as const) {
        asked.push((await call(method, path, method === "PUT" ? SVG : undefined, headers)).status);
      }
      return asked;
    };
    expect(await statuses({})).toEqual([403, 403, 403, 403]);
    expect(await statuses(submit)).toEqual([403, 403, 403, 403]);
    expect(await statuses(watch)).toEqual([200, 200, 403, 403]);
    expect(await statuses(operate)).toEqual([200, 200, 201, 200]);
  });
});
