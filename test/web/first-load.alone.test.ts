/** What a first visit fetches, against the limit that keeps it quick on a slow line. */
import { readFileSync, readdirSync } from "node:fs";
import path from "node:path";
import { gzipSync } from "node:zlib";
import { describe, expect, it } from "vitest";
import { ROOT } from "../../scripts/setup.mjs";

const LIMIT_BYTES = 250_000;
const folder = path.join(ROOT, "dist", "web");
const gzippedBytes = (file: string): number =>
  gzipSync(readFileSync(path.join(folder, file)), { level: 9 }).length;

describe("the first load of the built page", () => {
  it("is at most 250 kB gzipped, planning worker and style sheet included", () => {
    const assets = readdirSync(path.join(folder, "assets"));
    const first = assets.filter((name) => /^(index|plan\.worker)-.*\.(js|css)$/.test(name));
    expect(first.length).toBe(3);
    const files = ["index.html", ...first.map((name) => `assets/${name}`)];
    expect(files.reduce((sum, file) => sum + gzippedBytes(file), 0)).toBeLessThanOrEqual(LIMIT_BYTES);
  });

  it("fetches nothing by itself that those three files leave for later", () => {
    const page = readFileSync(path.join(folder, "index.html"), "utf8");
    const named = [...page.matchAll(/assets\/([\w.-]+)/g)].map((match) => match[1]);
    expect(named.every((name) => /^index-/.test(name ?? ""))).toBe(true);
    const worker = readdirSync(path.join(folder, "assets")).find((name) => name.startsWith("plan.worker"))!;
    const code = readFileSync(path.join(folder, "assets", worker), "utf8");
    expect(code).not.toMatch(/\b(import|from)\s*["']/);
  });
});
