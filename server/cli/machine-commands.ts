/** One-off commands to the machine: pen, moves by hand, devices, machines, info. */
import { resolve } from "node:path";
import type { PlotSettings } from "../../src/schema/index.js";
import { defaultDataDir } from "../data-dir.js";
import { MachineFiles } from "../machines/machine-files.js";
import { drawingBoxMm } from "../planning/drawing-box.js";
import type { HandMove } from "../plotter/hand-moves.js";
import { openPlotter } from "../driven-plotter.js";
import type { PlotterPort } from "../queue/plotter-port.js";
import { findBoards } from "../serial/find-boards.js";
import type { CliIo } from "./io.js";

export interface DeviceOptions {
  readonly device?: string;
  readonly virtualSpeed?: number;
}

export async function runPen(
  where: "up" | "down",
  settings: PlotSettings,
  options: DeviceOptions,
): Promise<void> {
  const { upPct, downPct } = settings.pen;
  await withPlotter(options, settings, (plotter) =>
    plotter.pen(where === "up", where === "up" ? upPct : downPct),
  );
}

/** One move by hand, with the machine, speeds and heights of the settings. */
export async function runMove(move: HandMove, settings: PlotSettings, options: DeviceOptions): Promise<void> {
  await withPlotter(options, settings, (plotter) => plotter.move(move, settings));
}

/** Walks around where a drawing would come to lie. */
export async function runFrame(
  file: string,
  settings: PlotSettings,
  options: DeviceOptions & { readonly only?: readonly string[] },
): Promise<void> {
  const boxMm = await drawingBoxMm(resolve(file), settings, options.only);
  await runMove({ kind: "frame", boxMm }, settings, options);
}

/** Motors off, so that the carriage can be put to home by hand. */
export async function runAlign(settings: PlotSettings, options: DeviceOptions): Promise<void> {
  await withPlotter(options, settings, async (plotter) => {
    await plotter.pen(true);
    await plotter.motorsOff();
  });
}

export function runMachines(options: { readonly data?: string }, io: CliIo): void {
  const files = new MachineFiles(options.data ?? defaultDataDir());
  for (const { id, name, widthMm, heightMm, builtIn } of files.list()) {
    io.out(`${id}\t${name}\t${widthMm} × ${heightMm} mm${builtIn ? "" : "\tyour own"}\n`);
  }
  files.warnings.forEach((warning) => io.err(`${warning}\n`));
}

export async function runDevices(io: CliIo): Promise<void> {
  const boards = await findBoards();
  for (const { path, description, serialNumber } of boards) {
    io.out(`${path}\t${description}${serialNumber === null ? "" : ` (${serialNumber})`}\n`);
  }
  io.out("virtual\tthe built-in virtual board\n");
}

export async function runInfo(settings: PlotSettings, options: DeviceOptions, io: CliIo): Promise<void> {
  await withPlotter(options, settings, (plotter) => {
    const { name, kind, device, firmware, penUp, motorsOn, xMm, yMm } = plotter.snapshot();
    const known = (value: unknown): string => (value === null ? "not known" : String(value));
    io.out(
      [
        `name      ${name}`,
        `device    ${device ?? kind}`,
        `firmware  ${known(firmware)}`,
        `pen       ${penUp === null ? "not known" : penUp ? "up" : "down"}`,
        `motors    ${motorsOn === null ? "not known" : motorsOn ? "on" : "off"}`,
        `place     ${xMm === null || yMm === null ? "not known" : `${xMm.toFixed(2)}, ${yMm.toFixed(2)} mm`}`,
        "",
      ].join("\n"),
    );
  });
}

export async function withPlotter<T>(
  options: DeviceOptions,
  settings: PlotSettings,
  use: (plotter: PlotterPort) => Promise<T> | T,
): Promise<T> {
  const plotter = await openPlotter(options, settings);
  try {
    return await use(plotter);
  } finally {
    await plotter.close();
  }
}
