/** The single commands to the machine: pen, manual moves, a raw line, info. */
import { InvalidArgumentError, type Command } from "commander";
import { PlotwrightError } from "../../src/index.js";
import { firmwareAdvice, machineOf, printableJson } from "../../src/internal.js";
import type { HandMove, PlotSettings } from "../../src/schema/index.js";
import { connectPlotter, NOT_PLUGGED_IN } from "../../host/handle/own-plotter.js";
import type { PlotterPort } from "../../host/plotter/plotter-port.js";
import { drawingBoxMm } from "../planning/planner.js";
import { NODE_PARTS } from "../plotter/node-parts.js";
import { mustBeDataFolder, withDrawingFile } from "./files.js";
import { printed, type CliIo } from "./io.js";
import {
  addData,
  addDevice,
  addFont,
  addHandOptions,
  addJson,
  length,
  percent,
  type Declare,
  type DeviceOptions,
} from "./options.js";
import { serverHint } from "./client/server-client.js";
import {
  servedPlotter,
  throughServer,
  type HandPlotter,
  type ServedPlotter,
} from "./client/served-plotter.js";
import { settingsOfOwnPlotter, withPortByName } from "./client/known-plotters.js";
import { addSettingOptions, type OptionValues } from "./settings-options.js";

type HandOptions = OptionValues & DeviceOptions;

/** Up, down or a height in percent. */
type PenHeight = "up" | "down" | number;

export const declarePen: Declare = (command, { io }) => {
  addHandOptions(command.argument("<where>", "up, down, or a height in percent", penHeight))
    .option("--pen-up <percent>", "height when up (default: 60)", percent)
    .option("--pen-down <percent>", "height when down (default: 30)", percent)
    .action((where: PenHeight, options: HandOptions) =>
      byHand(options, io, (plotter, { pen: { upPct, downPct } }) => {
        const heightPct = where === "up" ? upPct : where === "down" ? downPct : where;
        // A height in percent counts as down: the next move lifts the pen first.
        return plotter.pen({ up: where === "up", heightPct });
      }),
    );
};

export const declareAlign: Declare = (command, { io }) => {
  addHandOptions(command).action((options: HandOptions) =>
    byHand(options, io, async (plotter) => {
      await plotter.pen({ up: true });
      await plotter.motorsOff();
    }),
  );
};

export const declareInfo: Declare = (command, { io }) => {
  addJson(addHandOptions(command)).action((options: HandOptions & { json?: boolean }) =>
    byHand(options, io, (plotter, settings) => {
      const { name, kind, device, firmware, penUp, motorsOn, xMm, yMm } = plotter.snapshot();
      if (options.json === true) {
        io.out(`${printableJson({ name, kind, device, firmware, penUp, motorsOn, xMm, yMm })}\n`);
        return;
      }
      const advice = firmwareAdvice(machineOf(settings), { kind, firmware });
      io.out(
        [
          printed`name      ${name}`,
          printed`device    ${device ?? kind}`,
          printed`firmware  ${firmware ?? "not known"}`,
          `pen       ${penUp === null ? "not known" : penUp ? "up" : "down"}`,
          `motors    ${motorsOn === null ? "not known" : motorsOn ? "on" : "off"}`,
          `position  ${xMm === null || yMm === null ? "not known" : `${xMm.toFixed(2)}, ${yMm.toFixed(2)} mm`}`,
          ...(advice === null ? [] : [`note      ${advice}`]),
          "",
        ].join("\n"),
      );
    }),
  );
};

/** Sends one line to the board and prints its answer. Rejects with `board-error` if the board refuses the line. */
export const declareRaw: Declare = (command, { io }) => {
  addHandOptions(command.argument("<line>", "a command of the board, for example QM")).action(
    (line: string, options: HandOptions) =>
      byHand(options, io, async (plotter) => {
        const { replies, refused, note } = await plotter.command(line);
        if (refused) {
          throw new PlotwrightError("board-error", `The board refused ${line}: ${replies.join(", ")}`);
        }
        replies.forEach((reply) => io.out(printed`${reply}\n`));
        if (note !== null) io.err(printed`${note}\n`);
      }),
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

/** Moves around the edge of the drawing on the paper. */
export const declareFrame: Declare = (command, { io }) => {
  addFont(addMove(command.argument("<file>", "drawing, or - for stdin"), [...PEN_AND_TRAVEL, "prepare"]))
    .option("--only <layer...>", "around these layers only, by name, id or leading number")
    .action(
      async (
        file: string,
        options: HandOptions & { readonly only?: readonly string[]; readonly font?: string },
      ) => {
        const found = await findPlotter(options, io);
        const boxMm = await withDrawingFile(file, (path) => drawingBoxMm(path, found.settings, options));
        await usePlotter(found, io, (plotter) => plotter.move({ kind: "frame", boxMm }, found.settings));
      },
    );
};

/** Makes one manual move, with the machine, speeds and heights of the settings. */
const move = (how: HandMove, options: HandOptions, io: CliIo): Promise<void> =>
  byHand(options, io, (plotter, settings) => plotter.move(how, settings));

const addMove = (command: Command, settings: readonly string[]): Command =>
  addData(addDevice(addSettingOptions(command, settings)));

function place(command: Command, ...names: readonly string[]): Command {
  for (const name of names) command.argument(`<${name}>`, "mm, or with a unit as in 2cm", length);
  return command;
}

function penHeight(text: string): PenHeight {
  if (text === "up" || text === "down") return text;
  const height = text.trim() === "" ? NaN : Number(text.replace(/%$/, ""));
  if (!(height >= 0 && height <= 100)) {
    throw new InvalidArgumentError("It must be up, down, or a height of 0 to 100 percent.");
  }
  return height;
}

interface Found {
  /** Null: the command opens the plotter itself. */
  readonly served: ServedPlotter | null;
  readonly settings: PlotSettings;
  /** Their --device is a port. */
  readonly options: HandOptions;
}

/** The plotter's settings with the options. Says if they name another model than the plotter's. */
async function findPlotter(given: HandOptions, io: CliIo): Promise<Found> {
  mustBeDataFolder(typeof given["data"] === "string" ? given["data"] : undefined);
  const served = await servedPlotter(given);
  const options = served === null ? await withPortByName(given) : given;
  const { settings, note } = served?.settings ?? (await settingsOfOwnPlotter(options));
  if (note !== null) io.err(printed`note: ${note}\n`);
  return { served, settings, options };
}

async function byHand(
  options: HandOptions,
  io: CliIo,
  use: (plotter: HandPlotter, settings: PlotSettings) => Promise<void> | void,
): Promise<void> {
  const found = await findPlotter(options, io);
  await usePlotter(found, io, (plotter) => use(plotter, found.settings));
}

/** Through the server that has the plotter, or else directly. An interrupt stops the move, and the pen is lifted. */
async function usePlotter(
  { served, settings, options }: Found,
  io: CliIo,
  use: (plotter: HandPlotter) => Promise<void> | void,
): Promise<void> {
  const stop = new AbortController();
  const interrupted = new Promise<never>((_resolve, reject) => {
    const end = (): void => reject(new PlotwrightError("cancelled", "The command was stopped."));
    stop.signal.addEventListener("abort", end);
  });
  // It may reject while nothing waits for it: before the plotter is open, or when the move is done.
  interrupted.catch(() => undefined);
  const untilInterrupt = (plotter: HandPlotter): Promise<void> =>
    stop.signal.aborted ? interrupted : Promise.race([use(plotter), interrupted]);
  const forget = io.onInterrupt(() => stop.abort());
  try {
    if (served === null) await withPlotter(options, settings, untilInterrupt);
    else await untilInterrupt(await throughServer(served, stop.signal));
  } finally {
    // Only after closing: a second Ctrl-C must not end the process before the pen is up.
    forget();
  }
}

function withVirtualHint(error: unknown): unknown {
  if (!(error instanceof PlotwrightError) || error.message !== NOT_PLUGGED_IN) return error;
  return new PlotwrightError(
    error.code,
    `${NOT_PLUGGED_IN} To try this without a plotter, add --device virtual.`,
  );
}

export async function withPlotter<T>(
  options: DeviceOptions,
  settings: PlotSettings,
  use: (plotter: PlotterPort) => Promise<T> | T,
): Promise<T> {
  const plotter = await connectPlotter(options, settings, NODE_PARTS).catch(async (error: unknown) => {
    throw await serverHint(withVirtualHint(error));
  });
  try {
    return await use(plotter);
  } finally {
    await plotter.close();
  }
}
