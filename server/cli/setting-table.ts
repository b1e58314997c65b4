/** The settings that have an option on the command line: the flag, the path of its value, and its parser. */
import { InvalidArgumentError } from "commander";
import { PAPER_SIZES } from "../../src/index.js";
import {
  aboutOf,
  SETTING_FLAGS,
  flagInWords,
  parseSize,
  valuesInWords,
  type SettingFlag,
  type SettingGroup,
  type FourMargins,
  type PaperSize,
  type PlacedBox,
} from "../../src/internal.js";
import { length, number } from "./options.js";

export interface SettingOption {
  readonly flags: string;
  readonly about: string;
  /** Path in PlotSettings. */
  readonly path: string;
  readonly group: SettingGroup;
  readonly isCommon: boolean;
  readonly parse?: (text: string) => unknown;
  readonly choices?: readonly string[];
}

/** Settings whose value is more than one number, switch or choice. */
const STRUCTURED: readonly SettingOption[] = [
  {
    flags: "--machine <id>",
    path: "machine",
    group: "machine",
    isCommon: true,
    about: "plotter model (default axidraw-v3; for add and moves by hand: the server's plotter)",
  },
  {
    flags: "--paper <size>",
    path: "prepare.paper",
    group: "paper",
    isCommon: true,
    about: "A4, A3, Letter, … or WIDTHxHEIGHT in mm, or as in 8.5x11in (default A4)",
    parse: paper,
  },
  {
    flags: "--margins <mm,mm,mm,mm>",
    path: "prepare.margins",
    group: "paper",
    isCommon: false,
    about: "top, right, bottom, left (default: --margin on all sides)",
    parse: fourMargins,
  },
  {
    flags: "--place <x,y[,w,h]>",
    path: "prepare.layout",
    group: "paper",
    isCommon: false,
    about: "the drawing's own box, mm from the paper's corner (default: see --fit)",
    parse: place,
  },
];

/** From the settings tables. A switch is on with its flag and off with its "--no-" flag. */
function optionsOf(setting: SettingFlag): SettingOption[] {
  const { path, group, flag, row } = setting;
  const common = { path, group, isCommon: row.isCommon === true };
  const about = `${aboutOf(row)} (${valuesInWords(setting)})`;
  if (row.kind === "number") {
    const parse = row.unit === "mm" ? length : number;
    return [{ ...common, flags: flagInWords(setting), about, parse }];
  }
  if (row.kind === "choice") return [{ ...common, flags: `${flag} <how>`, about, choices: row.choices }];
  return [
    { ...common, flags: flag, about },
    {
      ...common,
      isCommon: common.isCommon && row.aboutOff !== undefined,
      flags: flag.replace("--", "--no-"),
      about: row.aboutOff ?? "switch that off",
    },
  ];
}

export const SETTING_OPTIONS: readonly SettingOption[] = [...STRUCTURED, ...SETTING_FLAGS.flatMap(optionsOf)];

/** The option with that name, without its hyphens. */
export const optionOf = (name: string): SettingOption | undefined =>
  SETTING_OPTIONS.find(({ flags }) => flags.split(" ")[0] === `--${name}` && !name.startsWith("no-"));

/** The option for the setting at that path. */
export const optionAt = (path: string): SettingOption | undefined =>
  SETTING_OPTIONS.find((option) => option.path === path);

const NAMED_SIZES: readonly unknown[] = Object.values(PAPER_SIZES);

/** A size in numbers: its own orientation applies. */
export const isOwnSize = (size: unknown): size is PaperSize =>
  size !== undefined && !NAMED_SIZES.includes(size);

function numbers(text: string, counts: readonly number[]): number[] {
  const parts = text.split(",");
  if (!counts.includes(parts.length)) {
    throw new InvalidArgumentError(
      `It must be ${counts.join(", ").replace(/, (\d+)$/, " or $1")} lengths with commas between.`,
    );
  }
  return parts.map(length);
}

function fourMargins(text: string): FourMargins {
  const [topMm, rightMm, bottomMm, leftMm] = numbers(text, [4]) as [number, number, number, number];
  return { topMm, rightMm, bottomMm, leftMm };
}

function place(text: string): PlacedBox {
  const [xMm, yMm, widthMm, heightMm] = numbers(text, [2, 3, 4]) as [number, number, number?, number?];
  return { xMm, yMm, widthMm: widthMm ?? null, heightMm: heightMm ?? null };
}

/** A name, or WIDTHxHEIGHT. */
function paper(text: string): PaperSize {
  const name = Object.keys(PAPER_SIZES).find((one) => one.toLowerCase() === text.toLowerCase());
  if (name !== undefined) return PAPER_SIZES[name as keyof typeof PAPER_SIZES];
  const size = parseSize(text);
  if (size !== null) return size;
  const names = Object.keys(PAPER_SIZES).join(", ");
  throw new InvalidArgumentError(
    `It must be one of ${names} or WIDTHxHEIGHT in mm, or as in 8.5x11in or 20x20cm.`,
  );
}
