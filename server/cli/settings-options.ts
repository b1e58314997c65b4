/**
 * From the command line to PlotSettings: those of the plotter, with config files, a preset and the flags laid over them.
 * Values are checked by the same schema as the web's; an error names the flag, or the field in the file.
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
  fromPreset,
  plotSettingsSchema,
  presetNamed,
  type GivenSettings,
  type PlotSettings,
} from "../../src/schema/index.js";
import {
  settingsOfPlotter,
  settingsWith,
  type StoredOfPlotter,
  type WithMachine,
} from "../../host/plotter/settings-of-plotter.js";
import { defaultDataDir } from "../storage/data-dir.js";
import { MachineFiles, machineOfText } from "../storage/machine-files.js";
import { fromFile, readConfig, readUsualConfig, usualConfigPath } from "./config-file.js";
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
    .addOption(new Option("--config <file>", "JSON file with settings, or -; flags override it"))
    .addOption(noConfig())
    .addOption(new Option("--preset <name>", "settings that are stored for the plotter under a name"));
}

/** A value of its own. Commander would take it as the opposite of --config, so that the last of both won. */
const noConfig = (): Option =>
  Object.assign(new Option("--no-config", "leave out the config file that always applies"), {
    negate: false,
  });

/** Settings of a command, and what to tell its user about the machine; null: nothing. */
export interface FoundSettings {
  readonly settings: PlotSettings;
  readonly note: string | null;
}

/** The settings after one of the things that they are laid together from. */
export interface SettingsLayer {
  /** What they are from, in words. */
  readonly source: string;
  readonly settings: PlotSettings;
  /** Settings that it names, also where they were the same before. */
  readonly given: GivenSettings;
}

/** For a command without a plotter. Throws `bad-setting` naming the flag at fault. */
export const settingsFromOptions = (values: OptionValues): PlotSettings =>
  settingsOver(values, NOTHING_STORED).settings;

/**
 * For a command that uses the plotter: its settings are those that a server on this computer has stored. Throws also
 * `busy` while that server runs.
 */
export function plotterSettingsFromOptions(values: OptionValues): FoundSettings {
  const { machine, machineFile, preset, device = "auto" } = values;
  const stored = storedPlotter({
    dataDir: dataDirOf(values),
    device: String(device),
    isOptional: preset === undefined && ((machine ?? machineFile) !== undefined || device === "virtual"),
  });
  return settingsOver(values, stored);
}

/**
 * The settings of the plotter; over them those of the config file that always applies, of --preset, of --config, and the
 * flags. A model that is given by a flag is the plotter's model. The model in a file is that of a job, and only counts if
 * nothing else names one.
 *
 * @param serverMachine adds the profile of a custom machine that is not in the data folder
 */
export function settingsOver(
  values: OptionValues,
  stored: StoredOfPlotter,
  serverMachine?: WithMachine,
): FoundSettings {
  const { layers, note } = settingsInLayers(values, stored, serverMachine);
  return { settings: layers[layers.length - 1].settings, note };
}

export interface LayeredSettings {
  /** At least one; the last one has the settings that apply. */
  readonly layers: readonly SettingsLayer[];
  /** What the machine is from: the source of its layer, or words of its own. */
  readonly machineSource: string;
  readonly note: string | null;
}

/** As `settingsOver`, step by step. */
export function settingsInLayers(
  values: OptionValues,
  stored: StoredOfPlotter,
  serverMachine: WithMachine = (settings) => settings,
): LayeredSettings {
  const { config, noConfig: isUsualLeftOut, machineFile, machine, preset } = values;
  const profile =
    typeof machineFile === "string" ? fromFile("--machine-file", machineFile, machineOfText) : null;
  const usual = isUsualLeftOut === true ? {} : readUsualConfig();
  const given = typeof config === "string" ? readConfig(config) : {};
  const profiles = [
    profile,
    ...[given, usual].map((one) => plotSettingsSchema.shape.customMachine.parse(one.customMachine ?? null)),
  ];
  const withMachine: WithMachine = (settings) => {
    const own = profiles.find((one) => one?.id === settings.machine);
    return own ? { ...settings, customMachine: own } : serverMachine(withOwnMachine(settings, values));
  };
  const named = profile?.id ?? (typeof machine === "string" ? machine : null);
  if (named !== null) machineOf(withMachine({ ...DEFAULT_PLOT_SETTINGS, machine: named }));
  const usualPath = usualConfigPath();
  const configSource = `--config ${String(config)}`;
  const models: readonly (readonly [source: string, machine: string | null | undefined])[] = [
    [profile === null ? "--machine" : "--machine-file", named],
    [PLOTTER, stored.machine],
    [LAST_JOB, stored.last?.machine],
    [configSource, machineIn(given)],
    [usualPath, machineIn(usual)],
  ];
  const [machineSource, model = null] = models.find(([, one]) => (one ?? null) !== null) ?? [DEFAULT];
  if ([usualPath, configSource].includes(machineSource)) {
    inFile(machineSource, () => machineOf(withMachine({ ...DEFAULT_PLOT_SETTINGS, machine: model ?? "" })));
  }
  // settingsOfPlotter takes the machine of the last job by itself, with its profile.
  const machineOfPlotter = machineSource === LAST_JOB ? null : model;
  const plotter = settingsOfPlotter({ ...stored, machine: machineOfPlotter }, withMachine);
  const layers: SettingsLayer[] = [
    { source: DEFAULT, settings: DEFAULT_PLOT_SETTINGS, given: {} },
    {
      source: PLOTTER,
      settings: plotter.settings,
      given: stored.own === undefined ? {} : { pen: stored.own.pen },
    },
  ];
  const lay = (source: string, settings: PlotSettings, ofIt: GivenSettings): PlotSettings => {
    layers.push({ source, settings, given: ofIt });
    return settings;
  };
  let settings = plotter.settings;
  // That its model is not the plotter's is no mistake: it is the user's usual one.
  settings = lay(
    usualPath,
    inFile(usualPath, () => settingsWith(plotter, usual, withMachine, settings)).settings,
    usual,
  );
  if (typeof preset === "string") {
    const chosen = presetNamed(stored.own?.presets ?? [], preset);
    const { motion, pen, pens, layers: drawn } = chosen;
    settings = lay(`preset ${chosen.name}`, fromPreset(settings, chosen), {
      motion,
      pen,
      ...pens,
      prepare: drawn,
    });
  }
  const over = inFile(configSource, () => settingsWith(plotter, given, withMachine, settings));
  if (typeof config === "string") lay(configSource, over.settings, given);
  lay(OPTIONS, withFlags(over.settings, values), givenByFlags(values));
  return { layers, machineSource, note: over.note };
}

export const DEFAULT = "default";
export const PLOTTER = "the plotter";
export const OPTIONS = "options";
const LAST_JOB = "the plotter's last job";

const machineIn = ({ machine, customMachine }: GivenSettings): string | undefined =>
  machine ?? customMachine?.id;

/** An error of the settings in a file names that file. */
function inFile<T>(file: string, work: () => T): T {
  try {
    return work();
  } catch (cause) {
    if (!(cause instanceof PlotwrightError)) throw cause;
    throw new PlotwrightError(cause.code, `${file}: ${cause.message}`, { cause });
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

function givenByFlags(values: OptionValues): GivenSettings {
  const given: Record<string, unknown> = {};
  for (const option of SETTING_OPTIONS.filter(isStored)) {
    const value = values[keyOf(option)];
    if (value !== undefined) setPath(given, option.path.split("."), value);
  }
  return given;
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

export const keyOf = (option: SettingOption): string => new Option(option.flags).attributeName();

/** Objects on the way that are missing are made. */
export function setPath(
  target: Record<string, unknown>,
  [first = "", ...rest]: readonly string[],
  value: unknown,
): void {
  if (rest.length === 0) {
    target[first] = value;
    return;
  }
  const inner = target[first];
  const isObject = typeof inner === "object" && inner !== null && !Array.isArray(inner);
  const next = isObject ? (inner as Record<string, unknown>) : {};
  target[first] = next;
  setPath(next, rest, value);
}

function setMachine(settings: Record<string, unknown>, machine: MachineProfile): void {
  settings["machine"] = machine.id;
  settings["customMachine"] = machine;
}

/** Adds the profile of a custom machine that is stored in the data folder. */
export const withOwnMachine = (settings: PlotSettings, values: OptionValues): PlotSettings =>
  new MachineFiles(dataDirOf(values)).withMachine(settings);

export const dataDirOf = ({ data }: OptionValues): string =>
  typeof data === "string" ? data : defaultDataDir();
