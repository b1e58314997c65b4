/** The generated parts of docs/*.md: between `<!-- name -->` and `<!-- /name -->`. */
import { readFileSync, writeFileSync } from "node:fs";
import path from "node:path";

export const DOCS = path.join(import.meta.dirname, "..", "docs");

export function writePart(file: string, name: string, part: string): void {
  const at = path.join(DOCS, file);
  const { before, after } = readPart(file, name);
  writeFileSync(at, `${before}\n${part}\n\n${after}`);
}

/** What is between the markers, without the empty lines there; with what is before and after it in the file. */
export function readPart(file: string, name: string): { before: string; part: string; after: string } {
  const document = readFileSync(path.join(DOCS, file), "utf8");
  const begin = `<!-- ${name} -->\n`;
  const [from, to] = [document.indexOf(begin), document.indexOf(`<!-- /${name} -->`)];
  if (from < 0 || to < 0) throw new Error(`docs/${file} has no part ${name}`);
  const start = from + begin.length;
  return {
    before: document.slice(0, start),
    part: document.slice(start, to).trim(),
    after: document.slice(to),
  };
}

/**
 * Columns are padded as prettier does.
 *
 * @param numbersFrom from this column on, cells are aligned right
 */
export function markdownTable(rows: readonly (readonly string[])[], numbersFrom = Infinity): string {
  const widths = rows[0].map((_, column) => Math.max(3, ...rows.map((row) => row[column].length)));
  const line = (cells: readonly string[]): string => {
    const padded = cells.map((cell, i) =>
      i < numbersFrom ? cell.padEnd(widths[i]) : cell.padStart(widths[i]),
    );
    return `| ${padded.join(" | ")} |`;
  };
  const rule = widths.map((width, i) => (i < numbersFrom ? "-".repeat(width) : `${"-".repeat(width - 1)}:`));
  return [line(rows[0]), `| ${rule.join(" | ")} |`, ...rows.slice(1).map(line)].join("\n");
}
