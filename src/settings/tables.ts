/** All settings tables, by their path in a job's settings ("": top level). */
import { AXIS_TABLE, DRAW_TABLE, MOTION_TABLE, TRAVEL_TABLE, QUALITY_TABLE } from "./motion.js";
import { HATCH_TABLE, PREPARE_TABLE } from "./prepare.js";
import { SPRINGS_TABLE, STREAM_TABLE } from "./machine.js";
import { rangeInWords, type Setting, type SettingGroup, type SettingsTable } from "./setting.js";
import { PEN_TABLE, OVERLAP_TABLE } from "./pen.js";

export const SETTINGS_TABLES: Readonly<Record<string, SettingsTable>> = {
  prepare: PREPARE_TABLE,
  "prepare.hatch": HATCH_TABLE,
  motion: MOTION_TABLE,
  "motion.draw": DRAW_TABLE,
  "motion.travel": TRAVEL_TABLE,
  pen: { ...PEN_TABLE, ...OVERLAP_TABLE },
  "": STREAM_TABLE,
};

/** Paths of two command-line options that are not in a job's settings. */
export const SPRINGS_PATH = "springs";
export const QUALITY_PATH = "quality";
/** Tables whose rows have no default in a job's settings; `otherwise`: what applies without the option. */
const OTHER_TABLES: Readonly<Record<string, { table: SettingsTable; otherwise: string }>> = {
  motion: { table: AXIS_TABLE, otherwise: "none" },
  [SPRINGS_PATH]: { table: SPRINGS_TABLE, otherwise: "as measured" },
  "": { table: QUALITY_TABLE, otherwise: "each setting by itself" },
};

/** By the path of the table. */
const GROUP_OF_TABLE: Readonly<Record<string, SettingGroup>> = {
  prepare: "lines",
  "prepare.hatch": "drawing",
  motion: "motion",
  "motion.draw": "motion",
  "motion.travel": "motion",
  pen: "pen",
  [SPRINGS_PATH]: "machine",
  "": "machine",
};

export interface SettingFlag {
  /** Path in the settings: "prepare.marginMm". */
  readonly path: string;
  readonly group: SettingGroup;
  readonly flag: string;
  readonly row: Setting;
  /** What applies without the flag; left out: the row's default. */
  readonly otherwise?: string;
}

function flagsIn(at: string, table: SettingsTable): SettingFlag[] {
  return Object.entries(table).flatMap(([key, row]) =>
    row.flag === undefined
      ? []
      : [
          {
            path: at === "" ? key : `${at}.${key}`,
            group: row.group ?? GROUP_OF_TABLE[at],
            flag: row.flag,
            row,
          },
        ],
  );
}

export const SETTING_FLAGS: readonly SettingFlag[] = [
  ...Object.entries(SETTINGS_TABLES).flatMap(([at, table]) => flagsIn(at, table)),
  ...Object.entries(OTHER_TABLES).flatMap(([at, { table, otherwise }]) =>
    flagsIn(at, table).map((flag) => ({ ...flag, otherwise })),
  ),
];

/** An option with its value as text: "--margin <mm>", "--order <none|fast|best>", "--fit". */
export function flagInWords({ flag, row }: SettingFlag): string {
  if (row.kind === "switch") return flag;
  if (row.kind === "choice") return `${flag} <${row.choices.join("|")}>`;
  return `${flag} <${UNIT_WORDS[row.unit] ?? row.unit}>`;
}

/** Range and default as text: "0 to 1000 mm, default 15"; for a choice or a switch only the default. */
export function valuesInWords({ row, otherwise }: SettingFlag): string {
  const usual = row.kind === "switch" ? (row.default ? "on" : "off") : row.default;
  const byDefault = row.aboutAuto ? `by default ${row.aboutAuto}` : `default ${otherwise ?? usual}`;
  return row.kind === "number" ? `${rangeInWords(row)}, ${byDefault}` : byDefault;
}

const UNIT_WORDS: Readonly<Record<string, string>> = { "": "count", "°": "degrees", "%": "percent" };
