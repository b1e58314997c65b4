/** The plotter driver on Node, with the computer's clock and serial ports. */
import type { Clock } from "../../src/index.js";
import type { Devices } from "../../host/plotter/devices.js";
import { PlotterDriver as HostDriver } from "../../host/plotter/plotter-driver.js";
import type { PlotterOptions as HostOptions } from "../../host/plotter/plotter-state.js";
import { findBoards } from "../serial/find-boards.js";
import { nodeClock } from "../serial/node-clock.js";
import { openSerial } from "../serial/serial-transport.js";

export type { PlotterState } from "../../host/plotter/plotter-state.js";

const serialDevices: Devices = { find: findBoards, open: openSerial };

/** The clock and the serial ports of this computer. */
export const NODE_PARTS = { clock: nodeClock, devices: serialDevices } as const;

export interface PlotterOptions extends Omit<HostOptions, "clock" | "devices"> {
  readonly clock?: Clock | undefined;
}

export class PlotterDriver extends HostDriver {
  constructor(options: PlotterOptions) {
    super({ ...options, clock: options.clock ?? nodeClock, devices: serialDevices });
  }
}
