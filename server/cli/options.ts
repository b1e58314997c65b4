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
export const addPort = (
  command: Command,
  names = "serial port of the board, tcp://HOST:PORT, or virtual",
): Command =>
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
  addPort(command, "serial port, tcp://HOST:PORT, name of a plotter or board, or virtual").option(
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

/** For a command about one of the plotters that the server has, or the data folder. */
export const addPlotter = (command: Command): Command =>
  command.option("--plotter <name>", "which plotter, by name or id (default: the first one)");

export const addJson = (command: Command): Command => command.option("--json", "print JSON");

/** A parser of numbers. `words`: what is allowed. `pattern`: how the number is written. */
const numberThat =
  (isAllowed: (value: number) => boolean, words: string, pattern = /\S/) =>
  (text: string): number => {
    const value = pattern.test(text) ? Number(text) : NaN;
    if (!isAllowed(value)) throw new InvalidArgumentError(`It must be ${words}.`);
    return value;
  };
const isIn =
  (from: number, to: number) =>
  (value: number): boolean =>
    value >= from && value <= to;
const WHOLE = /^\d+$/;

export const number = numberThat(Number.isFinite, "a number");
export const positive = numberThat((value) => value > 0 && Number.isFinite(value), "a number above 0");
export const percent = numberThat(isIn(0, 100), "0 to 100");
export const seconds = numberThat(isIn(0, 86_400), "0 to 86400 seconds");
export const milliseconds = numberThat(isIn(0, 60_000), "0 to 60000 ms");
export const port = numberThat(isIn(0, 65_535), "0 to 65535", WHOLE);
export const copies = numberThat(
  isIn(1, 100),
  "1 to 100. For endless copies: plotwright plot --copies 0",
  WHOLE,
);
export const copiesOrEndless = numberThat(isIn(0, 100), "1 to 100, or 0 for endless copies", WHOLE);

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

export function length(text: string): number {
  const mm = parseLength(text);
  if (mm === null)
    throw new InvalidArgumentError("It must be a length in mm, or with a unit as in 2cm or 1in.");
  return mm;
}
