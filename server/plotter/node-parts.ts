/** The clock and the serial ports of this computer, for the host. */
import type { ClockAndPorts } from "../../host/handle/own-plotter.js";
import { findBoards } from "../serial/find-boards.js";
import { nodeClock } from "../serial/node-clock.js";
import { openSerial } from "../serial/serial-transport.js";

export const NODE_PARTS: ClockAndPorts = {
  clock: nodeClock,
  devices: { find: findBoards, open: openSerial },
};
