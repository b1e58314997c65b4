/** The settings of the command line as a Markdown table, from the settings tables. */
import { aboutOf, SETTING_FLAGS, flagInWords, valuesInWords } from "../src/internal.js";
import { markdownTable } from "./doc-parts.js";

export function settingsTable(): string {
  const rows = SETTING_FLAGS.map((setting) => {
    const { flag, row } = setting;
    const off = row.kind === "switch" ? `, \`${flag.replace("--", "--no-")}\`` : "";
    return [`\`${flagInWords(setting).replaceAll("|", "\\|")}\`${off}`, aboutOf(row), valuesInWords(setting)];
  });
  return markdownTable([["option", "meaning", "values"], ...rows]);
}
