import { readFileSync } from "node:fs";
import { afterEach, beforeEach, describe, expect, it } from "vitest";
import { httpReference, routeHeading } from "../../../scripts/http-reference.js";
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
    const response = await fetch(`${app.url}/api/v1/openapi.json`);
    const document = (await response.json()) as {
      openapi: string;
      paths: Record<string, Record<string, { requestBody?: unknown; responses: Record<string, unknown> }>>;
    };
    expect(document.openapi).toBe("3.1.0");
    expect(Object.values(document.paths).flatMap((path) => Object.keys(path))).toHaveLength(
      app.documented().length,
    );
    const add = document.paths["/api/v1/jobs"]?.["post"];
    expect(JSON.stringify(add?.requestBody)).toMatch(/speedMmPerS/);
    expect(Object.keys(add?.responses ?? {})).toEqual(["201", "default"]);
    expect(document.paths["/api/v1/jobs/{id}/move"]?.["post"]).toMatchObject({
      parameters: [{ name: "id", in: "path" }],
    });
  });
});

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
