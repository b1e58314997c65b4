/** A plotter on a virtual EiBotBoard, whose time passes only when the test lets it. */
import { NodePlotter, type NodePlotterOptions } from "./node-plotter.js";
import { PlotwrightError, VirtualBoard } from "../../../src/index.js";
import { ManualClock } from "../clocks/manual-clock.js";

interface VirtualPlotter {
  readonly world: ManualClock;
  readonly driver: NodePlotter;
  readonly board: VirtualBoard;
}

/** Connected and idle. */
export async function virtualPlotter(
  options: Omit<NodePlotterOptions, "device" | "clock"> = {},
): Promise<VirtualPlotter> {
  const world = new ManualClock();
  const driver = new NodePlotter({ device: "virtual", clock: world, ...options });
  await world.run(driver.start());
  return { world, driver, board: virtualBoardOf(driver) };
}

/** The virtual EiBotBoard that a plotter is connected to. */
export function virtualBoardOf({ virtualMachine }: NodePlotter): VirtualBoard {
  if (virtualMachine instanceof VirtualBoard) return virtualMachine;
  throw new TypeError("the plotter is not connected to a virtual EiBotBoard");
}

/** What a promise resolves with, or its error as "code: message". */
export const outcome = (promise: Promise<unknown>): Promise<unknown> =>
  promise.catch((error: unknown) =>
    error instanceof PlotwrightError ? `${error.code}: ${error.message}` : String(error),
  );
