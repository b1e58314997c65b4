/** The commands of the command line as Markdown, from the program's own help. */
import { Readable } from "node:stream";
import type { Command, Option } from "commander";
import { COMMANDS } from "../server/cli/commands.js";
import { buildProgram } from "../server/cli/program.js";
import { SETTING_OPTIONS } from "../server/cli/setting-table.js";
import { markdownTable } from "./doc-parts.js";

const NO_IO = {
  out: () => undefined,
  err: () => undefined,
  isTerminal: false,
  status: () => undefined,
  hasKeyboard: false,
  onInterrupt: () => () => undefined,
  endWithin: () => undefined,
  onLine: () => () => undefined,
  inputLines: () => Readable.from([]),
};

export async function cliReference(): Promise<string> {
  const names = COMMANDS.map(({ name }) => name);
  const program = await buildProgram(names, { io: NO_IO, version: "", setExitCode: () => undefined });
  return COMMANDS.map(({ name, about, examples }) => {
    const command = program.commands.find((one) => one.name() === name)!;
    return [`### ${name}`, `${sentence(about)}`, fence(examples), ...partsOf(command)].join("\n\n");
  }).join("\n\n");
}

function partsOf(command: Command): string[] {
  const subs = command.commands.filter((one) => one.name() !== "help");
  if (subs.length > 0)
    return subs.flatMap((one) => [`\`${usage(one)}\`: ${one.description()}.`, ...optionsOf(one)]);
  const takes = command.registeredArguments.map((one) => [
    `\`${one.required ? `<${one.name()}>` : `[${one.name()}]`}\``,
    one.description,
  ]);
  return [...(takes.length === 0 ? [] : [markdownTable([["takes", ""], ...takes])]), ...optionsOf(command)];
}

function optionsOf(command: Command): string[] {
  const own = command.options.filter((option) => !option.hidden && !isSetting(option));
  const settings = command.options.filter(isSetting);
  const table = own.length === 0 ? [] : [markdownTable([["option", "meaning"], ...own.map(row)])];
  if (settings.length === 0) return table;
  const which =
    settings.length === SETTING_OPTIONS.length
      ? "It follows all [settings](#all-settings)."
      : `[Settings](#all-settings) that it follows: ${settings.map((one) => `\`${one.long ?? ""}\``).join(", ")}.`;
  return [...table, which];
}

const isSetting = (option: Option): boolean => SETTING_OPTIONS.some(({ flags }) => flags === option.flags);

function row({ flags, description, defaultValue, envVar }: Option): string[] {
  const more = [
    ...(defaultValue === undefined || typeof defaultValue === "boolean"
      ? []
      : [`default: ${String(defaultValue)}`]),
    ...(envVar === undefined ? [] : [`environment: \`${envVar}\``]),
  ];
  return [
    `\`${flags.replaceAll("|", "\\|")}\``,
    more.length === 0 ? description : `${description} (${more.join("; ")})`,
  ];
}

const usage = (command: Command): string =>
  `plotwright ${command.parent?.name() ?? ""} ${command.name()} ${command.usage()}`.replace(/ +/g, " ");
const sentence = (text: string): string => `${text[0].toUpperCase()}${text.slice(1)}.`;
const fence = (lines: readonly string[]): string => ["```sh", ...lines, "```"].join("\n");
