/** `npm run docs`: writes the tables of docs/*.md that are made from the code. */
import { readFileSync, writeFileSync } from "node:fs";
import path from "node:path";
import { settingsTable } from "./settings-table.js";

export const CLI_DOC = path.join(import.meta.dirname, "..", "docs", "cli.md");

writeFileSync(CLI_DOC, withSettingsTable(readFileSync(CLI_DOC, "utf8")));

function withSettingsTable(text: string): string {
  return text.replace(
    /(<!-- settings -->\n)[\s\S]*?(<!-- \/settings -->)/,
    (_, begin: string, end: string) => `${begin}\n${settingsTable()}\n${end}`,
  );
}
