/** The command line: finds the command, runs it, and turns errors into one line and an exit code. */
import { Command, CommanderError } from "commander";
import { COMMANDS, DEFAULT_COMMAND } from "./commands.js";
import { printed, type CliIo } from "./io.js";
import type { CommandContext } from "./options.js";
import { PlotwrightError } from "../../src/index.js";
import { isDrawingName } from "../../src/internal.js";

/** 0 done; 2 bad usage; 3 bad input file; 4 no or wrong device; 5 plot failed or was cancelled. */
const BAD_USAGE = 2;
const FAILED = 5;

/** Runs one command; errors become one line on stderr and the exit code. `args` without node and script. */
export async function runCli(given: readonly string[], io: CliIo, version: string): Promise<number> {
  let exitCode = 0;
  const isHelpAll = given.includes(HELP_ALL);
  const args = given.map((word) => (word === HELP_ALL ? "--help" : word));
  const context: CommandContext = { io, version, setExitCode: (code) => (exitCode = code) };
  const wanted = wantedOf(args);
  try {
    await mustBeCommand(args[0] === "help" ? args[1] : args[0]);
    const program = await buildProgram(wanted, context, isHelpAll);
    await program.parseAsync([...args], { from: "user" });
    return exitCode;
  } catch (error) {
    if (error instanceof CommanderError) {
      if (error.exitCode === 0) return 0;
      if (error.code !== HELP_SHOWN) io.err(printed`plotwright: ${usageFault(error, wanted[0])}\n`);
      return BAD_USAGE;
    }
    const { PlotwrightError } = await import("../../src/index.js");
    const { ERROR_TABLE } = await import("../../src/internal.js");
    if (error instanceof PlotwrightError) {
      io.err(printed`plotwright: ${oneLine(error.message)}\n`);
      return ERROR_TABLE[error.code].exitCode;
    }
    io.err(
      printed`plotwright: internal error: ${oneLine(error instanceof Error ? error.message : String(error))}\n`,
    );
    return FAILED;
  }
}

/** The code of Commander's "error" after the help of a command that needs another word, such as `service`. */
const HELP_SHOWN = "commander.help";
const SURPLUS_WORD = "commander.excessArguments";

/** `command`: whose help has the details; undefined: the program's. */
function usageFault({ code, message }: CommanderError, command: string | undefined): string {
  const help = ["plotwright", ...(command === undefined ? [] : [command]), "--help"].join(" ");
  // A surplus word is usually an option without its name, or part of a file name.
  const hint = code === SURPLUS_WORD ? " Options begin with --, and names with blanks need quotes." : "";
  return `${oneLine(message.replace(/^error: /, ""))}${hint} (see ${help})`;
}

/** All commands by name; only those in `wanted` are loaded and have their options. */
export async function buildProgram(
  wanted: readonly string[],
  context: CommandContext,
  isHelpAll = false,
): Promise<Command> {
  const { io, version } = context;
  const program = new Command("plotwright")
    .description("Pen-plotter control for AxiDraw, NextDraw, EggBot and other EiBotBoard machines")
    .version(version, "-v, --version", "print the version")
    .exitOverride()
    .showSuggestionAfterError()
    .configureOutput({
      writeOut: (text) => io.out(text),
      writeErr: (text) => io.err(text),
      // runCli writes it in one line.
      outputError: () => undefined,
    });
  for (const { name, about, examples, load } of COMMANDS) {
    const command = program
      .command(name, { isDefault: name === DEFAULT_COMMAND })
      .description(about)
      .copyInheritedSettings(program);
    if (!wanted.includes(name)) continue;
    (await load())(command, context);
    (await import("./help.js")).arrangeHelp(command, isHelpAll);
    command.addHelpText("after", `\nExamples:\n${examples.map((line) => `  ${line}`).join("\n")}`);
  }
  return program;
}

/** As `--help`, with the options that are rarely used. */
const HELP_ALL = "--help-all";

/** Options without a command belong to the default command, except these, which the program itself handles. */
const OF_PROGRAM = ["--help", "-h", "--version", "-v"];

function wantedOf(args: readonly string[]): string[] {
  const [first, second] = args;
  // Its script has all of them.
  if (first === "completion") return COMMANDS.map(({ name }) => name);
  if (first === "help") return second === undefined ? [] : [second];
  if (first !== undefined && !first.startsWith("-")) return [first];
  return first !== undefined && OF_PROGRAM.includes(first) ? [] : [DEFAULT_COMMAND];
}

async function mustBeCommand(word: string | undefined): Promise<void> {
  const names = [...COMMANDS.map(({ name }) => name), "help"];
  if (word === undefined || word.startsWith("-") || names.includes(word)) return;
  throw notACommand(word, names);
}

const oneLine = (text: string): string => text.trim().replace(/\s*\n\s*/g, " ");

const notACommand = (word: string, commands: readonly string[]): PlotwrightError =>
  new PlotwrightError("bad-setting", `There is no command ${word}. ${hint(word, commands)}`);

function hint(word: string, commands: readonly string[]): string {
  if (isDrawingName(word)) return `To plot a drawing: plotwright plot ${word}`;
  if (/^\d+$/.test(word)) {
    return `To choose the port: plotwright --port ${word}, or npm start -- --port ${word} (with -- before the options).`;
  }
  if (word === "recover") return "To continue a drawing that was begun: plotwright plot --resume";
  if (word === "version") return "To print the version: plotwright --version";
  const near = nearest(word, commands);
  if (near !== null) return `Did you mean ${near}?`;
  return `The commands are ${commands.join(", ")}.`;
}

/** The command that `word` probably misspells; null if there is none. */
function nearest(word: string, commands: readonly string[]): string | null {
  return commands.find((command) => isTypo(word, command) || isTypo(command, word)) ?? null;
}

/** Whether `a` is `b` with one letter missing or different, or with two neighbouring letters swapped. */
function isTypo(a: string, b: string): boolean {
  for (let i = 0; i <= b.length; i++) {
    const [head, tail] = [b.slice(0, i), b.slice(i + 1)];
    if (a === head + tail) return true;
    if (a.length === b.length && a.startsWith(head) && a.endsWith(tail)) return true;
    if (a === head + b.slice(i + 1, i + 2) + b.slice(i, i + 1) + b.slice(i + 2)) return true;
  }
  return false;
}
