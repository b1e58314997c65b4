/** The EiBotBoard as a driver. */
import type { Driver } from "../driver.js";
import type { CommandStream } from "./compile/command-stream.js";
import { planEbbJob } from "./compile/ebb-job.js";
import { connectBoard } from "./machine/connection.js";
import { EbbMachine } from "./machine/ebb-machine.js";
import { VirtualBoard } from "./virtual/virtual-board.js";

export const ebbDriver: Driver<CommandStream> = {
  plan: planEbbJob,
  identify: async (transport, options) =>
    new EbbMachine(await connectBoard(transport, options), options.events),
  virtualMachine: ({ firmware, ...options }) =>
    new VirtualBoard(firmware === undefined ? options : { ...options, firmware }),
};
