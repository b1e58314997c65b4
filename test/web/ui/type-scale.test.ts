/** The page's text has five sizes, on whole pixels. */
import { readFileSync, readdirSync } from "node:fs";
import path from "node:path";
import { describe, expect, it } from "vitest";

const WEB = path.join(import.meta.dirname, "..", "..", "..", "web");
const files = (ending: RegExp): (readonly [name: string, text: string])[] =>
  readdirSync(WEB, { recursive: true, encoding: "utf8" })
    .filter((name) => ending.test(name))
    .map((name) => [name, readFileSync(path.join(WEB, name), "utf8")]);

const TOKEN = /^var\(--type-(small|note|text|title|figure)\)$/;
/** Words on the picture of the ringing sheet, in its mm. */
const IN_PICTURES = ["3.4px", "1.5px"];

describe("the type scale", () => {
  it("has five sizes on whole pixels, which rise", () => {
    const tokens = files(/tokens\.css$/)[0][1];
    const sizes = Array.from(tokens.matchAll(/--type-\w+: (.*?);/g), ([, size]) => size);
    expect(sizes).toHaveLength(5);
    const px = sizes.map((size) => Number(/^(\d+)px$/.exec(size)?.[1]));
    expect(px).toEqual([...new Set(px)].sort((a, b) => a - b));
  });

  it("has every size of text in the styles", () => {
    const styles = files(/\.css$/).map(([name, text]) => [name, text.replace(/\/\*[^]*?\*\//g, "")] as const);
    const sizes = styles.flatMap(([name, text]) =>
      Array.from(text.matchAll(/font-size:\s*([^;]+);/g), ([, size]) => [name, size.trim()]),
    );
    expect(sizes.length).toBeGreaterThan(50);
    expect(
      sizes.filter(([, size]) => !TOKEN.test(size) && size !== "inherit" && !IN_PICTURES.includes(size)),
    ).toEqual([]);
    const fonts = styles.flatMap(([name, text]) =>
      Array.from(text.matchAll(/\bfont:\s*([^;]+);/g), ([, font]) => [
        name,
        font.split(/\s*\/\s*/)[0].trim(),
      ]),
    );
    expect(fonts.filter(([, size]) => !TOKEN.test(size) && size !== "inherit")).toEqual([]);
  });

  it("has whole sizes wherever it is set for another screen", () => {
    const set = files(/\.css$/).flatMap(([, text]) =>
      Array.from(text.matchAll(/--type-\w+: ([^;]+);/g), ([, size]) => size),
    );
    expect(set.filter((size) => !/^\d+px$/.test(size))).toEqual([]);
  });

  it("has the only size of text on the canvases, too", () => {
    // Words on the picture of the ringing sheet are in its mm.
    const written = files(/(?<!sheet-picture)\.tsx?$/).flatMap(([name, text]) =>
      Array.from(
        text.matchAll(/["'`]\s*(\d[\d.]*px) [^"'`]*sans-serif|style=\{\{[^}]*fontSize/g),
        ([, size]) => [name, size],
      ),
    );
    expect(written).toEqual([[path.join("preview", "backdrop.ts"), "11px"]]);
  });
});
