/**
 * Command-line options that make PlotSettings. One table: the flag, where its value goes, how it is read.
 * Values are checked by the same schema as the web's; a fault names the flag.
 */
import { InvalidArgumentError, Option, type Command } from "commander";
import { LAYER_MODES, ORDER_MODES, PAPER_SIZES, PlotwrightError, type PaperSize } from "../../src/index.js";
import { DEFAULT_PLOT_SETTINGS, plotSettingsSchema, type PlotSettings } from "../../src/schema/index.js";

interface SettingOption {
  readonly flags: string;
  readonly about: string;
  /** Where in PlotSettings. */
  readonly path: string;
  readonly parse?: (text: string) => unknown;
  readonly choices?: readonly string[];
}

const SETTING_OPTIONS: readonly SettingOption[] = [
  { flags: "--machine <id>", about: "plotter model, for example axidraw-v3", path: "machine" },
  {
    flags: "--paper <size>",
    about: "A4, A3, Letter, … or WIDTHxHEIGHT in mm",
    path: "prepare.paper",
    parse: paper,
  },
  { flags: "--landscape", about: "paper lies on its long side (default)", path: "prepare.landscape" },
  { flags: "--no-landscape", about: "paper stands upright", path: "prepare.landscape" },
  { flags: "--margin <mm>", about: "free edge around the drawing", path: "prepare.marginMm", parse: number },
  {
    flags: "--fit",
    about: "scale the drawing to the paper inside the margins (default)",
    path: "prepare.fit",
  },
  { flags: "--no-fit", about: "draw in true size", path: "prepare.fit" },
  { flags: "--rotate <deg>", about: "turn the drawing clockwise", path: "prepare.rotateDeg", parse: number },
  {
    flags: "--join <mm>",
    about: "join ends that are closer than this",
    path: "prepare.joinMm",
    parse: number,
  },
  {
    flags: "--simplify <mm>",
    about: "drop points closer than this to the line",
    path: "prepare.simplifyMm",
    parse: number,
  },
  { flags: "--order <how>", about: "order of strokes", path: "prepare.order", choices: ORDER_MODES },
  { flags: "--layers <by>", about: "what makes a layer", path: "prepare.layers", choices: LAYER_MODES },
  {
    flags: "--speed <mm/s>",
    about: "largest speed, pen down",
    path: "motion.draw.speedMmPerS",
    parse: number,
  },
  {
    flags: "--accel <mm/s²>",
    about: "acceleration, pen down",
    path: "motion.draw.accelMmPerS2",
    parse: number,
  },
  {
    flags: "--corner <mm>",
    about: "how far a corner may be cut, pen down",
    path: "motion.draw.cornerMm",
    parse: number,
  },
  {
    flags: "--travel-speed <mm/s>",
    about: "largest speed, pen up",
    path: "motion.travel.speedMmPerS",
    parse: number,
  },
  {
    flags: "--travel-accel <mm/s²>",
    about: "acceleration, pen up",
    path: "motion.travel.accelMmPerS2",
    parse: number,
  },
  { flags: "--pen-up <percent>", about: "height while travelling", path: "pen.upPct", parse: number },
  { flags: "--pen-down <percent>", about: "height while drawing", path: "pen.downPct", parse: number },
  { flags: "--pen-lift-ms <ms>", about: "wait for the pen to lift", path: "pen.liftMs", parse: number },
  { flags: "--pen-drop-ms <ms>", about: "wait for the pen to drop", path: "pen.dropMs", parse: number },
];

/** What commander hands to an action: option names in camel case. */
export type OptionValues = Readonly<Record<string, unknown>>;

export function addSettingOptions(command: Command): Command {
  for (const { flags, about, parse, choices } of SETTING_OPTIONS) {
    const option = new Option(flags, about);
    if (choices !== undefined) option.choices(choices);
    if (parse !== undefined) option.argParser(parse);
    command.addOption(option);
  }
  return command.addOption(
    new Option("--only <layer...>", "draw these layers only, by name or id").argParser(collect),
  );
}

/** Defaults with the given options over them; throws `bad-setting` naming the flag at fault. */
export function settingsFromOptions(values: OptionValues): PlotSettings {
  const settings: Record<string, unknown> = structuredClone(DEFAULT_PLOT_SETTINGS);
  const size = values["paper"];
  // Who says 200x300 means 200 wide, whatever the default orientation is.
  if (isOwnSize(size)) setPath(settings, ["prepare", "landscape"], size.widthMm > size.heightMm);
  for (const option of SETTING_OPTIONS) {
    const value = values[keyOf(option)];
    if (value !== undefined) setPath(settings, option.path.split("."), value);
  }
  const result = plotSettingsSchema.safeParse(settings);
  if (result.success) return result.data;
  const issue = result.error.issues[0];
  const path = issue?.path.join(".") ?? "";
  const flag = SETTING_OPTIONS.find((option) => path.startsWith(option.path))?.flags.split(" ")[0] ?? path;
  throw new PlotwrightError("bad-setting", `${flag}: ${issue?.message ?? "not understood"}.`);
}

const NAMED_SIZES: readonly unknown[] = Object.values(PAPER_SIZES);
const isOwnSize = (size: unknown): size is PaperSize => size !== undefined && !NAMED_SIZES.includes(size);

function keyOf(option: SettingOption): string {
  return new Option(option.flags).attributeName();
}

function setPath(target: Record<string, unknown>, path: readonly string[], value: unknown): void {
  const [first = "", ...rest] = path;
  if (rest.length === 0) target[first] = value;
  else setPath(target[first] as Record<string, unknown>, rest, value);
}

function number(text: string): number {
  const value = text.trim() === "" ? NaN : Number(text);
  if (!Number.isFinite(value)) throw new InvalidArgumentError("It must be a number.");
  return value;
}

/** A name, or WIDTHxHEIGHT in mm. */
function paper(text: string): PaperSize {
  const name = Object.keys(PAPER_SIZES).find((one) => one.toLowerCase() === text.toLowerCase());
  if (name !== undefined) return PAPER_SIZES[name as keyof typeof PAPER_SIZES];
  const match = /^(\d+(?:\.\d+)?)\s*[x×]\s*(\d+(?:\.\d+)?)(?:\s*mm)?$/i.exec(text);
  if (match === null) {
    throw new InvalidArgumentError(
      `It must be one of ${Object.keys(PAPER_SIZES).join(", ")} or WIDTHxHEIGHT in mm.`,
    );
  }
  return { widthMm: Number(match[1]), heightMm: Number(match[2]) };
}

function collect(text: string, before: readonly string[] | undefined): string[] {
  return [...(before ?? []), text];
}
