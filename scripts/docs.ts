/** `npm run docs`: writes what docs/*.md has from the code: parts of cli.md, and all of library-reference.md. */
import { readFileSync, writeFileSync } from "node:fs";
import path from "node:path";
import { cliReference } from "./cli-reference.js";
import { libraryReference } from "./library-reference.js";
import { settingsTable } from "./settings-table.js";

const DOCS = path.join(import.meta.dirname, "..", "docs");
const CLI_DOC = path.join(DOCS, "cli.md");

const text = readFileSync(CLI_DOC, "utf8");
writeFileSync(
  CLI_DOC,
  withPart(withPart(text, "settings", settingsTable()), "commands", await cliReference()),
);
writeFileSync(path.join(DOCS, "library-reference.md"), (await libraryReference()).markdown);

function withPart(document: string, name: string, part: string): string {
  const begin = `<!-- ${name} -->\n`;
  const end = `<!-- /${name} -->`;
  const [from, to] = [document.indexOf(begin), document.indexOf(end)];
  if (from < 0 || to < 0) throw new Error(`docs/cli.md has no part ${name}`);
  return `${document.slice(0, from)}${begin}\n${part}\n\n${document.slice(to)}`;
}
