import { readFileSync } from "node:fs";
import { afterEach, beforeEach, describe, expect, it } from "vitest";
import { httpReference, routeHeading } from "../../../scripts/http-reference.js";
import type { Snapshot } from "../../../src/schema/index.js";
import { startApp, type TestApp } from "../../support/servers/app.js";

let app: TestApp;
beforeEach(async () => {
  app = await startApp();
});
afterEach(() => app.close());

describe("the OpenAPI document", () => {
  it("lists exactly the existing routes", () => {
    const documented = app.documented().map(({ method, path }) => `${method} ${path}`);
    expect(documented.sort()).toEqual([...new Set(app.routes())].sort());
  });

  it("is served, with a schema for each body and answer", async () => {
    const document = await documentOf(app);
    expect(document.openapi).toBe("3.1.0");
    // A client joins the address of the server and the path as they are.
    const [{ url }] = document.servers;
    const { plotters } = (await (await fetch(`${app.url}${url}/state`)).json()) as Snapshot;
    expect([Object.keys(document.paths)[0], plotters.length]).toEqual(["/state", 1]);
    expect(Object.values(document.paths).flatMap((path) => Object.keys(path))).toHaveLength(
      app.documented().length,
    );
    const add = document.paths["/jobs"]?.["post"];
    expect(JSON.stringify(add?.requestBody)).toContain(`${REF}NewJob`);
    expect(JSON.stringify(document.components.schemas["GivenSettings"])).toMatch(/speedMmPerS/);
    expect(Object.keys(add?.responses ?? {})).toEqual(["201", "default"]);
    expect(document.paths["/jobs/{id}/move"]?.["post"]).toMatchObject({
      parameters: [{ name: "id", in: "path" }],
    });
  });
});

describe("for programs that generate a client, the OpenAPI document", () => {
  it("takes at most 150 kB", async () => {
    const text = await (await fetch(`${app.url}/api/v1/openapi.json`)).text();
    expect(text.length).toBeLessThan(150_000);
  });

  it("refers only to schemas that it has, and has none that it does not refer to", async () => {
    const document = await documentOf(app);
    const named = (JSON.stringify(document).match(/#\/components\/schemas\/[^"]+/g) ?? []).map((reference) =>
      reference.slice(REF.length),
    );
    expect([...new Set(named)].sort()).toEqual(Object.keys(document.components.schemas).sort());
    expect(Object.keys(document.components.schemas).filter((name) => !/^[A-Z]\w+$/.test(name))).toEqual([]);
    expect(JSON.stringify(document)).not.toMatch(/\$defs|"\$schema"/);
  });

  it("describes what is sent apart from what is returned only where they differ in who fills in defaults", async () => {
    const { schemas } = (await documentOf(app)).components;
    expect(schemas["PlotSettings"]?.required).toContain("prepare");
    expect(schemas["NewPlotter"]?.required).toEqual(["name", "device"]);
    expect(schemas["PlotterSettingsInput"]?.required).toEqual(["pen"]);
    expect(schemas["PlotterSettings"]?.required).toEqual(["pen", "pens", "presets"]);
  });

  it("names each operation once, as a function may be named, and says who may call it", async () => {
    const { paths, tags } = await documentOf(app);
    const all = Object.values(paths).flatMap((path) => Object.values(path));
    const ids = all.map(({ operationId }) => operationId);
    expect(new Set(ids).size).toBe(ids.length);
    expect(ids.filter((id) => !/^[a-z]\w*$/i.test(id))).toEqual([]);
    expect(ids).toContain("jobsEmergencyStop");
    const names = tags.map(({ name }) => name);
    expect(all.filter((one) => one.tags.length !== 1 || !names.includes(one.tags[0] ?? ""))).toEqual([]);
    const rolesOf = (id: string): string | undefined =>
      all.find(({ operationId }) => operationId === id)?.description;
    expect([
      rolesOf("jobsAdd"),
      rolesOf("jobsStart"),
      rolesOf("jobsPause"),
      rolesOf("operatorPairing"),
    ]).toEqual([
      "Roles: operate, submit.",
      "Roles: operate.",
      "Roles: operate, submit, watch.",
      "Roles: only the server's own computer.",
    ]);
  });

  it("has keys, sessions and neither as ways to be recognized", async () => {
    const { security, components } = await documentOf(app);
    expect(security).toEqual([{ key: [] }, { session: [] }, {}]);
    expect(components.securitySchemes).toMatchObject({
      key: { type: "http", scheme: "bearer" },
      session: { type: "apiKey", in: "cookie", name: "plotwright_session" },
    });
  });

  it("has the file itself and a form as bodies, with the same fields", async () => {
    const { paths } = await documentOf(app);
    const add = paths["/jobs"]?.["post"];
    expect(add?.parameters?.map(({ name, in: where }) => `${name} in ${where}`)).toEqual([
      "name in query",
      "settings in query",
      "plotterId in query",
    ]);
    const content = add?.requestBody?.content ?? {};
    expect(Object.keys(content)).toEqual([
      "application/json",
      "application/octet-stream",
      "multipart/form-data",
    ]);
    expect(content["multipart/form-data"]?.schema).toMatchObject({
      required: ["drawing"],
      properties: { name: {}, settings: {}, plotterId: {}, drawing: { format: "binary" } },
    });
    expect(Object.keys(paths["/drawings"]?.["post"]?.requestBody?.content ?? {})).toEqual([
      "application/octet-stream",
    ]);
    expect(paths["/history"]?.["get"]?.parameters?.map(({ name }) => name)).toEqual([
      "after",
      "plotterId",
      "name",
    ]);
    expect(paths["/plotters/{id}/home"]?.["post"]?.requestBody?.required).toBe(false);
  });
});

const REF = "#/components/schemas/";

interface Document {
  readonly openapi: string;
  readonly servers: readonly [{ readonly url: string }];
  readonly paths: Record<string, Record<string, Described>>;
  readonly security: unknown;
  readonly tags: readonly { readonly name: string }[];
  readonly components: {
    readonly schemas: Record<string, { readonly required?: readonly string[] }>;
    readonly securitySchemes: unknown;
  };
}
interface Described {
  readonly operationId: string;
  readonly description: string;
  readonly tags: readonly string[];
  readonly parameters?: readonly { readonly name: string; readonly in: string }[];
  readonly requestBody?: {
    readonly required: boolean;
    readonly content: Record<string, { readonly schema?: unknown }>;
  };
  readonly responses: Record<string, unknown>;
}

const documentOf = async ({ url }: TestApp): Promise<Document> =>
  (await (await fetch(`${url}/api/v1/openapi.json`)).json()) as Document;

describe("docs/http-reference.md", () => {
  const text = readFileSync(new URL("../../../docs/http-reference.md", import.meta.url), "utf8");

  it("is what `npm run docs` writes", async () => {
    expect(text).toBe(await httpReference());
  });

  it("gives the meaning of fields, from docstrings and from the settings tables", () => {
    expect(text).toContain("// Share of the plot's time, 0 … 1\n  progress: number;");
    expect(text).toContain("// Height while travelling\n  upPct: number;");
  });

  it("has a section for each route of the OpenAPI document", () => {
    const missing = app.documented().filter((one) => !text.includes(`\n${routeHeading(one)}\n`));
    expect(missing).toEqual([]);
  });
});
