/** The EiBotBoard as a driver. */
import type { Driver } from "../driver.js";
import { connectBoard } from "./machine/connection.js";
import { EbbMachine } from "./machine/ebb-machine.js";
import { VirtualBoard } from "./virtual/virtual-board.js";

export const ebbDriver: Driver = {
  identify: async (transport, options) =>
    new EbbMachine(await connectBoard(transport, options), options.events),
  virtualMachine: ({ firmware, ...options }) =>
    new VirtualBoard({ ...options, servo: {}, ...(firmware === undefined ? {} : { firmware }) }),
};
