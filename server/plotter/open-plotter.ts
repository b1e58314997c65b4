/** Entry "plotwright/plotter" on Node, Bun and Deno: opens a plotter for a program. Browsers get web/serial/open-plotter.ts. */
import { openHandle, type PlotterChoice, type PlotterHandle } from "../../host/handle/open-handle.js";
import { NODE_PARTS, openSocket } from "./node-parts.js";

export type * from "../../host/handle/plotter-handle.js";

/**
 * Opens a plotter: on a serial port (`device`), the built-in virtual one (`virtual`), or one of a running server (`url`).
 * In a page also by Web Serial (`webSerial`).
 *
 * @throws PlotwrightError "no-board", "busy", "not-allowed", "bad-setting"; with `url` "disconnected", "not-found"
 */
export const openPlotter = (choice: PlotterChoice): Promise<PlotterHandle> =>
  openHandle(choice, NODE_PARTS, null, openSocket);
