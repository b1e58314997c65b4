/** A plotter's connection on Node, with the computer's clock and serial ports: for programs, and for a command. */
import { type Clock, PlotwrightError } from "../../src/index.js";
import type { Devices } from "../../host/plotter/connected-machine.js";
import { PlotterConnection as HostDriver } from "../../host/plotter/plotter-connection.js";
import type { PlotterOptions as HostOptions } from "../../host/plotter/plotter-state.js";
import type { PlotSettings } from "../../src/schema/index.js";
import { findBoards } from "../serial/find-boards.js";
import { nodeClock } from "../serial/node-clock.js";
import { openSerial } from "../serial/serial-transport.js";
import { controllerOf, machineOf } from "../../src/internal.js";
import { FIRST_PLOTTER, NamedPlotter } from "../../host/plotter/named-plotter.js";
import type { PlotterPort } from "../../host/plotter/plotter-port.js";

export type { PlotterState } from "../../host/plotter/plotter-state.js";

const serialDevices: Devices = { find: findBoards, open: openSerial };

/** The clock and the serial ports of this computer. */
export const NODE_PARTS = { clock: nodeClock, devices: serialDevices } as const;

export interface NodePlotterOptions extends Omit<HostOptions, "clock" | "devices"> {
  readonly clock?: Clock | undefined;
}

/** For programs: the manual moves by name. */
export class NodePlotter extends HostDriver {
  constructor(options: NodePlotterOptions) {
    super({ ...options, clock: options.clock ?? nodeClock, devices: serialDevices });
  }

  /** Lifts the pen and moves home; a machine with limit switches finds it with them. */
  home(settings?: PlotSettings): Promise<void> {
    return this.move({ kind: "home" }, settings);
  }

  /** Makes the current position home. */
  setHome(settings?: PlotSettings): Promise<void> {
    return this.move({ kind: "set-home" }, settings);
  }

  /** Moves to a position in mm from home, pen up. */
  moveTo(xMm: number, yMm: number, settings?: PlotSettings): Promise<void> {
    return this.move({ kind: "move-to", xMm, yMm }, settings);
  }

  /** Moves by a distance in mm, pen up. May go beyond home, since this is how the user finds home. */
  jog(dxMm: number, dyMm: number, settings?: PlotSettings): Promise<void> {
    return this.move({ kind: "jog", dxMm, dyMm }, settings);
  }

  /** Lowers the pen and lifts it again, to check the heights. */
  cyclePen(settings?: PlotSettings): Promise<void> {
    return this.move({ kind: "cycle-pen" }, settings);
  }

  /** Moves around a rectangle (mm from home) with the pen up, and back to the previous position. */
  traceFrame(x0Mm: number, y0Mm: number, x1Mm: number, y1Mm: number, settings?: PlotSettings): Promise<void> {
    const boxMm = {
      xMm: Math.min(x0Mm, x1Mm),
      yMm: Math.min(y0Mm, y1Mm),
      widthMm: Math.abs(x1Mm - x0Mm),
      heightMm: Math.abs(y1Mm - y0Mm),
    };
    return this.move({ kind: "frame", boxMm }, settings);
  }

  /** Draws a small pattern at the current position with the given settings, and comes back. */
  drawTestPatch(settings?: PlotSettings): Promise<void> {
    return this.move({ kind: "test-patch" }, settings);
  }

  /** Draws a square at the current position; its measured size gives the motor steps per mm. */
  drawSquare(sizeMm: number, settings?: PlotSettings): Promise<void> {
    return this.move({ kind: "square", sizeMm }, settings);
  }
}

interface DeviceChoice {
  /** Serial path or "virtual"; default: the first EiBotBoard. */
  readonly device?: string | undefined;
  readonly virtualSpeed?: number | undefined;
}

/**
 * Connects one plotter for a command; throws `no-board` if that fails, `bad-setting` for an unknown machine. It never falls
 * back to the virtual board: a command that silently draws nothing would look as if it had worked.
 */
export async function openPlotter(choice: DeviceChoice, settings: PlotSettings): Promise<PlotterPort> {
  const { device = "auto", virtualSpeed } = choice;
  // Throws for an unknown machine, which the plotter would report as a board that can't be reached.
  const machine = machineOf(settings);
  const plotter = new NamedPlotter(
    { id: FIRST_PLOTTER, name: null, machine: null },
    { device, virtualSpeed, virtualIfNone: false, settings, ...NODE_PARTS },
  );
  await plotter.start();
  const { connection, message } = plotter.snapshot();
  if (connection === "idle") return plotter;
  await plotter.close();
  if (connection === "absent" && device === "auto" && controllerOf(machine).usbIds.length > 0) {
    throw new PlotwrightError(
      "no-board",
      "No plotter is plugged in: check its USB cable and its power. To try this without a plotter, add --device virtual.",
    );
  }
  throw new PlotwrightError("no-board", message ?? "The plotter can't be reached.");
}
