/** Grbl for `registry.ts`. Experimental: it shows that the interface also fits a controller that plans by itself. */
import type { ControllerDescription, Driver } from "../driver.js";
import { GrblMachine } from "./machine/grbl-machine.js";
import { GrblSession } from "./machine/session.js";
import { findsHome, GRBL_FIELDS } from "./model/grbl-controller.js";
import { LIFT_CHOICE, liftFault } from "./model/pen-lift.js";
import { isOwnVersion } from "./protocol.js";
import { UNUSED_SETTINGS } from "./unused-settings.js";
import { bench } from "./virtual/bench.js";
import { VirtualGrbl } from "./virtual/virtual-grbl.js";

export const description: ControllerDescription = {
  fields: GRBL_FIELDS,
  choice: LIFT_CHOICE,
  contradictionOf: liftFault,
  findsHome,
  // Many other devices have the same USB chips as these boards.
  usbIds: [],
  // The plan does not depend on the version.
  firmware: {
    isOwn: isOwnVersion,
    isPlannedAlike: () => true,
    advice: () => null,
  },
  unusedSettings: UNUSED_SETTINGS,
};

export { planGrblJob as planJob } from "./grbl-job.js";

export const driver: Driver = {
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
