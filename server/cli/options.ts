/** Options that several commands have, and how their values are read. */
import { InvalidArgumentError, Option, type Command } from "commander";
import { isAllowed, rangeInWords, SPRINGS_TABLE, type Springs, parseLength } from "../../src/internal.js";
import { originsOf } from "../composition/server-options.js";
import type { PenChoice } from "../planning/layers-by-name.js";
import type { CliIo } from "./io.js";

/** Passed to each command when it declares its options and action. */
export interface CommandContext {
  readonly io: CliIo;
  readonly version: string;
  setExitCode(code: number): void;
}
export type Declare = (command: Command, context: CommandContext) => void;

export interface DeviceOptions {
  readonly device?: string;
  readonly virtualSpeed?: number;
  readonly direct?: boolean;
}

/** For the server. */
export const addPort = (command: Command, names = "serial port of the board, or virtual"): Command =>
  command
    .option("--device <path>", `${names} (default: the first board found)`)
    .addOption(
      new Option(
        "--virtual-speed <factor>",
        "speed of the virtual board; 1 is real time (default: 1)",
      ).argParser(positive),
    );

/** For a command that works through a running server if that has the plotter. */
export const addDevice = (command: Command): Command =>
  addPort(command, "serial port, name of a plotter or board, or virtual").option(
    "--direct",
    "use the port itself, although a server runs",
  );

export const addData = (command: Command): Command =>
  command.option("--data <folder>", "folder for jobs and settings (default: ~/.local/share/plotwright)");

/** The machine: given by an option, or stored by a server in its data folder. */
export const addHandOptions = (command: Command): Command =>
  addData(addDevice(command))
    .option("--machine <id>", "plotter model (default: the one that the server's plotter has)")
    .option("--machine-file <file>", "JSON file with the profile of your own plotter, or -");

export const addJson = (command: Command): Command => command.option("--json", "print JSON");

export function port(text: string): number {
  const value = Number(text);
  if (!/^\d+$/.test(text) || value > 65_535) throw new InvalidArgumentError("It must be 0 to 65535.");
  return value;
}

/** Collects the values of an option that takes several names. */
export function hostNames(text: string, before: readonly string[] = []): string[] {
  if (!/^[\w.-]+$/.test(text)) {
    throw new InvalidArgumentError("It must be a name without http:// and port, such as studio.local.");
  }
  return [...before, text];
}

/** Collects the values of an option that takes several origins. */
export function origins(text: string, before: readonly string[] = []): string[] {
  try {
    return [...before, ...originsOf([text])];
  } catch (error) {
    throw new InvalidArgumentError((error as Error).message);
  }
}

export function positive(text: string): number {
  const value = Number(text);
  if (!(value > 0 && Number.isFinite(value))) throw new InvalidArgumentError("It must be a number above 0.");
  return value;
}

/** "15,25" or "15,25,0.05": frequencies of x and y in Hz, and the damping ratio. */
export function springs(text: string): Springs {
  const [xHz = NaN, yHz = NaN, damping = SPRINGS_TABLE.damping.default, ...rest] = text
    .split(",")
    .map((part) => (part.trim() === "" ? NaN : Number(part)));
  const areFrequencies = [xHz, yHz].every((hz) => isAllowed(SPRINGS_TABLE.xHz, hz));
  if (!areFrequencies || !isAllowed(SPRINGS_TABLE.damping, damping) || rest.length > 0) {
    throw new InvalidArgumentError(
      `It must be two frequencies, ${rangeInWords(SPRINGS_TABLE.xHz)}, and optionally the damping: 15,25,0.05.`,
    );
  }
  return { xHz, yHz, damping };
}

export function percent(text: string): number {
  const value = text.trim() === "" ? NaN : Number(text);
  if (!(value >= 0 && value <= 100)) throw new InvalidArgumentError("It must be 0 to 100.");
  return value;
}

/** Collects the values of --pen LAYER=NAME. */
function penChoice(text: string, before: readonly PenChoice[] = []): PenChoice[] {
  const at = text.lastIndexOf("=");
  const [layer, pen] = [text.slice(0, at).trim(), text.slice(at + 1).trim()];
  if (at < 0 || layer === "" || pen === "") {
    throw new InvalidArgumentError("It must be a layer and a pen, such as Sky=Blue.");
  }
  return [...before, { layer, pen }];
}

/** For the commands that read the drawing themselves. */
export const addFont = (command: Command): Command =>
  command.option("--font <file>", "font file (ttf, otf, woff) whose outlines draw the text");

/** For the commands that draw. */
export const addLayerOptions = (command: Command): Command =>
  command
    .option("--only <layer...>", "draw these layers only, by name, id or leading number")
    .addOption(
      new Option("--pen <layer=name...>", "pen that draws a layer: one of the plotter's, by name").argParser(
        penChoice,
      ),
    );

const MAX_COPIES = 100;

export function copies(text: string): number {
  const value = Number(text);
  if (/^0+$/.test(text)) {
    throw new InvalidArgumentError("It must be 1 to 100. For endless copies: plotwright plot --copies 0.");
  }
  if (!/^\d+$/.test(text) || value > MAX_COPIES) throw new InvalidArgumentError("It must be 1 to 100.");
  return value;
}

export function copiesOrEndless(text: string): number {
  const value = Number(text);
  if (!/^\d+$/.test(text) || value > MAX_COPIES) {
    throw new InvalidArgumentError("It must be 1 to 100, or 0 for endless copies.");
  }
  return value;
}

export function seconds(text: string): number {
  const value = text.trim() === "" ? NaN : Number(text);
  if (!(value >= 0 && value <= 86_400)) throw new InvalidArgumentError("It must be 0 to 86400 seconds.");
  return value;
}

export function length(text: string): number {
  const mm = parseLength(text);
  if (mm === null)
    throw new InvalidArgumentError("It must be a length in mm, or with a unit as in 2cm or 1in.");
  return mm;
}
