/** Runs the single commands to the machine: pen, manual moves, a raw line, info. */
import type { HandMove, PlotSettings } from "../../src/schema/index.js";
import { PlotwrightError } from "../../src/index.js";
import { firmwareAdvice, machineOf, printableJson } from "../../src/internal.js";
import { drawingBoxMm } from "../planning/drawing-box.js";
import { openPlotter } from "../plotter/open-plotter.js";
import type { PlotterPort } from "../../host/plotter/plotter-port.js";
import { withDrawingFile } from "./files.js";
import { printed, type CliIo } from "./io.js";
import type { DeviceOptions } from "./options.js";
import { serverHint } from "./server-client.js";

/** Up, down or a height in percent. */
export type PenPlace = "up" | "down" | number;

export interface FrameOptions extends DeviceOptions {
  readonly only?: readonly string[];
}

export async function runPen(
  where: PenPlace,
  settings: PlotSettings,
  options: DeviceOptions,
  io: CliIo,
): Promise<void> {
  const { upPct, downPct } = settings.pen;
  const heightPct = where === "up" ? upPct : where === "down" ? downPct : where;
  // A height in percent counts as down: the next move lifts the pen first.
  await byHand(options, settings, io, (plotter) => plotter.pen({ up: where === "up", heightPct }));
}

/** Sends one line to the board and prints its answer. Rejects with `board-error` if the board refuses the line. */
export async function runRaw(
  line: string,
  settings: PlotSettings,
  options: DeviceOptions,
  io: CliIo,
): Promise<void> {
  await byHand(options, settings, io, async (plotter) => {
    const { replies, refused, note } = await plotter.command(line);
    if (refused) throw new PlotwrightError("board-error", `The board refused ${line}: ${replies.join(", ")}`);
    replies.forEach((reply) => io.out(printed`${reply}\n`));
    if (note !== null) io.err(printed`${note}\n`);
  });
}

/** Makes one manual move, with the machine, speeds and heights of the settings. */
export async function runMove(
  move: HandMove,
  settings: PlotSettings,
  options: DeviceOptions,
  io: CliIo,
): Promise<void> {
  await byHand(options, settings, io, (plotter) => plotter.move(move, settings));
}

/** Moves around the edge of the drawing on the paper. */
export async function runFrame(
  file: string,
  settings: PlotSettings,
  options: FrameOptions,
  io: CliIo,
): Promise<void> {
  const boxMm = await withDrawingFile(file, (path) => drawingBoxMm(path, settings, options.only));
  await runMove({ kind: "frame", boxMm }, settings, options, io);
}

/** Switches the motors off, so that the carriage can be pushed home by hand. */
export async function runAlign(settings: PlotSettings, options: DeviceOptions, io: CliIo): Promise<void> {
  await byHand(options, settings, io, async (plotter) => {
    await plotter.pen({ up: true });
    await plotter.motorsOff();
  });
}

export async function runInfo(
  settings: PlotSettings,
  options: DeviceOptions & { readonly json?: boolean },
  io: CliIo,
): Promise<void> {
  await byHand(options, settings, io, (plotter) => {
    const { name, kind, device, firmware, penUp, motorsOn, xMm, yMm } = plotter.snapshot();
    if (options.json === true) {
      io.out(`${printableJson({ name, kind, device, firmware, penUp, motorsOn, xMm, yMm })}\n`);
      return;
    }
    const advice = firmwareAdvice(machineOf(settings), { kind, firmware });
    const known = (value: unknown): string => (value === null ? "not known" : String(value));
    io.out(
      [
        printed`name      ${name}`,
        printed`device    ${device ?? kind}`,
        printed`firmware  ${known(firmware)}`,
        `pen       ${penUp === null ? "not known" : penUp ? "up" : "down"}`,
        `motors    ${motorsOn === null ? "not known" : motorsOn ? "on" : "off"}`,
        `place     ${xMm === null || yMm === null ? "not known" : `${xMm.toFixed(2)}, ${yMm.toFixed(2)} mm`}`,
        ...(advice === null ? [] : [`note      ${advice}`]),
        "",
      ].join("\n"),
    );
  });
}

/** For a single command: an interrupt stops the move, and closing the plotter then lifts the pen. */
async function byHand(
  options: DeviceOptions,
  settings: PlotSettings,
  io: CliIo,
  use: (plotter: PlotterPort) => Promise<void> | void,
): Promise<void> {
  let forget = (): void => undefined;
  try {
    await withPlotter(options, settings, (plotter) => {
      const interrupted = new Promise<never>((_resolve, reject) => {
        forget = io.onInterrupt(() => reject(new PlotwrightError("cancelled", "The command was stopped.")));
      });
      return Promise.race([use(plotter), interrupted]);
    });
  } finally {
    // Only after closing: a second Ctrl-C must not end the process before the pen is up.
    forget();
  }
}

export async function withPlotter<T>(
  options: DeviceOptions,
  settings: PlotSettings,
  use: (plotter: PlotterPort) => Promise<T> | T,
): Promise<T> {
  const plotter = await openPlotter(options, settings).catch(async (error: unknown) => {
    throw await serverHint(error);
  });
  try {
    return await use(plotter);
  } finally {
    await plotter.close();
  }
}
