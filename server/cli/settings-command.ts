/**
 * `plotwright settings`: shows the settings that apply and where each is from, changes the config file that always applies,
 * and keeps settings under a name as a preset of the plotter.
 */
import { InvalidArgumentError, type Command } from "commander";
import { PlotwrightError } from "../../src/index.js";
import {
  GIVEN_WHOLE,
  isSameJson,
  machineOf,
  printableJson,
  QUALITY_PATH,
  SPRINGS_PATH,
} from "../../src/internal.js";
import {
  DEFAULT_PLOT_SETTINGS,
  firstFault,
  givenSettingsSchema,
  plotterPartOf,
  presetNamed,
  presetSchema,
  withoutPreset,
  withPreset,
  type PlotSettings,
  type PlotterSettings,
} from "../../src/schema/index.js";
import { knownPlotters, withChosenPlotter, type KnownPlotters } from "./client/known-plotters.js";
import { addServer } from "./client/server-client.js";
import { plotterOf } from "./client/served-plotter.js";
import { changeUsualConfig, readUsualConfig, usualConfigPath } from "./config-file.js";
import { printed, row, type CliIo } from "./io.js";
import { addJson, addPlotter, type Declare } from "./options.js";
import { isOwnSize, optionAt, optionOf, SETTING_OPTIONS } from "./setting-table.js";
import {
  addSettingOptions,
  keyOf,
  OPTIONS,
  PLOTTER,
  setPath,
  settingsInLayers,
  withOwnMachine,
  type LayeredSettings,
  type OptionValues,
  type SettingsLayer,
} from "./settings-options.js";
import { NOTHING_STORED, type KnownPlotter } from "./stored-plotter.js";

export const declareSettings: Declare = (settings, { io }) => {
  const sub = (name: string, about: string, isDefault = false): Command =>
    addPlotter(
      addServer(settings.command(name, { isDefault }).description(about).copyInheritedSettings(settings)),
    );

  addJson(addSettingOptions(sub("show", "show all settings or some, and where each is from", true)))
    .argument("[keys...]", "only these: an option's name, or a path such as pen (default: all)")
    .action((keys: string[], options: OptionValues) => show(keys, options, io));
  sub("set", "change a setting in the config file that always applies")
    .argument("<key>", "an option's name, such as margin, or a path, such as pen.upPct")
    .argument("<value>", "as for the option, or JSON")
    .action((key: string, value: string, options: OptionValues) => set(key, value, options, io));
  sub("unset", "remove a setting from that file")
    .argument("<key>", "an option's name or a path")
    .action((key: string) => unset(key, io));
  addSettingOptions(sub("save", "keep speeds, pen, pens and layers as a preset of the plotter"))
    .argument("<name>", "name of the preset")
    .action((name: string, options: OptionValues) => save(name, options, io));
  addJson(sub("presets", "list the plotter's presets")).action((options: OptionValues) =>
    listPresets(options, io),
  );
  sub("remove", "remove a preset")
    .argument("<name>", "name of the preset")
    .action((name: string, options: OptionValues) => remove(name, options, io));
};

/** A setting that is not split further. */
interface Leaf {
  readonly path: string;
  readonly value: unknown;
}

async function show(keys: readonly string[], options: OptionValues, io: CliIo): Promise<void> {
  const paths = keys.map(shownPath);
  const { plotters, withMachine } = await knownPlotters(options);
  const plotter = plotterOf(plotters, options["plotter"]);
  const layered = settingsInLayers(options, plotter?.stored ?? NOTHING_STORED, withMachine);
  const settings = layered.layers[layered.layers.length - 1].settings;
  const plotterSource = `plotter ${plotter?.id ?? ""}`;
  const isAsked = ({ path }: Leaf): boolean =>
    paths.length === 0 || paths.some((asked) => `${path}.`.startsWith(`${asked}.`));
  const rows = leavesOf(settings)
    .filter(isAsked)
    .map((leaf) => {
      const source = sourceOf(leaf, layered, options);
      return { ...leaf, source: source === PLOTTER ? plotterSource : source };
    });
  if (options["json"] === true) {
    const sources = Object.fromEntries(rows.map(({ path, source }) => [path, source]));
    io.out(`${printableJson({ settings: paths.length === 0 ? settings : ofLeaves(rows), sources })}\n`);
    return;
  }
  if (rows.length === 0) io.err("Not set.\n");
  for (const { path, value, source } of rows) io.out(row(path, inWords(value), source));
}

/** The path of a setting, or the beginning of several. Throws `bad-setting` if there is none. */
function shownPath(key: string): string {
  const path = optionOf(key)?.path ?? key;
  const { error } = givenSettingsSchema.safeParse(at(path.split("."), undefined));
  if (error?.issues[0]?.code !== "unrecognized_keys") return path;
  const fault = firstFault(error);
  throw new PlotwrightError("bad-setting", `${fault.path}: ${fault.words}.`);
}

function ofLeaves(leaves: readonly Leaf[]): object {
  const settings = {};
  for (const { path, value } of leaves) setPath(settings, path.split("."), value);
  return settings;
}

const isWhole = (key: string, value: unknown): boolean =>
  typeof value !== "object" || value === null || Array.isArray(value) || GIVEN_WHOLE.includes(key);

function leavesOf(value: object, at = ""): Leaf[] {
  return Object.entries(value).flatMap(([key, part]: [string, unknown]) => {
    const path = at === "" ? key : `${at}.${key}`;
    if (part === undefined) return [];
    return isWhole(key, part) ? [{ path, value: part }] : leavesOf(part as object, path);
  });
}

/** What a setting was last changed or named by. */
function sourceOf({ path }: Leaf, { layers, machineSource }: LayeredSettings, options: OptionValues): string {
  if (path === "machine") return machineSource;
  const isTouched = ({ settings, given }: SettingsLayer, i: number): boolean =>
    i === 0 ||
    read(given, path) !== undefined ||
    !isSameJson(read(settings, path), read(layers[i - 1].settings, path));
  const { source } = layers.filter(isTouched).at(-1) ?? layers[0];
  return source === OPTIONS ? flagFor(path, options) : source;
}

/** The given flag that sets this. */
function flagFor(path: string, options: OptionValues): string {
  const own = SETTING_OPTIONS.find((option) => {
    const value = options[keyOf(option)];
    const isGiven = value !== undefined && (value === false) === option.flags.startsWith("--no-");
    return isGiven && `${path}.`.startsWith(`${option.path}.`);
  });
  const flag = own?.flags.split(" ")[0];
  // It sets several.
  const isOfQuality = path.startsWith("motion.") && options["quality"] !== undefined;
  return flag ?? (isOfQuality ? "--quality" : OPTIONS);
}

const read = (value: unknown, path: string): unknown =>
  path
    .split(".")
    .reduce<unknown>((inner, key) => (inner as Record<string, unknown> | null | undefined)?.[key], value);

const inWords = (value: unknown): string => {
  if (typeof value === "string") return value;
  const { id, name } = (value ?? {}) as Record<string, unknown>;
  return typeof id === "string" && typeof name === "string" ? `${id} (${name})` : JSON.stringify(value);
};

/** Settings that flags have but a file does not. */
const NOT_IN_FILE: ReadonlyMap<string, string> = new Map([
  [
    QUALITY_PATH,
    "it sets several settings at once: set motion.draw.speedMmPerS and the others, or keep it in a preset: plotwright settings save NAME --quality …",
  ],
  [SPRINGS_PATH, "it belongs to the machine's profile: set it on the page, or in a file of --machine-file"],
]);

/** The path of a setting, from an option's name or as it is. */
function pathOf(key: string): string {
  const option = optionOf(key);
  const path = option?.path ?? key;
  const why = NOT_IN_FILE.get(path.split(".")[0]);
  if (why !== undefined) throw new PlotwrightError("bad-setting", `${key}: ${why}.`);
  return path;
}

const SWITCHES: ReadonlyMap<string, unknown> = new Map([
  ["on", true],
  ["off", false],
]);

async function set(key: string, text: string, options: OptionValues, io: CliIo): Promise<void> {
  const path = pathOf(key);
  const isMachine = path === "machine";
  if (isMachine) machineOf(withOwnMachine({ ...DEFAULT_PLOT_SETTINGS, machine: text }, options));
  if (isMachine && options["plotter"] !== undefined) return setPlottersMachine(text, options, io);
  const value = valueOf(path, text);
  const before = isMachine ? readUsualConfig().machine : undefined;
  const config = changeUsualConfig((all) => {
    setPath(all, path.split("."), value);
    // A size in numbers has its own orientation.
    if (path === "prepare.paper" && isOwnSize(value))
      setPath(all, ["prepare", "landscape"], value.widthMm > value.heightMm);
  });
  io.out(row(path, inWords(read(config, path)), usualConfigPath()));
  if (isMachine) await passToPlotter(text, before, options, io);
}

/** From JSON, a word, or what the setting's option takes. Throws `bad-setting`. */
function valueOf(path: string, text: string): unknown {
  const isValid = (value: unknown): boolean =>
    givenSettingsSchema.safeParse(at(path.split("."), value)).success;
  const plain = SWITCHES.get(text) ?? jsonOr(text);
  if (isValid(plain)) return plain;
  const parse = optionAt(path)?.parse;
  if (parse !== undefined) {
    try {
      const value = parse(text);
      if (isValid(value)) return value;
    } catch (error) {
      if (!(error instanceof InvalidArgumentError)) throw error;
      throw new PlotwrightError("bad-setting", `${path}: ${afterColon(error.message)}`);
    }
  }
  const result = givenSettingsSchema.safeParse(at(path.split("."), plain));
  if (result.success) return plain;
  const fault = firstFault(result.error);
  throw new PlotwrightError("bad-setting", `${fault.path}: ${fault.words}.`);
}

const afterColon = (sentence: string): string => sentence.charAt(0).toLowerCase() + sentence.slice(1);

function jsonOr(text: string): unknown {
  try {
    return JSON.parse(text);
  } catch {
    return text;
  }
}

const at = (path: readonly string[], value: unknown): unknown =>
  path.reduceRight<unknown>((inner, key) => ({ [key]: inner }), value);

function unset(key: string, io: CliIo): void {
  const path = pathOf(key);
  let isFound = false;
  changeUsualConfig((all) => (isFound = drop(all, path.split("."))));
  if (!isFound) throw new PlotwrightError("bad-setting", `${usualConfigPath()} does not have ${path}.`);
  io.out(row(path, "removed", usualConfigPath()));
}

/** Objects that are empty then are removed too. */
function drop(target: Record<string, unknown>, [key = "", ...rest]: readonly string[]): boolean {
  if (!Object.hasOwn(target, key)) return false;
  const inner = target[key];
  if (rest.length > 0) {
    if (typeof inner !== "object" || inner === null) return false;
    if (!drop(inner as Record<string, unknown>, rest)) return false;
    if (Object.keys(inner).length > 0) return true;
  }
  delete target[key];
  return true;
}

async function setPlottersMachine(machine: string, options: OptionValues, io: CliIo): Promise<void> {
  await withChosenPlotter(options, async (plotter, known) => {
    await known.saveMachine(plotter.id, machine);
    io.out(row("machine", machine, `plotter ${plotter.name}`));
  });
}

/**
 * A plotter that has no model, or the one that the file had before, gets the user's new one: so a server plots as `plot` does,
 * also one that starts later. Another model stays.
 */
async function passToPlotter(
  machine: string,
  before: string | undefined,
  options: OptionValues,
  io: CliIo,
): Promise<void> {
  await withChosenPlotter(options, async (plotter, known) => {
    const its = plotter.stored.machine;
    if (its === machine) return;
    if (its === null || its === before) {
      await known.saveMachine(plotter.id, machine);
      io.out(row("machine", machine, `plotter ${plotter.name}`));
      return;
    }
    io.err(
      printed`note: The plotter ${plotter.name} keeps its model, ${its}, which overrides the file's. To change it: plotwright settings set machine ${machine} --plotter ${plotter.id}\n`,
    );
  });
}

/** Stores the plotter's presets after a change. */
async function changePresets(
  known: KnownPlotters,
  { id, stored: { own } }: KnownPlotter,
  presets: PlotterSettings["presets"],
): Promise<void> {
  await known.saveSettings(id, { ...(own ?? plotterPartOf(DEFAULT_PLOT_SETTINGS)), presets });
}

async function save(name: string, options: OptionValues, io: CliIo): Promise<void> {
  const checked = presetSchema.shape.name.safeParse(name);
  if (!checked.success) {
    throw new PlotwrightError("bad-setting", `The name of the preset: ${firstFault(checked.error).words}.`);
  }
  await withChosenPlotter(options, async (plotter, known) => {
    const { layers } = settingsInLayers(options, plotter.stored, known.withMachine);
    const settings: PlotSettings = layers[layers.length - 1].settings;
    await changePresets(
      known,
      plotter,
      withPreset(plotter.stored.own?.presets ?? [], checked.data, settings),
    );
    io.out(row("preset", checked.data, `plotter ${plotter.name}`));
  });
}

async function listPresets(options: OptionValues, io: CliIo): Promise<void> {
  const { plotters } = await knownPlotters(options);
  const presets = plotterOf(plotters, options["plotter"])?.stored.own?.presets ?? [];
  if (options["json"] === true) io.out(`${printableJson(presets)}\n`);
  else if (presets.length === 0)
    io.err("The plotter has no presets. To make one: plotwright settings save NAME\n");
  else presets.forEach(({ name }) => io.out(printed`${name}\n`));
}

async function remove(name: string, options: OptionValues, io: CliIo): Promise<void> {
  await withChosenPlotter(options, async (plotter, known) => {
    const presets = plotter.stored.own?.presets ?? [];
    const preset = presetNamed(presets, name);
    await changePresets(known, plotter, withoutPreset(presets, preset.name));
    io.out(row("preset", preset.name, "removed"));
  });
}
