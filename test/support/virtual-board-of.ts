import type { PlotterDriver } from "../../server/plotter/node-plotter.js";
import { VirtualBoard } from "../../src/index.js";

/** The virtual EiBotBoard that a plotter is connected to. */
export function virtualBoardOf({ virtualMachine }: PlotterDriver): VirtualBoard {
  if (virtualMachine instanceof VirtualBoard) return virtualMachine;
  throw new TypeError("the plotter is not connected to a virtual EiBotBoard");
}
