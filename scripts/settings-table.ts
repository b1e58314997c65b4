/** The settings of the command line as a Markdown table, from the settings tables. */
import { SETTING_FLAGS, flagInWords, valuesInWords } from "../src/internal.js";

export function settingsTable(): string {
  const rows = SETTING_FLAGS.map((setting) => {
    const { flag, row } = setting;
    const off = row.kind === "switch" ? `, \`${flag.replace("--", "--no-")}\`` : "";
    return [`\`${flagInWords(setting).replaceAll("|", "\\|")}\`${off}`, row.about, valuesInWords(setting)];
  });
  return markdownTable([["option", "meaning", "values"], ...rows]);
}

/** Columns are padded as prettier does. */
export function markdownTable(rows: readonly (readonly string[])[]): string {
  const widths = rows[0].map((_, column) => Math.max(...rows.map((row) => row[column].length)));
  const line = (cells: readonly string[]): string =>
    `| ${cells.map((cell, column) => cell.padEnd(widths[column])).join(" | ")} |`;
  const rule = `| ${widths.map((width) => "-".repeat(width)).join(" | ")} |`;
  return `${[line(rows[0]), rule, ...rows.slice(1).map(line)].join("\n")}`;
}
