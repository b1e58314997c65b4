/** Connects one plotter for a command. */
import { PlotwrightError } from "../../src/index.js";
import { controllerOf, machineOf } from "../../src/internal.js";
import type { PlotSettings } from "../../src/schema/index.js";
import { FIRST_PLOTTER, NamedPlotter } from "../../host/plotter/named-plotter.js";
import type { PlotterPort } from "../../host/plotter/plotter-port.js";
import { NODE_PARTS } from "./node-plotter.js";

export interface DeviceChoice {
  /** Serial path or "virtual"; default: the first EiBotBoard. */
  readonly device?: string | undefined;
  readonly virtualSpeed?: number | undefined;
}

/**
 * Connects one plotter for a command; throws `no-board` if that fails, `bad-setting` for an unknown machine. It never falls back to the virtual
 * board: a command that silently draws nothing would look as if it had worked.
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
