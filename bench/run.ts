/**
 * `npm run bench [-- NAME… --write]`: runs bench/NAME.bench.ts (all of them without names) and prints their
 * results as Markdown tables. `--write` also puts each table into its section of docs/benchmarks.md.
 */
import { readFileSync, readdirSync, writeFileSync } from "node:fs";
import { cpus } from "node:os";
import { pathToFileURL } from "node:url";
import path from "node:path";

export type Row = Readonly<Record<string, string | number>>;
/** Called by a benchmark once per table: a stable section name, the rows, and notes about this run. */
export type Report = (section: string, rows: readonly Row[], note?: string) => void;
export type Benchmark = (report: Report) => Promise<void>;

const FOLDER = import.meta.dirname;
const DOCUMENT = path.join(FOLDER, "..", "docs", "benchmarks.md");
/** Minutes of real time: `npm run bench:stream`. */
const ONLY_BY_NAME = new Set(["stream"]);

function markdownTable(rows: readonly Row[]): string {
  const columns = [...new Set(rows.flatMap((row) => Object.keys(row)))];
  const cells = [columns, ...rows.map((row) => columns.map((column) => String(row[column] ?? "")))];
  const widths = columns.map((_, i) => Math.max(3, ...cells.map((line) => line[i]?.length ?? 0)));
  const isNumber = columns.map((column) => rows.every((row) => typeof (row[column] ?? 0) === "number"));
  const write = (line: readonly string[]): string =>
    `| ${line.map((cell, i) => (isNumber[i] ? cell.padStart(widths[i] ?? 0) : cell.padEnd(widths[i] ?? 0))).join(" | ")} |`;
  const rule = `| ${widths.map((width, i) => "-".repeat(isNumber[i] ? width - 1 : width) + (isNumber[i] ? ":" : "")).join(" | ")} |`;
  return [write(columns), rule, ...cells.slice(1).map(write)].join("\n");
}

/** Puts a table between its two marks; adds a section that does not exist at the end. */
export function withSection(document: string, section: string, table: string): string {
  const begin = `<!-- bench: ${section} -->`;
  const end = "<!-- /bench -->";
  const block = `${begin}\n\n${table}\n\n${end}`;
  const from = document.indexOf(begin);
  if (from < 0) return `${document.trimEnd()}\n\n## ${section}\n\n${block}\n`;
  const until = document.indexOf(end, from);
  if (until < 0) throw new Error(`docs/benchmarks.md: ${begin} has no ${end} after it`);
  return document.slice(0, from) + block + document.slice(until + end.length);
}

const date = (): string => new Date().toISOString().slice(0, 10);

async function main(args: readonly string[]): Promise<void> {
  const isWriting = args.includes("--write");
  const names = args.filter((arg) => !arg.startsWith("--"));
  const all = readdirSync(FOLDER)
    .filter((file) => file.endsWith(".bench.ts"))
    .map((file) => file.slice(0, -".bench.ts".length))
    .sort();
  const unknown = names.filter((name) => !all.includes(name));
  if (unknown.length > 0)
    throw new Error(`no such benchmark: ${unknown.join(", ")} (there are: ${all.join(", ")})`);
  const chosen = names.length > 0 ? names : all.filter((name) => !ONLY_BY_NAME.has(name));

  const cpuModel = cpus()[0]?.model ?? "unknown processor";
  console.log(`Node ${process.versions.node}, ${cpus().length} × ${cpuModel}\n`);
  for (const name of chosen) {
    const module = (await import(pathToFileURL(path.join(FOLDER, `${name}.bench.ts`)).href)) as {
      default: Benchmark;
    };
    await module.default((section, rows, note) => {
      const about = note === undefined ? "" : `${note} ${date()}, Node ${process.versions.node}.\n\n`;
      const table = about + markdownTable(rows);
      console.log(`## ${section}\n\n${table}\n`);
      if (isWriting) writeFileSync(DOCUMENT, withSection(readFileSync(DOCUMENT, "utf8"), section, table));
    });
  }
}

await main(process.argv.slice(2));
