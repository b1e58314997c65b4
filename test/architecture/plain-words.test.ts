import { readdirSync, readFileSync } from "node:fs";
import { describe, expect, it } from "vitest";
import { oddWordsIn } from "../../scripts/lint/plain-words.mjs";

/** The Markdown files of the project: ESLint checks the same words in the code. */
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

const phrasesIn = (text: string): string[] => [...oddWordsIn(text)].map(({ phrase }) => phrase);

describe("the plain words", () => {
  it.each(DOCUMENTS)("are used in %s", (file) => {
    expect(phrasesIn(readFileSync(file, "utf8"))).toEqual([]);
  });

  it("exclude an odd phrase, also over two lines of a comment", () => {
    expect(phrasesIn("/**\n * The plot is gone on\n * with.\n */")).toEqual(["gone on\n * with"]);
  });
});
