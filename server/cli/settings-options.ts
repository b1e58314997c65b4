/**
 * From the command line to PlotSettings: defaults, then the file of --config, then the flags. Values are
 * checked by the same schema as the web's; an error names the flag, or the field in the file.
 */
import { Option, type Command } from "commander";
import { PlotwrightError, type MachineProfile } from "../../src/index.js";
import {
  findMachine,
  isAllowed,
  motionOfQuality,
  QUALITY_PATH,
  rangeInWords,
  SPRINGS_PATH,
  SPRINGS_TABLE,
  type Quality,
  type Springs,
} from "../../src/internal.js";
import {
  DEFAULT_PLOT_SETTINGS,
  firstFault,
  plotSettingsSchema,
  type PlotSettings,
} from "../../src/schema/index.js";
import { fileFault } from "../storage/file-fault.js";
import { defaultDataDir } from "../storage/data-dir.js";
import { MachineFiles, machineOfText } from "../storage/machine-files.js";
import { mustBeDataFolder, readText } from "./files.js";
import { storedMachine } from "./stored-machine.js";
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

/** Throws `bad-setting` naming the flag at fault. */
export function settingsFromOptions(values: OptionValues): PlotSettings {
  const settings: Record<string, unknown> = structuredClone(DEFAULT_PLOT_SETTINGS);
  const config = values["config"];
  if (typeof config === "string") merge(settings, readConfig(config), config, "");
  const size = values["paper"];
  if (isOwnSize(size)) setPath(settings, ["prepare", "landscape"], size.widthMm > size.heightMm);
  const { machineFile, machine } = values;
  if (machine !== undefined) settings["machine"] = machine;
  if (typeof machineFile === "string")
    setMachine(settings, fromFile("--machine-file", machineFile, machineOfText));
  setSprings(settings, values);
  setQuality(settings, values);
  for (const option of SETTING_OPTIONS.filter(isStored)) {
    const value = values[keyOf(option)];
    if (value !== undefined) setPath(settings, option.path.split("."), value);
  }
  const result = plotSettingsSchema.safeParse(settings);
  if (result.success) return findMachine(result.data) ? result.data : withOwnMachine(result.data, values);
  const { path, words } = firstFault(result.error);
  const option = SETTING_OPTIONS.find((one) => path.startsWith(one.path) && values[keyOf(one)] !== undefined);
  const where = option?.flags.split(" ")[0] ?? (typeof config === "string" ? `${config}: ${path}` : path);
  throw new PlotwrightError("bad-setting", `${where}: ${words}.`);
}

/** Settings for manual moves. Without a given machine, uses that of the plotter of a server on this computer. */
export function handSettingsFromOptions(values: OptionValues): PlotSettings {
  const settings = settingsFromOptions(values);
  const { machine, machineFile, config, device } = values;
  mustBeDataFolder(typeof values["data"] === "string" ? values["data"] : undefined);
  const isGiven =
    machine !== undefined ||
    machineFile !== undefined ||
    (typeof config === "string" && "machine" in readConfig(config));
  const stored = isGiven
    ? null
    : storedMachine(dataDirOf(values), typeof device === "string" ? device : "auto");
  return stored === null ? settings : withOwnMachine({ ...settings, machine: stored }, values);
}

/** Whether the option is part of a job's settings, and not handled before. */
const isStored = ({ path }: SettingOption): boolean =>
  path !== "machine" && path !== QUALITY_PATH && !path.startsWith(`${SPRINGS_PATH}.`);

/** The machine as known so far; null if its id is unknown, which is reported later. */
function machineIn(settings: Record<string, unknown>, values: OptionValues): MachineProfile | null {
  const parsed = plotSettingsSchema.safeParse(settings);
  if (!parsed.success) return null;
  return findMachine(findMachine(parsed.data) ? parsed.data : withOwnMachine(parsed.data, values));
}

/** Flags for the machine's swing override its profile. */
function setSprings(settings: Record<string, unknown>, values: OptionValues): void {
  const { springX, springY, damping } = values;
  if (springX === undefined && springY === undefined && damping === undefined) return;
  const machine = machineIn(settings, values);
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
  const machine = quality === undefined ? null : machineIn(settings, values);
  if (machine === null) return;
  const motion = settings["motion"] as object;
  settings["motion"] = { ...motion, ...motionOfQuality(quality as Quality, machine.springs ?? null) };
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

const readConfig = (path: string): Record<string, unknown> =>
  fromFile("--config", path, (text) => {
    const value: unknown = JSON.parse(text);
    if (isRecord(value)) return value;
    throw new Error("it is not a JSON object");
  });

/** Merges the file's values into the settings. An unknown name is an error. */
function merge(
  target: Record<string, unknown>,
  over: Record<string, unknown>,
  file: string,
  at: string,
): void {
  for (const [key, value] of Object.entries(over)) {
    if (!Object.hasOwn(target, key)) {
      throw new PlotwrightError("bad-setting", `--config ${file}: there is no setting ${at}${key}.`);
    }
    const before = target[key];
    if (isRecord(before) && isRecord(value)) merge(before, value, file, `${at}${key}.`);
    else target[key] = value;
  }
}

const isRecord = (value: unknown): value is Record<string, unknown> =>
  typeof value === "object" && value !== null && !Array.isArray(value);
