/** What a first visit loads, compared with the limit that keeps it fast on a slow connection. */
import { readFileSync, readdirSync } from "node:fs";
import path from "node:path";
import { gzipSync } from "node:zlib";
import { describe, expect, it } from "vitest";
import { ROOT } from "../../../scripts/setup.mjs";

const LIMIT_BYTES = 256_000;
const folder = path.join(ROOT, "dist", "web");
const read = (file: string): string => readFileSync(path.join(folder, file), "utf8");
const gzippedBytes = (file: string): number =>
  gzipSync(readFileSync(path.join(folder, file)), { level: 9 }).length;

const ASSETS = readdirSync(path.join(folder, "assets"));
const asset = (beginning: string): string => `assets/${ASSETS.find((file) => file.startsWith(beginning))!}`;

/** Scripts and style sheets named by the page, including their static imports. */
const named = (): string[] =>
  [...read("index.html").matchAll(/assets\/[\w.-]+\.(?:js|css)/g)].map(([file]) => file);
const worker = (name: "plan" | "draw"): string => asset(`${name}.worker`);
/** The letters of English; a browser loads the font's other files only for letters of other scripts. */
const LETTERS = "inter-latin-wght-normal";

describe("the first load of the built page", () => {
  it("is at most 256 kB gzipped, workers, style sheet and font included", () => {
    const files = ["index.html", ...named(), worker("plan"), worker("draw"), asset(LETTERS)];
    expect(files.filter((file) => file.endsWith(".js")).length).toBeGreaterThanOrEqual(2);
    expect(files.filter((file) => file.endsWith(".css")).length).toBe(1);
    expect(files.reduce((sum, file) => sum + gzippedBytes(file), 0)).toBeLessThanOrEqual(LIMIT_BYTES);
  });

  it("loads nothing at once that those files load later", () => {
    for (const file of named().filter((name) => name.endsWith(".js"))) {
      const imported = [...read(file).matchAll(/\b(?:import|from)\s*["']\.\/([\w.-]+)["']/g)].map(
        ([, name]) => `assets/${name}`,
      );
      expect(named()).toEqual(expect.arrayContaining(imported));
    }
    for (const name of ["plan", "draw"] as const)
      expect(read(worker(name))).not.toMatch(/\b(import|from)\s*["']/);
  });
});
