/**
 * From the command line to PlotSettings: those of the plotter, then the file of --config, then the flags. Values are
 * checked by the same schema as the web's; an error names the flag, or the field in the file.
 */
import { Option, type Command } from "commander";
import { PlotwrightError, type MachineProfile } from "../../src/index.js";
import {
  findMachine,
  isAllowed,
  machineOf,
  QUALITY_PATH,
  rangeInWords,
  SPRINGS_PATH,
  SPRINGS_TABLE,
  withQuality,
  type Quality,
  type Springs,
} from "../../src/internal.js";
import {
  DEFAULT_PLOT_SETTINGS,
  firstFault,
  givenSettingsSchema,
  plotSettingsSchema,
  type GivenSettings,
  type PlotSettings,
} from "../../src/schema/index.js";
import {
  settingsOfPlotter,
  settingsWith,
  type StoredOfPlotter,
  type WithMachine,
} from "../../host/plotter/settings-of-plotter.js";
import { fileFault } from "../storage/file-fault.js";
import { defaultDataDir } from "../storage/data-dir.js";
import { MachineFiles, machineOfText } from "../storage/machine-files.js";
import { readText } from "./files.js";
import { NOTHING_STORED, storedPlotter } from "./stored-plotter.js";
import { SETTING_OPTIONS, isOwnSize, type SettingOption } from "./setting-table.js";

/** The option values that commander passes to an action: names in camel case. */
export type OptionValues = Readonly<Record<string, unknown>>;

/** @param parts paths of the settings that the command uses: "pen", "motion.travel". Absent: all. */
export function addSettingOptions(command: Command, parts?: readonly string[]): Command {
  const isMeant = ({ path }: SettingOption): boolean =>
    parts === undefined || parts.some((part) => path === part || path.startsWith(`${part}.`));
  for (const { flags, about, parse, choices } of SETTING_OPTIONS.filter(isMeant)) {
    const option = new Option(flags, about);
    if (choices !== undefined) option.choices(choices);
    if (parse !== undefined) option.argParser(parse);
    command.addOption(option);
  }
  return command
    .addOption(new Option("--machine-file <file>", "JSON file with the profile of your own plotter, or -"))
    .addOption(new Option("--config <file>", "JSON file with settings, or -; flags override it"));
}

/** Settings of a command, and what to tell its user about the machine; null: nothing. */
export interface FoundSettings {
  readonly settings: PlotSettings;
  readonly note: string | null;
}

/** For a command without a plotter. Throws `bad-setting` naming the flag at fault. */
export const settingsFromOptions = (values: OptionValues): PlotSettings =>
  settingsOver(values, NOTHING_STORED).settings;

/**
 * For a command that uses the plotter: its settings are those that a server on this computer has stored. Throws also
 * `busy` while that server runs.
 */
export function plotterSettingsFromOptions(values: OptionValues): FoundSettings {
  const { machine, machineFile, device = "auto" } = values;
  const stored = storedPlotter({
    dataDir: dataDirOf(values),
    device: String(device),
    isOptional: (machine ?? machineFile) !== undefined || device === "virtual",
  });
  return settingsOver(values, stored);
}

/**
 * The settings of the plotter, then the file of --config, then the flags. A model that is given by a flag is the plotter's
 * model. The model in the file is that of a job, and only counts if nothing else names one.
 *
 * @param serverMachine adds the profile of a custom machine that is not in the data folder
 */
export function settingsOver(
  values: OptionValues,
  stored: StoredOfPlotter,
  serverMachine: WithMachine = (settings) => settings,
): FoundSettings {
  const { config, machineFile, machine } = values;
  const profile =
    typeof machineFile === "string" ? fromFile("--machine-file", machineFile, machineOfText) : null;
  const given = typeof config === "string" ? readConfig(config) : {};
  const profiles = [profile, plotSettingsSchema.shape.customMachine.parse(given.customMachine ?? null)];
  const withMachine: WithMachine = (settings) => {
    const own = profiles.find((one) => one?.id === settings.machine);
    return own ? { ...settings, customMachine: own } : serverMachine(withOwnMachine(settings, values));
  };
  const named = profile?.id ?? (typeof machine === "string" ? machine : null);
  if (named !== null) machineOf(withMachine({ ...DEFAULT_PLOT_SETTINGS, machine: named }));
  const model =
    named ?? stored.machine ?? (stored.last ? null : (given.machine ?? given.customMachine?.id ?? null));
  const plotter = settingsOfPlotter({ ...stored, machine: model }, withMachine);
  const { settings, note } = inFile(config, () => settingsWith(plotter, given, withMachine));
  return { settings: withFlags(settings, values), note };
}

/** An error of the settings in the file of --config names that file. */
function inFile<T>(config: unknown, work: () => T): T {
  try {
    return work();
  } catch (cause) {
    if (typeof config !== "string" || !(cause instanceof PlotwrightError)) throw cause;
    throw new PlotwrightError(cause.code, `--config ${config}: ${cause.message}`, { cause });
  }
}

/** Throws `bad-setting` naming the flag at fault. */
function withFlags(before: PlotSettings, values: OptionValues): PlotSettings {
  const settings: Record<string, unknown> = { ...structuredClone(before) };
  const size = values["paper"];
  if (isOwnSize(size)) setPath(settings, ["prepare", "landscape"], size.widthMm > size.heightMm);
  setSprings(settings, values);
  setQuality(settings, values);
  // A motion has only one filter.
  if (values["mode"] === "scurve" && values["shaper"] === undefined)
    setPath(settings, ["motion", "shaper"], "none");
  for (const option of SETTING_OPTIONS.filter(isStored)) {
    const value = values[keyOf(option)];
    if (value !== undefined) setPath(settings, option.path.split("."), value);
  }
  const result = plotSettingsSchema.safeParse(settings);
  if (result.success) return result.data;
  const { path, words } = firstFault(result.error);
  const option = SETTING_OPTIONS.find((one) => path.startsWith(one.path) && values[keyOf(one)] !== undefined);
  const where = option?.flags.split(" ")[0] ?? path;
  throw new PlotwrightError("bad-setting", `${where}: ${words}.`);
}

/** Whether the option is part of a job's settings, and not handled before. */
const isStored = ({ path }: SettingOption): boolean =>
  path !== "machine" && path !== QUALITY_PATH && !path.startsWith(`${SPRINGS_PATH}.`);

/** Flags for the machine's swing override its profile. */
function setSprings(settings: Record<string, unknown>, values: OptionValues): void {
  const { springX, springY, damping } = values;
  if (springX === undefined && springY === undefined && damping === undefined) return;
  const machine = findMachine(settings as unknown as PlotSettings);
  if (machine === null) return;
  const known = machine.springs ?? null;
  const xHz = springX ?? known?.xHz;
  const yHz = springY ?? known?.yHz;
  if (xHz === undefined || yHz === undefined) {
    const missing = xHz === undefined ? "--spring-x" : "--spring-y";
    throw new PlotwrightError(
      "bad-setting",
      `${missing}: it is needed too, because ${machine.name} was not measured.`,
    );
  }
  const springs = { xHz, yHz, damping: damping ?? known?.damping ?? SPRINGS_TABLE.damping.default };
  for (const [key, row] of Object.entries(SPRINGS_TABLE)) {
    if (!isAllowed(row, springs[key as keyof typeof springs] as number)) {
      throw new PlotwrightError("bad-setting", `${row.flag}: it must be ${rangeInWords(row)}.`);
    }
  }
  setMachine(settings, { ...machine, springs: springs as Springs });
}

function setQuality(settings: Record<string, unknown>, values: OptionValues): void {
  const { quality } = values;
  const machine = quality === undefined ? null : findMachine(settings as unknown as PlotSettings);
  if (machine === null) return;
  const { motion } = settings as unknown as PlotSettings;
  settings["motion"] = withQuality(motion, quality as Quality, machine.springs ?? null);
}

const keyOf = (option: SettingOption): string => new Option(option.flags).attributeName();

function setPath(target: Record<string, unknown>, path: readonly string[], value: unknown): void {
  const [first = "", ...rest] = path;
  if (rest.length === 0) target[first] = value;
  else setPath(target[first] as Record<string, unknown>, rest, value);
}

function setMachine(settings: Record<string, unknown>, machine: MachineProfile): void {
  settings["machine"] = machine.id;
  settings["customMachine"] = machine;
}

/** Reads a JSON file; an error names the option and the file. */
function fromFile<T>(option: "--config" | "--machine-file", path: string, read: (text: string) => T): T {
  try {
    return read(readText(path, option));
  } catch (cause) {
    if (cause instanceof PlotwrightError) throw cause;
    const why = cause instanceof SyntaxError ? `it is not JSON (${cause.message})` : fileFault(cause);
    throw new PlotwrightError("bad-setting", `${option} ${path}: ${why}.`, { cause });
  }
}

/** Adds the profile of a custom machine that is stored in the data folder. */
const withOwnMachine = (settings: PlotSettings, values: OptionValues): PlotSettings =>
  new MachineFiles(dataDirOf(values)).withMachine(settings);

const dataDirOf = ({ data }: OptionValues): string => (typeof data === "string" ? data : defaultDataDir());

/** The settings in a file of --config, of which any part may be there. An unknown name is an error. */
function readConfig(path: string): GivenSettings {
  const value = fromFile("--config", path, (text): unknown => JSON.parse(text));
  if (typeof value !== "object" || value === null || Array.isArray(value)) {
    throw new PlotwrightError("bad-setting", `--config ${path}: it is not a JSON object.`);
  }
  const result = givenSettingsSchema.safeParse(value);
  if (result.success) return result.data;
  const { path: field, words } = firstFault(result.error);
  throw new PlotwrightError("bad-setting", `--config ${path}: ${field}: ${words}.`);
}
