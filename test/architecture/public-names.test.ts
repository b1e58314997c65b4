/** Every public name is in docs/library.md, whose examples test/packaging runs, and in the reference, with a docstring. */
import { readFileSync } from "node:fs";
import path from "node:path";
import ts from "typescript-6";
import { beforeAll, describe, expect, it } from "vitest";
import { libraryReference, type LibraryReference } from "../../scripts/library-reference.js";

const ROOT = path.join(import.meta.dirname, "..", "..");
const read = (file: string): string => readFileSync(path.join(ROOT, file), "utf8");

/** The names in an entry's `export { … } from` lists, and its own declarations. */
function exportedNames(file: string): string[] {
  const source = ts.createSourceFile(file, read(file), ts.ScriptTarget.ES2022, true);
  return source.statements.flatMap((statement) => {
    if (
      ts.isExportDeclaration(statement) &&
      statement.exportClause &&
      ts.isNamedExports(statement.exportClause)
    ) {
      return statement.exportClause.elements.map((element) => element.name.text);
    }
    const isExported = ts.canHaveModifiers(statement)
      ? ts.getModifiers(statement)?.some(({ kind }) => kind === ts.SyntaxKind.ExportKeyword)
      : false;
    const isNamed =
      ts.isFunctionDeclaration(statement) ||
      ts.isInterfaceDeclaration(statement) ||
      ts.isClassDeclaration(statement);
    return isExported && isNamed && statement.name ? [statement.name.text] : [];
  });
}

const codeIn = (markdown: string): string =>
  [...markdown.matchAll(/```ts\n[\s\S]*?```|`[^`\n]+`/g)].map(([code]) => code).join("\n");

describe("docs/library.md", () => {
  const code = codeIn(read("docs/library.md"));

  it.each(["src/index.ts", "server/index.ts", "web/serial/web-serial.ts"])(
    "shows every name that %s exports",
    (entry) => {
      const names = exportedNames(entry);
      expect(names.length).toBeGreaterThan(0);
      expect(names.filter((name) => !new RegExp(`\\b${name}\\b`).test(code))).toEqual([]);
    },
  );

  it("has at most 50 public names", () => {
    expect(exportedNames("src/index.ts").length).toBeLessThanOrEqual(50);
  });

  it("has no barrel that exports unlisted names", () => {
    expect(read("src/index.ts")).not.toMatch(/^export \*/m);
  });
});

describe("docs/library-reference.md", () => {
  let reference: LibraryReference;
  beforeAll(async () => {
    reference = await libraryReference();
  }, 60_000);

  it("is what `npm run docs` writes", () => {
    expect(read("docs/library-reference.md")).toBe(reference.markdown);
  });

  it("describes every public name", () => {
    const names = exportedNames("src/index.ts");
    expect(names.filter((name) => !reference.markdown.includes(`\n### ${name}\n`))).toEqual([]);
    expect(reference.withoutDocs.filter((name) => names.includes(name))).toEqual([]);
  });

  it("describes the fields of public types, except the second of a pair such as x and y", () => {
    const second = /\.([vaj]?y|\w+Y|\w+YMm|heightMm|paperHeightMm|steps2|acc2)$/;
    expect(reference.withoutDocs.filter((name) => !second.test(name))).toEqual([]);
  });
});
