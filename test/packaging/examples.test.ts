/**
 * Every example of the documents in TypeScript, JavaScript or as shell commands is run against the built package.
 * `// → text` at the end of a line is its expected output. An example that cannot run here, because it installs
 * something or needs a real machine, has the word `no-run` after its language. JSON with the name of a file after its
 * language is that file for the commands; each is read by `plan`.
 */
import { spawnSync } from "node:child_process";
import {
  mkdirSync,
  mkdtempSync,
  readFileSync,
  readdirSync,
  rmSync,
  symlinkSync,
  writeFileSync,
} from "node:fs";
import { tmpdir } from "node:os";
import path from "node:path";
import { afterAll, beforeAll, describe, expect, it } from "vitest";
import { ROOT } from "../../scripts/setup.mjs";
import { startServerProcess, type ServerProcess } from "../support/processes/server-process.js";

/**
 * Without the references that are generated: they have signatures instead of examples, and test/server/cli/reference.test.ts
 * runs the commands in the generated part of docs/cli.md. recipes.test.ts runs the recipes.
 */
const TESTED_ELSEWHERE = ["library-reference.md", "http-reference.md", "cli.md", "recipes.md"];
const DOCUMENTS = [
  "README.md",
  "CONTRIBUTING.md",
  ...readdirSync(path.join(ROOT, "docs"))
    .filter((name) => name.endsWith(".md") && !TESTED_ELSEWHERE.includes(name))
    .map((name) => `docs/${name}`),
];
/** A new example that is not run is a decision: change this number with it. */
const NO_RUN_COUNT = 51;
/** For the commands: large enough for every option in them, and plotted in a moment. */
const DRAWING = `<svg xmlns="http://www.w3.org/2000/svg" width="60mm" height="40mm" viewBox="0 0 60 40"><path d="M5 5H50V30" fill="none" stroke="#000"/></svg>`;

interface Example {
  readonly name: string;
  readonly language: string;
  readonly file: string;
  readonly code: string;
  readonly isRun: boolean;
}

function examplesOf(document: string): Example[] {
  const text = readFileSync(path.join(ROOT, document), "utf8");
  return [...text.matchAll(/^```(ts|js|sh)( no-run)?\n([\s\S]*?)^```/gm)].map((match, i) => {
    const [, language = "", mark, code = ""] = match;
    const lineNumber = text.slice(0, match.index).split("\n").length;
    const stem = document.replace(/\W+/g, "-").toLowerCase();
    const file = `${stem}-${i + 1}.${language}`;
    return { name: `${document} line ${lineNumber}`, language, file, code, isRun: mark === undefined };
  });
}

interface JsonFile {
  readonly document: string;
  readonly name: string;
  readonly text: string;
}

function jsonFilesOf(document: string): JsonFile[] {
  const text = readFileSync(path.join(ROOT, document), "utf8");
  return [...text.matchAll(/^```json (\S+)\n([\s\S]*?)^```/gm)].map(([, name = "", json = ""]) => ({
    document,
    name,
    text: json,
  }));
}

const jsonFiles = DOCUMENTS.flatMap(jsonFilesOf);
const allExamples = DOCUMENTS.flatMap(examplesOf);
const run = allExamples.filter(({ isRun }) => isRun);
const examples = run.filter(({ language }) => language !== "sh");
const commandBlocks = run.filter(({ language }) => language === "sh");
/** Where the compiler writes the examples in TypeScript. */
const COMPILED = "compiled";
const folder = mkdtempSync(path.join(tmpdir(), "plotwright-examples-"));

let compilerOutput: string;

beforeAll(() => {
  mkdirSync(path.join(folder, "data"));
  mkdirSync(path.join(folder, "node_modules"));
  symlinkSync(ROOT, path.join(folder, "node_modules", "plotwright"), "junction");
  symlinkSync(
    path.join(ROOT, "node_modules", "@types"),
    path.join(folder, "node_modules", "@types"),
    "junction",
  );
  symlinkSync(path.join(ROOT, "samples"), path.join(folder, "samples"), "junction");
  writeFileSync(path.join(folder, "drawing.svg"), DRAWING);
  for (const { name, text } of jsonFiles) writeFileSync(path.join(folder, name), text);
  writeFileSync(path.join(folder, "package.json"), '{ "type": "module" }');
  const options = {
    target: "ES2022",
    lib: ["ES2022", "DOM"],
    module: "NodeNext",
    strict: true,
    outDir: COMPILED,
    types: ["node"],
  };
  writeFileSync(
    path.join(folder, "tsconfig.json"),
    JSON.stringify({ compilerOptions: { ...options, skipLibCheck: true } }),
  );
  for (const { file, code } of examples) writeFileSync(path.join(folder, file), code);
  compilerOutput = runNode(path.join(ROOT, "node_modules/typescript/bin/tsc"), "-p", ".").stdout;
});

afterAll(() => rmSync(folder, { recursive: true, force: true }));

const runNode = (script: string, ...args: string[]) =>
  spawnSync(process.execPath, [script, ...args], { cwd: folder, encoding: "utf8" });

describe("the examples of the documents", () => {
  it("are run, except those marked as no-run", () => {
    expect(examples.length).toBeGreaterThan(10);
    expect(commandBlocks.length).toBeGreaterThan(3);
    expect(allExamples.length - run.length).toBe(NO_RUN_COUNT);
  });

  it("are in ts, js, sh or JSON", () => {
    const languages = DOCUMENTS.flatMap((document) =>
      [...readFileSync(path.join(ROOT, document), "utf8").matchAll(/^ *```(\S+)/gm)].map((match) => match[1]),
    );
    expect([...new Set(languages)].sort()).toEqual(["js", "json", "sh", "ts"]);
  });

  it("have a name of its own for each JSON file", () => {
    expect(jsonFiles.length).toBeGreaterThan(8);
    expect(new Set(jsonFiles.map(({ name }) => name)).size).toBe(jsonFiles.length);
  });

  it("name only npm scripts that exist", () => {
    const { scripts } = JSON.parse(readFileSync(path.join(ROOT, "package.json"), "utf8")) as {
      scripts: Record<string, string>;
    };
    const named = allExamples.flatMap(({ code }) =>
      [...code.matchAll(/npm (?:run ([\w:-]+)|(start|test)\b)/g)].map((match) => match[1] ?? match[2] ?? ""),
    );
    expect(named.length).toBeGreaterThan(5);
    expect(named.filter((name) => scripts[name] === undefined)).toEqual([]);
  });

  it("have correct types", () => {
    expect(compilerOutput).toBe("");
  });

  it.each(examples)("$name runs and prints the expected output", ({ file, language, code }) => {
    const script = language === "ts" ? path.join(COMPILED, file.replace(/ts$/, "js")) : file;
    const { status, stdout, stderr } = runNode(script);
    expect(stderr).toBe("");
    expect(status).toBe(0);
    const said = [...code.matchAll(/\/\/ → (.*)$/gm)].map((match) => match[1]);
    const printed = stdout.split("\n").filter((line) => line !== "");
    for (const line of said) expect(printed).toContain(line);
  });
});

/** Words of a line as a shell reads them: quotes are removed, and a comment is ignored. */
const wordsOf = (line: string): string[] =>
  [...line.replace(/(^|\s)#.*$/, "").matchAll(/'([^']*)'|"([^"]*)"|(\S+)/g)].map(
    ([, single, double, plain]) => single ?? double ?? plain ?? "",
  );

describe("the commands of the documents", () => {
  let server: ServerProcess;
  /** The id that the last response had, for the word ID in the next line. */
  let lastId = "ID";
  beforeAll(async () => {
    server = await startServerProcess({ dataDir: path.join(folder, "server") });
  });
  afterAll(() => server.stop());

  it.each(commandBlocks)("all commands of $name work", ({ code }) => {
    for (const line of code.trim().split("\n")) {
      const [program = "", ...args] = wordsOf(line);
      const { status, stdout, stderr } = program === "curl" ? runCurl(args) : runPlotwright(program, args);
      expect(`${line}: ${status} ${status === 0 ? "" : stderr}${stdout}`).toContain(`${line}: 0 `);
    }
  });

  it.each(jsonFiles)("have $name of $document, which plan reads", ({ name, text }) => {
    const json = JSON.parse(text) as Record<string, unknown>;
    const isDrawing = "layers" in json;
    const option = "controller" in json ? "--machine-file" : "--config";
    const args = isDrawing ? [name] : ["drawing.svg", option, name];
    const { status, stderr } = runPlotwright("plotwright", ["plan", ...args]);
    expect(`${status} ${stderr}`).toBe("0 ");
  });

  /** Draws on the virtual board. */
  function runPlotwright(program: string, args: string[]) {
    expect(program).toBe("plotwright");
    const data = ["--data", path.join(folder, "data")];
    const board = ["--device", "virtual", "--virtual-speed", "100", ...data];
    const withoutBoard: Readonly<Record<string, string[]>> = {
      plan: [],
      devices: [],
      logs: data,
      settings: data,
    };
    const additions = (args.includes("--device") ? board.slice(2) : withoutBoard[args[0]]) ?? board;
    // What `settings` stores must not reach the other examples, nor the user who runs the tests.
    const config = path.join(folder, args[0] === "settings" ? "stored" : "none");
    return spawnSync(process.execPath, [path.join(ROOT, "dist/server/main.js"), ...args, ...additions], {
      cwd: folder,
      encoding: "utf8",
      env: { ...process.env, XDG_CONFIG_HOME: config, APPDATA: config },
    });
  }

  function runCurl(args: string[]) {
    const isEndless = args.includes("-N");
    const filled = args.map((arg) =>
      arg.replace("http://127.0.0.1:9080", server.url).replace(/\bID\b/, lastId),
    );
    const limit = isEndless ? ["--max-time", "2"] : [];
    const result = spawnSync("curl", ["--silent", "--show-error", "--fail", ...limit, ...filled], {
      cwd: folder,
      encoding: "utf8",
    });
    lastId = /"id":"([^"]+)"/.exec(result.stdout)?.[1] ?? lastId;
    // curl's code for its time limit: the stream was open until then.
    return isEndless && result.status === 28 ? { ...result, status: 0 } : result;
  }
});
