/**
 * The help of a command: its options by what the user decides with them, the common ones first. The others are shown by
 * `--help-all`. Groups and common ones are from the settings tables.
 */
import { Help, type Command, type Option } from "commander";
import { SETTING_GROUPS, type SettingGroup } from "../../src/internal.js";
import { SETTING_OPTIONS, type SettingOption } from "./setting-table.js";

const HEADINGS: Readonly<Record<SettingGroup, string>> = {
  machine: "Machine:",
  paper: "Paper:",
  drawing: "Drawing:",
  lines: "Lines:",
  motion: "Motion:",
  pen: "Pen:",
};

/** Options that are no settings. Those that are not here follow under "Options:". */
const OTHER_GROUPS: Readonly<Record<string, SettingGroup>> = {
  "--machine-file": "machine",
  "--device": "machine",
  "--virtual-speed": "machine",
  "--direct": "machine",
  "--plotter": "machine",
  "--only": "drawing",
  "--pen": "drawing",
  "--font": "drawing",
};
const IN_ORDER: readonly string[] = SETTING_GROUPS.map((group) => HEADINGS[group]);

/** @param isAll for `--help-all` */
export function arrangeHelp(command: Command, isAll: boolean): void {
  command.configureHelp({ groupItems });
  for (const option of command.options) {
    const setting = settingOf(option);
    const group = setting?.group ?? OTHER_GROUPS[option.long ?? ""];
    if (group !== undefined) option.helpGroup(HEADINGS[group]);
    if (!isAll && setting !== undefined && !setting.isCommon) option.hideHelp();
  }
  const hidden = command.options.filter((one) => one.hidden).length;
  const name = pathOf(command);
  if (hidden > 0) command.addHelpText("after", `\n${hidden} more options: ${name} --help-all`);
  command.commands.forEach((sub) => arrangeHelp(sub, isAll));
}

const settingOf = ({ flags }: Option): SettingOption | undefined =>
  SETTING_OPTIONS.find((setting) => setting.flags === flags);

const pathOf = (command: Command): string =>
  command.parent === null ? command.name() : `${pathOf(command.parent)} ${command.name()}`;

/** Groups in the order of SETTING_GROUPS, then the others; within a group, the common ones first. */
function groupItems<T extends Command | Option>(
  unsorted: T[],
  visible: T[],
  groupOf: (item: T) => string,
): Map<string, T[]> {
  const rank = (item: T): number => {
    const group = IN_ORDER.indexOf(groupOf(item));
    return group < 0 ? IN_ORDER.length : group;
  };
  const isLater = (item: T): number => ("flags" in item && settingOf(item)?.isCommon === false ? 1 : 0);
  const sorted = (items: T[]): T[] => [...items].sort((a, b) => rank(a) - rank(b) || isLater(a) - isLater(b));
  return Help.prototype.groupItems(sorted(unsorted), sorted(visible), groupOf);
}
