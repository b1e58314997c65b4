/** The command line as commander sees it: names, options, help. What the commands do is in the files beside. */
import { Command, CommanderError, InvalidArgumentError, Option } from "commander";
import { ERROR_TABLE, PlotwrightError } from "../../src/index.js";
import type { HandMove } from "../plotter/hand-moves.js";
import { runBoard, type BoardCommandOptions } from "./board.js";
import { mustBeCommand } from "./first-word.js";
import type { CliIo } from "./io.js";
import { length } from "./lengths.js";
import {
  runAlign,
  runDevices,
  runFrame,
  runInfo,
  runMachines,
  runMove,
  runPen,
  type DeviceOptions,
} from "./machine-commands.js";
import { runPlan, type PlanCommandOptions } from "./plan.js";
import { runPlot, type PlotCommandOptions } from "./plot.js";
import { runLogs, type LogsOptions } from "./logs.js";
import { runServe, type ServeCommandOptions } from "./serve.js";
import { installService, serviceStatus, uninstallService, type ServiceOptions } from "./service.js";
import {
  addSettingOptions,
  handSettingsFromOptions,
  settingsFromOptions,
  type OptionValues,
} from "./settings-options.js";

/** 0 done; 2 bad usage; 3 bad input file; 4 no or wrong device; 5 plot failed or was cancelled. */
const BAD_USAGE = 2;
const FAILED = 5;

/** Runs one command; errors become one line on stderr and the exit code. `args` without node and script. */
export async function runCli(args: readonly string[], io: CliIo, version: string): Promise<number> {
  let exitCode = 0;
  const program = buildProgram(io, version, (code) => (exitCode = code));
  try {
    mustBeCommand(args[0], program.commands.map((command) => command.name()).concat("help"));
    await program.parseAsync([...args], { from: "user" });
    return exitCode;
  } catch (error) {
    if (error instanceof CommanderError) return error.exitCode === 0 ? 0 : BAD_USAGE;
    if (error instanceof PlotwrightError) {
      io.err(`plotwright: ${oneLine(error.message)}\n`);
      return ERROR_TABLE[error.code].exitCode;
    }
    io.err(
      `plotwright: internal error: ${oneLine(error instanceof Error ? error.message : String(error))}\n`,
    );
    return FAILED;
  }
}

function buildProgram(io: CliIo, version: string, setExitCode: (code: number) => void): Command {
  const program = new Command("plotwright")
    .description("Pen-plotter control for AxiDraw, NextDraw, EggBot and other EiBotBoard machines")
    .version(version, "--version", "print the version")
    .exitOverride()
    .showSuggestionAfterError(false)
    .configureOutput({
      writeOut: (text) => io.out(text),
      writeErr: (text) => io.err(text),
      outputError: (text, write) => write(`plotwright: ${oneLine(text.replace(/^error: /, ""))}\n`),
    });
  const sub = (name: string, about: string): Command =>
    program.command(name).description(about).copyInheritedSettings(program);

  addServe(
    program.command("serve", { isDefault: true }).description("serve the page and the queue (default)"),
  )
    .copyInheritedSettings(program)
    .action((options: ServeCommandOptions) => runServe(options, io));

  addSettingOptions(sub("plan", "show what a plot would be, without a board").argument("<file>", "SVG file"))
    .option("--json", "print one JSON object")
    .option("--ebb <out>", "write the board's commands, one a line, to a file or - for stdout")
    .option("--firmware <version>", "firmware to make the commands for", "3.0.3")
    .option("--preview <out.svg>", "write a picture coloured by speed")
    .option("--svg <out.svg>", "write the prepared drawing, its layers' settings as codes in their names")
    .option("--strokes <out.json>", "write the prepared drawing as polylines in mm")
    .action((file: string, options: PlanCommandOptions & OptionValues) =>
      runPlan(file, settingsFromOptions(options), options, io),
    );

  addDevice(addSettingOptions(sub("plot", "plot a drawing").argument("<file>", "SVG file"))).action(
    async (file: string, options: PlotCommandOptions & OptionValues) =>
      setExitCode(await runPlot(file, settingsFromOptions(options), options, io)),
  );

  addHandOptions(
    sub("pen", "lift or lower the pen").addArgument(
      program.createArgument("<where>").choices(["up", "down"]),
    ),
  )
    .option("--pen-up <percent>", "height when up", percent)
    .option("--pen-down <percent>", "height when down", percent)
    .action((where: "up" | "down", options: OptionValues & DeviceOptions) =>
      runPen(where, handSettingsFromOptions(options), options),
    );
  addMoves(sub);
  addService(program, io, setExitCode);
  sub("logs", "print what happened, to be sent to whoever helps")
    .option("--data <folder>", "folder for jobs and settings")
    .option("--port <number>", "port of the running server", port, 9080)
    .option("--out <file>", "write it to a file")
    .action((options: LogsOptions) => runLogs(options, io, version));
  sub("board", "be a virtual board that other programs can drive")
    .requiredOption("--pty <path>", "where the serial port shall appear")
    .option("--firmware <version>", "firmware to be", "2.8.1")
    .addOption(new Option("--speed <factor>", "board seconds in one of ours").argParser(positive))
    .option("--machine <id>", "plotter model")
    .option("--svg <file>", "where what was drawn goes (drawn.svg)")
    .action((options: BoardCommandOptions) => runBoard(options, io));
  sub("machines", "list the plotter models, yours too")
    .option("--data <folder>", "folder for jobs and settings")
    .action((options: { data?: string }) => runMachines(options, io));
  sub("devices", "list the boards that are plugged in").action(() => runDevices(io));
  addHandOptions(sub("info", "tell what the board says of itself")).action(
    (options: OptionValues & DeviceOptions) => runInfo(handSettingsFromOptions(options), options, io),
  );
  return program;
}

/** Moves by hand; those with a speed or a height take the settings of a plot. */
function addMoves(sub: (name: string, about: string) => Command): void {
  const move = (
    name: string,
    about: string,
    moveOf: (...at: number[]) => HandMove,
    names: string[] = [],
  ): void => {
    const command = addData(addDevice(addSettingOptions(sub(name, about))));
    for (const one of names) command.argument(`<${one}>`, "mm, or with a unit as in 2cm", length);
    command.action((...given: unknown[]) => {
      const options = given[names.length] as DeviceOptions & OptionValues;
      return runMove(moveOf(...(given as number[])), handSettingsFromOptions(options), options);
    });
  };
  move("home", "lift the pen and walk home", () => ({ kind: "home" }));
  move("jog", "move by so many mm, pen up", (dxMm = 0, dyMm = 0) => ({ kind: "jog", dxMm, dyMm }), [
    "dx",
    "dy",
  ]);
  move("walk", "go to a place in mm from home, pen up", (xMm = 0, yMm = 0) => ({ kind: "walk", xMm, yMm }), [
    "x",
    "y",
  ]);
  move("set-home", "make home where the carriage stands", () => ({ kind: "set-home" }));
  move("cycle-pen", "lower the pen and lift it again", () => ({ kind: "cycle-pen" }));
  move("test-patch", "draw a small pattern where the carriage stands", () => ({ kind: "test-patch" }));
  addHandOptions(
    sub("align", "lift the pen and switch the motors off, to put the carriage to home by hand"),
  ).action((options: OptionValues & DeviceOptions) => runAlign(handSettingsFromOptions(options), options));
  addData(
    addDevice(addSettingOptions(sub("frame", "go around a drawing, pen up").argument("<file>", "drawing"))),
  ).action((file: string, options: DeviceOptions & OptionValues & { only?: readonly string[] }) =>
    runFrame(file, handSettingsFromOptions(options), options),
  );
}

function addService(program: Command, io: CliIo, setExitCode: (code: number) => void): void {
  const service = program
    .command("service")
    .description("keep the server running by systemd")
    .copyInheritedSettings(program);
  const sub = (name: string, about: string): Command =>
    service
      .command(name)
      .description(about)
      .copyInheritedSettings(program)
      .option("--system", "for the whole computer, started at boot; needs root");
  sub("install", "write the unit and start it; options of serve after --")
    .argument("[serve-options...]")
    .option("--user <name>", "with --system: whose server it is")
    .option("--print", "only show what would be written")
    .action((serveArgs: string[], options: ServiceOptions) => {
      // A service that dies of a mistyped option would be found out by nobody.
      addServe(new Command("serve").copyInheritedSettings(program)).parse(serveArgs, { from: "user" });
      installService(options, serveArgs, io);
    });
  sub("uninstall", "stop it and remove the unit").action((options: ServiceOptions) =>
    uninstallService(options, io),
  );
  sub("status", "say whether it runs").action((options: ServiceOptions) =>
    setExitCode(serviceStatus(options, io)),
  );
}

function addServe(command: Command): Command {
  return addDevice(command)
    .option("--port <number>", "port to listen on", port, 9080)
    .option("--host <address>", "address to listen on (127.0.0.1; all with --lan)")
    .option("--lan", "listen on the network; other devices have to be paired")
    .option("--no-mdns", "with --lan: do not announce plotwright.local")
    .option("--pair-always", "ask for pairing on this computer too")
    .option("--cert <file>", "certificate (PEM): serve https")
    .option("--key <file>", "the certificate's key (PEM)")
    .option("--allow-host <name...>", "host name to answer to, besides localhost and addresses")
    .option("--data <folder>", "folder for jobs and settings")
    .option("--watch <folder>", "queue the drawings that are put there")
    .addOption(
      new Option("--shared-queue <url>", "share jobs with other servers by a PostgreSQL database").env(
        "PLOTWRIGHT_SHARED_QUEUE",
      ),
    )
    .option("--max-upload-mb <number>", "largest drawing taken", positive, 200)
    .option("--open", "open the page in the browser");
}

/** Whose servo and steps these are: told, or as a server has kept them in its data folder. */
function addHandOptions(command: Command): Command {
  return addData(addDevice(command))
    .option("--machine <id>", "plotter model; without it the one that the server's plotter has")
    .option("--machine-file <file>", "JSON file with the profile of your own plotter");
}

const addData = (command: Command): Command =>
  command.option("--data <folder>", "folder for jobs and settings");

function addDevice(command: Command): Command {
  return command
    .option("--device <path>", "serial port of the board, or virtual")
    .addOption(new Option("--virtual-speed <factor>", "how fast the virtual board runs").argParser(positive));
}

function port(text: string): number {
  const value = Number(text);
  if (!/^\d+$/.test(text) || value > 65_535) throw new InvalidArgumentError("It must be 0 to 65535.");
  return value;
}

function positive(text: string): number {
  const value = Number(text);
  if (!(value > 0 && Number.isFinite(value))) throw new InvalidArgumentError("It must be a number above 0.");
  return value;
}

function percent(text: string): number {
  const value = text.trim() === "" ? NaN : Number(text);
  if (!(value >= 0 && value <= 100)) throw new InvalidArgumentError("It must be 0 to 100.");
  return value;
}

const oneLine = (text: string): string => text.trim().replace(/\s*\n\s*/g, " ");
