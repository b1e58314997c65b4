/** The driver for Grbl. Experimental: it shows that the interface also fits a controller that plans by itself. */
import type { Driver } from "../driver.js";
import { GrblMachine } from "./machine/grbl-machine.js";
import { GrblSession } from "./machine/session.js";
import { VirtualGrbl } from "./virtual/virtual-grbl.js";

export const grblDriver: Driver = {
  identify: async (transport, options) => {
    const session = new GrblSession(transport, options.clock, (error) => options.events.lost(error));
    try {
      return new GrblMachine(session, await session.identify(), options);
    } catch (error) {
      await session.close();
      throw error;
    }
  },
  virtualMachine: (options) => new VirtualGrbl(options),
};
