/** `npm run docs`: writes the parts of docs/*.md that are made from the code. */
import { readFileSync, writeFileSync } from "node:fs";
import path from "node:path";
import { cliReference } from "./cli-reference.js";
import { settingsTable } from "./settings-table.js";

const CLI_DOC = path.join(import.meta.dirname, "..", "docs", "cli.md");

const text = readFileSync(CLI_DOC, "utf8");
writeFileSync(
  CLI_DOC,
  withPart(withPart(text, "settings", settingsTable()), "commands", await cliReference()),
);

function withPart(document: string, name: string, part: string): string {
  const begin = `<!-- ${name} -->\n`;
  const end = `<!-- /${name} -->`;
  const [from, to] = [document.indexOf(begin), document.indexOf(end)];
  if (from < 0 || to < 0) throw new Error(`docs/cli.md has no part ${name}`);
  return `${document.slice(0, from)}${begin}\n${part}\n\n${document.slice(to)}`;
}
