/** One-off commands to the machine: pen, home, devices, info. */
import { DEFAULT_PLOT_SETTINGS } from "../../src/schema/index.js";
import { openPlotter } from "../plotters.js";
import type { PlotterPort } from "../queue/plotter-port.js";
import { findBoards } from "../serial/find-boards.js";
import type { CliIo } from "./io.js";

export interface DeviceOptions {
  readonly device?: string;
  readonly virtualSpeed?: number;
}

export interface PenOptions extends DeviceOptions {
  readonly penUp?: number;
  readonly penDown?: number;
}

export async function runPen(where: "up" | "down", options: PenOptions): Promise<void> {
  const { upPct, downPct } = DEFAULT_PLOT_SETTINGS.pen;
  const heightPct = where === "up" ? (options.penUp ?? upPct) : (options.penDown ?? downPct);
  await withPlotter(options, (plotter) => plotter.pen(where === "up", heightPct));
}

export async function runHome(options: DeviceOptions): Promise<void> {
  await withPlotter(options, (plotter) => plotter.home());
}

export async function runDevices(io: CliIo): Promise<void> {
  const boards = await findBoards();
  for (const { path, description, serialNumber } of boards) {
    io.out(`${path}\t${description}${serialNumber === null ? "" : ` (${serialNumber})`}\n`);
  }
  io.out("virtual\tthe built-in virtual board\n");
}

export async function runInfo(options: DeviceOptions, io: CliIo): Promise<void> {
  await withPlotter(options, (plotter) => {
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
  use: (plotter: PlotterPort) => Promise<T> | T,
): Promise<T> {
  const plotter = await openPlotter(options);
  try {
    return await use(plotter);
  } finally {
    await plotter.close();
  }
}
