/** Completes the settings of `prepare` with their defaults, and rejects unknown names and invalid values. */
import { checkNames, refuseSetting } from "../check-arguments.js";
import { DEFAULT_PREPARE, HATCH_TABLE, PREPARE_TABLE, type PrepareSettings } from "../settings/prepare.js";
import { PAPER_TABLE } from "../settings/placement.js";
import {
  AUTO,
  isAllowed,
  orAutoInWords,
  rangeInWords,
  takesAuto,
  type Setting,
  type SettingsTable,
} from "../settings/setting.js";

const NAMES = [...Object.keys(DEFAULT_PREPARE), "layerShifts"];
const LISTS = ["hiddenLayers", "shownLayers", "layerOrder", "layerHatches"] as const;
const EXAMPLE_PAPER = "a size such as PAPER_SIZES.A4 or { widthMm: 210, heightMm: 297 }";

/** @throws PlotwrightError "bad-setting", naming the setting, its value and what is allowed */
export function completeSettings(settings: Partial<PrepareSettings>): PrepareSettings {
  checkNames("prepare", settings, NAMES);
  const given = Object.fromEntries(Object.entries(settings).filter(([, value]) => value !== undefined));
  const complete: PrepareSettings = { ...DEFAULT_PREPARE, ...given };
  checkTable("prepare ", PREPARE_TABLE, complete);
  for (const name of LISTS) {
    if (!Array.isArray(complete[name])) refuseSetting(`prepare ${name}`, complete[name], "a list");
  }
  if (typeof complete.paper !== "object" || (complete.paper as unknown) === null)
    refuseSetting("prepare paper", complete.paper, EXAMPLE_PAPER);
  checkTable("prepare paper.", PAPER_TABLE, complete.paper);
  checkNames("hatch", complete.hatch, Object.keys(HATCH_TABLE));
  const hatch = { ...DEFAULT_PREPARE.hatch, ...complete.hatch };
  checkTable("prepare hatch.", HATCH_TABLE, hatch);
  return { ...complete, hatch };
}

function checkTable<Table extends SettingsTable>(
  at: string,
  table: Table,
  values: Readonly<Record<keyof Table, unknown>>,
): void {
  for (const [key, row] of Object.entries(table)) {
    const value = values[key];
    if (takesAuto(row)) checkOrAuto(at + key, row, value);
    else if (row.kind === "number") {
      if (!isAllowed(row, value as number)) refuseSetting(at + key, value, rangeInWords(row));
    } else if (row.kind === "switch") {
      if (typeof value !== "boolean") refuseSetting(at + key, value, "true or false");
    } else if (!row.choices.includes(value as string)) {
      refuseSetting(at + key, value, `one of ${row.choices.join(", ")}`);
    }
  }
}

function checkOrAuto(name: string, row: Setting, value: unknown): void {
  const isFit = row.kind === "number" ? isAllowed(row, value as number) : typeof value === "boolean";
  if (value !== AUTO && !isFit) refuseSetting(name, value, orAutoInWords(row));
}
