import { readdirSync, readFileSync } from "node:fs";
import path from "node:path";
import { describe, expect, it } from "vitest";
import { oddPhrasesIn } from "./plain-words.js";

const DOCUMENTS = [
  "README.md",
  "ARCHITECTURE.md",
  "CONTRIBUTING.md",
  "CHANGELOG.md",
  "web/README.md",
  ...readdirSync("docs")
    .filter((name) => name.endsWith(".md"))
    .map((name) => `docs/${name}`),
];

const CODE = ["src", "host", "server", "web", "test", "scripts", "bench"];

/** The list of odd words itself. */
const EXEMPT = path.join("test", "architecture", "plain-words.ts");

const codeIn = (folder: string): string[] =>
  readdirSync(folder, { recursive: true, encoding: "utf8" })
    .filter((name) => /\.(tsx?|mjs)$/.test(name))
    .map((name) => path.join(folder, name))
    .filter((file) => file !== EXEMPT);

const adviceFor = (file: string): string[] =>
  oddPhrasesIn(readFileSync(file, "utf8")).map(
    ({ phrase, plain, line }) => `${file}:${line}: instead of "${phrase}": ${plain}`,
  );

describe("the plain words", () => {
  it.each(DOCUMENTS)("are used in %s", (file) => {
    expect(adviceFor(file)).toEqual([]);
  });

  it.each(CODE)("are used in the comments, names and messages of %s", (folder) => {
    const files = codeIn(folder);
    expect(files.length).toBeGreaterThan(0);
    expect(files.flatMap(adviceFor)).toEqual([]);
  });

  it("exclude an odd phrase, also over two lines of a comment", () => {
    expect(oddPhrasesIn("/**\n * The plot is gone on\n * with.\n */")).toEqual([
      { phrase: "gone on\n * with", plain: "resumed", line: 2 },
    ]);
  });
});
