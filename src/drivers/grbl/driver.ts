/** Connects to a Grbl controller, or simulates one. `connecting.ts` imports this for the first Grbl machine. */
import type { Driver } from "../driver.js";
import { askGrbl } from "./machine/ask.js";
import { GrblMachine } from "./machine/grbl-machine.js";
import { GrblSession } from "./machine/session.js";
import { bench } from "./virtual/bench.js";
import { VirtualGrbl } from "./virtual/virtual-grbl.js";

export const driver: Driver = {
  ask: askGrbl,
  identify: async (transport, options) => {
    const session = new GrblSession(transport, options.clock);
    try {
      const version = await session.identify();
      session.onFault((error) => options.events.lost(error));
      return new GrblMachine(session, version, options);
    } catch (error) {
      await session.close();
      throw error;
    }
  },
  virtualMachine: (options) => new VirtualGrbl(options),
  bench,
};
