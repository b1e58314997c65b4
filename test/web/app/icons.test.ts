/** The icons of a home screen: the files exist, in the sizes that the page and its manifest state. */
import { readFileSync } from "node:fs";
import path from "node:path";
import { describe, expect, it } from "vitest";
import { ROOT } from "../../../scripts/setup.mjs";

interface Named {
  readonly src: string;
  readonly sizes: string;
  readonly type: string;
  readonly purpose: string;
}

const read = (...parts: string[]): Buffer => readFileSync(path.join(ROOT, "web", ...parts));
const manifest = JSON.parse(read("public", "manifest.webmanifest").toString()) as { icons: Named[] };
const appleTag = /<link rel="apple-touch-icon" sizes="(\w+)" href="(\S+)"/.exec(
  read("index.html").toString(),
);
const apple = { src: appleTag?.[2] ?? "", sizes: appleTag?.[1] ?? "", type: "image/png", purpose: "apple" };
const pngs = [...manifest.icons.filter(({ type }) => type === "image/png"), apple];

/** "180x180", from the header of a PNG file. */
function sizeOf(png: Buffer): string {
  expect(png.subarray(1, 4).toString()).toBe("PNG");
  return `${png.readUInt32BE(16)}x${png.readUInt32BE(20)}`;
}

describe("icons", () => {
  it.each(pngs)("$src exists, $sizes", ({ src, sizes }) => {
    expect(sizeOf(read("public", src))).toBe(sizes);
  });

  it("are those that home screens need", () => {
    const named = pngs.map(({ sizes, purpose }) => `${purpose} ${sizes}`);
    for (const wanted of ["any 192x192", "any 512x512", "maskable 512x512", "apple 180x180"]) {
      expect(named).toContain(wanted);
    }
    const svg = manifest.icons.find(({ type }) => type === "image/svg+xml");
    expect(read("public", svg?.src ?? "").toString()).toMatch(/^<svg /);
  });
});
