/** Each package whose code is in the page has its licence text beside it. */
import { spawnSync } from "node:child_process";
import { mkdtempSync, readFileSync, readdirSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import path from "node:path";
import { afterAll, describe, expect, it } from "vitest";
import { ROOT, nodeModule } from "../../scripts/setup.mjs";
import { IS_FULL } from "../support/runs/full-run.js";

const folder = mkdtempSync(path.join(tmpdir(), "plotwright-licences-"));
afterAll(() => rmSync(folder, { recursive: true, force: true }));

/** The page as the server has it (dist/web); in the full run also as the web site has it (dist/site/app). */
const BACKENDS = IS_FULL ? ["server", "browser"] : ["server"];

describe.each(BACKENDS)("the page with its backend in the %s", (backend) => {
  it("has the licence of every package in it, and the test notices when one is missing", () => {
    const out = path.join(folder, backend);
    const sources = builtSources(out, backend);
    const text = readFileSync(path.join(out, "licences.txt"), "utf8").trim();
    const packages = packagesOf(sources);
    // Each is in another part: the page, the worker that reads drawings.
    expect(packages).toEqual(expect.arrayContaining(["preact", "zustand", "css-tree", "clipper2-ts"]));
    for (const name of packages) expect(licenceOf(name, text)).toMatch(/permi(t|ssion)/i);
    for (const name of packages) {
      const rest = text.replace(licenceOf(name, text) ?? "", "");
      expect(packages.filter((one) => licenceOf(one, rest) === undefined)).toEqual([name]);
    }
    expect(licenceOf("Hershey fonts,", text)).toMatch(/permission/i);
  });
});

it("the licences in dist/web are those of a fresh build", () => {
  const shipped = readFileSync(path.join(ROOT, "dist", "web", "licences.txt"), "utf8");
  expect(shipped).toBe(readFileSync(path.join(folder, "server", "licences.txt"), "utf8"));
});

/** Builds the page with source maps; returns the path and text of each file that it was made from. */
function builtSources(out: string, backend: string): Map<string, string> {
  const args = [
    "build",
    "--config",
    "web/vite.config.ts",
    "--outDir",
    out,
    "--sourcemap",
    "--logLevel",
    "warn",
  ];
  const env = { ...process.env, NODE_ENV: "production", VITE_BACKEND: backend };
  const command = [nodeModule("vite", "bin", "vite.js"), ...args];
  const { status, stderr } = spawnSync(process.execPath, command, { cwd: ROOT, env, encoding: "utf8" });
  expect([status, status === 0 ? "" : stderr]).toEqual([0, ""]);
  const maps = readdirSync(out, { recursive: true, encoding: "utf8" }).filter((file) =>
    file.endsWith(".map"),
  );
  const sources = new Map<string, string>();
  for (const file of maps) {
    const map = JSON.parse(readFileSync(path.join(out, file), "utf8")) as {
      sources: string[];
      sourcesContent: (string | null)[];
    };
    map.sources.forEach((source, i) => sources.set(source, map.sourcesContent[i] ?? ""));
  }
  return sources;
}

/** Also those that are inside the published file of another package: the file then has the name of the dependency. */
function packagesOf(sources: ReadonlyMap<string, string>): string[] {
  const found = new Set<string>();
  for (const [source, text] of sources) {
    const name = /.*\/node_modules\/((?:@[^/]+\/)?[^/]+)\//.exec(source)?.[1];
    if (name === undefined) continue;
    found.add(name);
    const file = path.join(ROOT, "node_modules", name, "package.json");
    const { dependencies = {} } = JSON.parse(readFileSync(file, "utf8")) as { dependencies?: object };
    for (const other of Object.keys(dependencies)) if (text.includes(other)) found.add(other);
  }
  return [...found].sort();
}

/** The section of licences.txt with this name, its title included. */
const licenceOf = (name: string, text: string): string | undefined =>
  text.split("\n\n\n").find((section) => section.startsWith(`${name} `));
