/**
 * Every TypeScript example of the documents is type-checked and run against the built package. `// → text` at
 * the end of a line is its expected output.
 */
import { spawnSync } from "node:child_process";
import { mkdirSync, mkdtempSync, readFileSync, rmSync, symlinkSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import path from "node:path";
import { afterAll, beforeAll, describe, expect, it } from "vitest";
import { ROOT } from "../../scripts/setup.mjs";

const DOCUMENTS = ["README.md", "docs/library.md"];

interface Example {
  readonly name: string;
  readonly file: string;
  readonly code: string;
}

function examplesOf(document: string): Example[] {
  const text = readFileSync(path.join(ROOT, document), "utf8");
  return [...text.matchAll(/^```ts\n([\s\S]*?)^```/gm)].map((match, i) => {
    const lineNumber = text.slice(0, match.index).split("\n").length;
    const stem = document.replace(/\W+/g, "-").toLowerCase();
    return { name: `${document} line ${lineNumber}`, file: `${stem}-${i + 1}.ts`, code: match[1] ?? "" };
  });
}

const examples = DOCUMENTS.flatMap(examplesOf);
const folder = mkdtempSync(path.join(tmpdir(), "plotwright-examples-"));

beforeAll(() => {
  mkdirSync(path.join(folder, "node_modules"));
  symlinkSync(ROOT, path.join(folder, "node_modules", "plotwright"), "junction");
  symlinkSync(
    path.join(ROOT, "node_modules", "@types"),
    path.join(folder, "node_modules", "@types"),
    "junction",
  );
  symlinkSync(path.join(ROOT, "samples"), path.join(folder, "samples"), "junction");
  writeFileSync(path.join(folder, "package.json"), '{ "type": "module" }');
  const options = {
    target: "ES2022",
    lib: ["ES2022", "DOM"],
    module: "NodeNext",
    strict: true,
    noEmit: true,
    types: ["node"],
  };
  writeFileSync(
    path.join(folder, "tsconfig.json"),
    JSON.stringify({ compilerOptions: { ...options, skipLibCheck: true } }),
  );
  for (const { file, code } of examples) writeFileSync(path.join(folder, file), code);
});

afterAll(() => rmSync(folder, { recursive: true, force: true }));

const runNode = (script: string, ...args: string[]) =>
  spawnSync(process.execPath, [path.join(ROOT, "node_modules", script), ...args], {
    cwd: folder,
    encoding: "utf8",
  });

describe("the examples of the documents", () => {
  it("exist", () => {
    expect(examples.length).toBeGreaterThan(0);
  });

  it("have correct types", () => {
    expect(runNode("typescript/bin/tsc", "-p", ".").stdout).toBe("");
  });

  it.each(examples)("$name runs and prints the expected output", ({ file, code }) => {
    const { status, stdout, stderr } = runNode("tsx/dist/cli.mjs", file);
    expect(stderr).toBe("");
    expect(status).toBe(0);
    const said = [...code.matchAll(/\/\/ → (.*)$/gm)].map((match) => match[1]);
    const printed = stdout.split("\n").filter((line) => line !== "");
    for (const line of said) expect(printed).toContain(line);
  });
});
