/** Entry "plotwright/plotter" in a page: opens a plotter for a program. Node gets server/plotter/open-plotter.ts. */
import { PlotwrightError } from "../../src/index.js";
import { openHandle, type PlotterChoice, type PlotterHandle } from "../../host/handle/open-handle.js";
import { browserClock, openWebSerial, requestBoard, type WebSerialPort } from "./web-serial.js";

export type * from "../../host/handle/plotter-handle.js";

const noPorts = (): Promise<never> =>
  Promise.reject(
    new PlotwrightError("not-allowed", "A page can't open a port by its path: use webSerial, or url."),
  );

/** As on Node (server/plotter/open-plotter.ts). */
export const openPlotter = (choice: PlotterChoice): Promise<PlotterHandle> =>
  openHandle(
    choice,
    { clock: browserClock(), devices: { find: noPorts, open: noPorts } },
    (port) => (port === true ? requestBoard() : openWebSerial(port as WebSerialPort)),
    (address, protocols) => Promise.resolve(new WebSocket(address, protocols)),
  );
