/** What the package gives to a program that uses it: in an editor, and when a bundler packs it. */
import { mkdirSync, mkdtempSync, rmSync, symlinkSync } from "node:fs";
import { tmpdir } from "node:os";
import path from "node:path";
import { gzipSync } from "node:zlib";
import { build } from "esbuild";
import ts from "typescript-6";
import { afterAll, beforeAll, describe, expect, it } from "vitest";
import { ROOT } from "../../scripts/setup.mjs";
import { MACHINES, PAPER_SIZES } from "../../src/index.js";
import { aboutOf, rangeInWords } from "../../src/internal.js";
import { SETTINGS_TABLES } from "../../src/settings/tables.js";

const folder = mkdtempSync(path.join(tmpdir(), "plotwright-consumer-"));
beforeAll(() => {
  mkdirSync(path.join(folder, "node_modules"));
  symlinkSync(ROOT, path.join(folder, "node_modules", "plotwright"), "junction");
});
afterAll(() => rmSync(folder, { recursive: true, force: true }));

const file = path.join(folder, "program.ts");
/** What is in the editor now. */
let shown = { text: "", version: 0 };
const editor = ts.createLanguageService({
  getScriptFileNames: () => [file],
  getScriptVersion: (name) => (name === file ? String(shown.version) : "1"),
  getScriptSnapshot: (name) => {
    const content = name === file ? shown.text : ts.sys.readFile(name);
    return content === undefined ? undefined : ts.ScriptSnapshot.fromString(content);
  },
  getCurrentDirectory: () => folder,
  getCompilationSettings: () => ({
    target: ts.ScriptTarget.ES2022,
    lib: ["lib.es2022.d.ts"],
    module: ts.ModuleKind.NodeNext,
    strict: true,
    types: [],
  }),
  getDefaultLibFileName: (chosen) => ts.getDefaultLibFilePath(chosen),
  fileExists: (name) => name === file || ts.sys.fileExists(name),
  readFile: (name) => ts.sys.readFile(name),
  directoryExists: (name) => ts.sys.directoryExists(name),
  getDirectories: (name) => ts.sys.getDirectories(name),
  realpath: (name) => ts.sys.realpath?.(name) ?? name,
});

/** Opens a program in which each `|` is a place of the cursor; returns the places. */
function open(program: string): number[] {
  const parts = program.split("|");
  shown = { text: parts.join(""), version: shown.version + 1 };
  return parts.slice(1).map((_, i) => parts.slice(0, i + 1).join("").length);
}

/** What the editor shows at each place. */
const hovers = (program: string): string[] =>
  open(program).map((at) => ts.displayPartsToString(editor.getQuickInfoAtPosition(file, at)?.documentation));

const completions = (program: string): string[] =>
  open(program).flatMap(
    (at) =>
      editor
        .getCompletionsAtPosition(file, at, {})
        ?.entries.map(({ name }) => name)
        .sort() ?? [],
  );

function faults(program: string): string[] {
  open(program);
  return editor
    .getSemanticDiagnostics(file)
    .map(({ messageText }) => ts.flattenDiagnosticMessageText(messageText, "\n"));
}

/** "a.b" to "{ a: { |b: null! } }". */
const nested = (at: string): string =>
  at
    .split(".")
    .reverse()
    .reduce((inner, key, i) => `{ ${i === 0 ? "|" : ""}${key}: ${inner} }`, "null!");

const WITH_IMPORTS = `import { planSvg } from "plotwright"; import type { GivenSettings } from "plotwright/schema";`;
const planned = (at: string): string => `planSvg("", ${nested(at)});`;
const stored = (at: string): string => `(): GivenSettings => (${nested(at)});`;

const ROWS = Object.entries(SETTINGS_TABLES).flatMap(([at, table]) =>
  Object.entries(table).map(([key, row]) => ({ at: at === "" ? key : `${at}.${key}`, row })),
);

describe("the types of the settings", () => {
  it.each([
    ["prepare.marginMm", "Free edge around the drawing (0 to 1000 mm). Default 15."],
    ["prepare.order", 'Order of strokes. Default "fast".'],
    [
      "prepare.hatch.spacingMm",
      "Fill areas with lines this far apart; 0 leaves them empty (0 to 100 mm). Default 0.",
    ],
    ["prepare.margins.topMm", "Free edge at the top of the paper (0 to 1000 mm)."],
    ["prepare.paper.widthMm", "Width of the paper in portrait (1 to 5000 mm). Default 210."],
    ["motion.draw.speedMmPerS", "Maximum speed, pen down (more than 0, up to 1000 mm/s). Default 50."],
    ["motion.travel.speedMmPerS", "Maximum speed, pen up (more than 0, up to 1000 mm/s). Default 150."],
    [
      "motion.ease.lengthMm",
      "Length of the slow start and end of every stroke (more than 0, up to 1000 mm). Default 1.5.",
    ],
    [
      "motion.accelXMmPerS2",
      "Maximum acceleration along x, pen down and up (more than 0, up to 50000 mm/s²). Null or left out: only the limits of the whole motion apply.",
    ],
    [
      "pen.dropPctPerS",
      "How fast the pen is lowered (more than 0, up to 10000 %/s). Null or left out: as fast as the servo can.",
    ],
    ["pen.layers.ink.upPct", "Height while travelling (0 to 100 %)."],
    [
      "customMachine.springs.xHz",
      "Frequency at which the machine swings along x, from the ringing sheet (2 to 200 Hz).",
    ],
  ])("say at %s what it means, in which unit and range, and its default", (at, text) => {
    expect(hovers(`${WITH_IMPORTS} ${planned(at)} ${stored(at)}`)).toEqual([text, text]);
  });

  it("say it at every row of the settings tables", () => {
    expect(ROWS.length).toBeGreaterThan(40);
    // planSvg sends nothing, so it takes no `sendAheadMs`.
    const inPlan = ROWS.filter(({ at }) => at !== "sendAheadMs");
    const calls = [...inPlan.map(({ at }) => planned(at)), ...ROWS.map(({ at }) => stored(at))];
    const texts = hovers([WITH_IMPORTS, ...calls].join("\n"));
    expect(texts.length).toBe(calls.length);
    [...inPlan, ...ROWS].forEach(({ at, row }, i) => {
      expect(`${at}: ${texts[i].toLowerCase()}`).toContain(aboutOf(row).toLowerCase());
      if (row.kind === "number") expect(texts[i]).toContain(rangeInWords(row));
      expect(texts[i]).toContain(`Default ${JSON.stringify(row.default)}`);
    });
  });
});

describe("an editor offers", () => {
  const ids = MACHINES.map(({ id }) => id);

  it.each([
    ["planSvg", 'import { planSvg } from "plotwright"; planSvg("", { machine: "|" });'],
    ["machineById", 'import { machineById } from "plotwright"; machineById("|");'],
    [
      "a job",
      'import type { PlotSettings } from "plotwright/schema"; export const id: PlotSettings["machine"] = "|";',
    ],
  ])("the plotters for %s", (_call, program) => {
    expect(completions(program)).toEqual([...ids].sort());
  });

  it("the papers", () => {
    const program = 'import { PAPER_SIZES } from "plotwright"; export const size = PAPER_SIZES["|"];';
    expect(completions(program)).toEqual(Object.keys(PAPER_SIZES).sort());
  });

  it("the values of a choice", () => {
    const program = 'import { planSvg } from "plotwright"; planSvg("", { prepare: { order: "|" } });';
    expect(completions(program)).toEqual(["best", "fast", "none"]);
  });
});

describe("the compiler", () => {
  it("takes the id of a custom machine, and one that is only known when the program runs", () => {
    const program = `import { machineById, planSvg } from "plotwright";
      const mine = { ...machineById("axidraw-v3"), id: "mine" };
      export const plan = (id: string) => [planSvg("", { machine: "mine", customMachine: mine }), planSvg("", { machine: id })];|`;
    expect(faults(program)).toEqual([]);
  });

  it("refuses a value that a choice does not have, and a misspelt setting", () => {
    const call = (settings: string): string[] =>
      faults(`import { planSvg } from "plotwright"; planSvg("", ${settings});|`);
    expect(call('{ prepare: { order: "quick" } }')).toEqual([expect.stringContaining('"quick"')]);
    expect(call("{ prepare: { marginMM: 5 } }")).toEqual([expect.stringContaining("marginMM")]);
    expect(call("{ motion: { draw: { speed: 5 } } }")).toEqual([expect.stringContaining("speed")]);
  });
});

describe("a bundler of a program", () => {
  /** kB of code, minified and gzipped, that a program loads at once which only re-exports these names. */
  async function firstLoadKb(names: string): Promise<number> {
    const { metafile, outputFiles } = await build({
      stdin: { contents: `export { ${names} } from "plotwright";`, resolveDir: folder },
      bundle: true,
      splitting: true,
      minify: true,
      format: "esm",
      outdir: folder,
      write: false,
      metafile: true,
      logLevel: "error",
    });
    const entry = Object.keys(metafile.outputs).find(
      (name) => metafile.outputs[name].entryPoint === "<stdin>",
    )!;
    const loaded = new Set([entry]);
    for (const name of loaded) {
      const atOnce = metafile.outputs[name].imports.filter(({ kind }) => kind === "import-statement");
      for (const { path: next } of atOnce) loaded.add(next);
    }
    const sizes = [...loaded].map((name) => {
      const file = outputFiles.find((one) => one.path.endsWith(path.basename(name)))!;
      return gzipSync(file.contents, { level: 9 }).length;
    });
    return sizes.reduce((sum, size) => sum + size, 0) / 1000;
  }

  it.each([
    ["PAPER_SIZES", 2],
    ["MACHINES, machineById", 2],
    ["DEFAULT_MOTION, DEFAULT_PEN, DEFAULT_PREPARE", 6],
    ["stateAt, trajectoryStats", 6],
    ["plan, VirtualBoard", 40],
    ["planSvg", 120],
  ])("takes for %s at most %d kB", async (names, limitKb) => {
    const kb = await firstLoadKb(names);
    expect(kb).toBeGreaterThan(0.2);
    expect(kb).toBeLessThanOrEqual(limitKb);
  });
});
