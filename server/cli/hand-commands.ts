/** Declares the single commands to the machine: pen, manual moves, a raw line, info. */
import { InvalidArgumentError, type Command } from "commander";
import type { HandMove, PlotSettings } from "../../src/schema/index.js";
import { mustBeDataFolder } from "./files.js";
import type { CliIo } from "./io.js";
import { length } from "./lengths.js";
import {
  runAlign,
  runFrame,
  runInfo,
  runMove,
  runPen,
  runRaw,
  type FrameOptions,
  type PenPlace,
} from "./machine-commands.js";
import {
  addData,
  addDevice,
  addHandOptions,
  addJson,
  percent,
  type Declare,
  type DeviceOptions,
} from "./options.js";
import { addSettingOptions, plotterSettingsFromOptions, type OptionValues } from "./settings-options.js";

type HandOptions = OptionValues & DeviceOptions;

export const declarePen: Declare = (command, { io }) => {
  addHandOptions(command.argument("<where>", "up, down, or a height in percent", penPlace))
    .option("--pen-up <percent>", "height when up (default: 60)", percent)
    .option("--pen-down <percent>", "height when down (default: 30)", percent)
    .action((where: PenPlace, options: HandOptions) => runPen(where, handSettings(options, io), options, io));
};

export const declareAlign: Declare = (command, { io }) => {
  addHandOptions(command).action((options: HandOptions) => runAlign(handSettings(options, io), options, io));
};

export const declareInfo: Declare = (command, { io }) => {
  addJson(addHandOptions(command)).action((options: HandOptions & { json?: boolean }) =>
    runInfo(handSettings(options, io), options, io),
  );
};

export const declareRaw: Declare = (command, { io }) => {
  addHandOptions(command.argument("<line>", "a command of the board, for example QM")).action(
    (line: string, options: HandOptions) => runRaw(line, handSettings(options, io), options, io),
  );
};

/** The settings that a command uses. It offers no others, since they would have no effect. */
const PEN = ["machine", "pen"];
const PEN_AND_TRAVEL = [...PEN, "motion.travel"];

export const declareHome: Declare = (command, { io }) => {
  addMove(command, PEN_AND_TRAVEL).action((options: HandOptions) => move({ kind: "home" }, options, io));
};

export const declareJog: Declare = (command, { io }) => {
  addMove(place(command, "dx", "dy"), PEN_AND_TRAVEL).action(
    (dxMm: number, dyMm: number, options: HandOptions) => move({ kind: "jog", dxMm, dyMm }, options, io),
  );
};

export const declareMoveTo: Declare = (command, { io }) => {
  addMove(place(command, "x", "y"), PEN_AND_TRAVEL).action((xMm: number, yMm: number, options: HandOptions) =>
    move({ kind: "move-to", xMm, yMm }, options, io),
  );
};

export const declareSetHome: Declare = (command, { io }) => {
  addMove(command, ["machine"]).action((options: HandOptions) => move({ kind: "set-home" }, options, io));
};

export const declareCyclePen: Declare = (command, { io }) => {
  addMove(command, PEN).action((options: HandOptions) => move({ kind: "cycle-pen" }, options, io));
};

export const declareTestPatch: Declare = (command, { io }) => {
  addMove(command, [...PEN, "motion"]).action((options: HandOptions) =>
    move({ kind: "test-patch" }, options, io),
  );
};

export const declareFrame: Declare = (command, { io }) => {
  addMove(command.argument("<file>", "drawing, or - for stdin"), [...PEN_AND_TRAVEL, "prepare"])
    .option("--only <layer...>", "around these layers only, by name, id or leading number")
    .action((file: string, options: OptionValues & FrameOptions) =>
      runFrame(file, handSettings(options, io), options, io),
    );
};

/** The plotter's settings with the options. Says if they name another model than the plotter's. */
function handSettings(options: HandOptions, io: CliIo): PlotSettings {
  mustBeDataFolder(typeof options["data"] === "string" ? options["data"] : undefined);
  const { settings, note } = plotterSettingsFromOptions(options);
  if (note !== null) io.err(`note: ${note}\n`);
  return settings;
}

const addMove = (command: Command, settings: readonly string[]): Command =>
  addData(addDevice(addSettingOptions(command, settings)));

const move = (how: HandMove, options: HandOptions, io: CliIo): Promise<void> =>
  runMove(how, handSettings(options, io), options, io);

function place(command: Command, ...names: readonly string[]): Command {
  for (const name of names) command.argument(`<${name}>`, "mm, or with a unit as in 2cm", length);
  return command;
}

function penPlace(text: string): PenPlace {
  if (text === "up" || text === "down") return text;
  const height = text.trim() === "" ? NaN : Number(text.replace(/%$/, ""));
  if (!(height >= 0 && height <= 100)) {
    throw new InvalidArgumentError("It must be up, down, or a height of 0 to 100 percent.");
  }
  return height;
}
