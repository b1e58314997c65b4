/** The EiBotBoard for `registry.ts`. */
import type { ControllerDescription, Driver } from "../driver.js";
import { connectBoard } from "./machine/connection.js";
import { EbbMachine } from "./machine/ebb-machine.js";
import { EBB_FIELDS } from "./protocol/ebb-controller.js";
import { ebbFirmware } from "./protocol/firmware-motion.js";
import { VirtualBoard } from "./virtual/virtual-board.js";

export const description: ControllerDescription = {
  fields: EBB_FIELDS,
  contradictionOf: ({ servoPosAt0Pct, servoPosAt100Pct }) =>
    servoPosAt0Pct === servoPosAt100Pct
      ? { field: "servoPosAt100Pct", message: "the servo has no range: 0 % and 100 % are the same position" }
      : null,
  // Microchip's vendor ID, with a sublicensed product ID.
  usbIds: [{ vendorId: "04d8", productId: "fd92" }],
  firmware: ebbFirmware,
};

export { planEbbJob as planJob } from "./compile/ebb-job.js";

export const driver: Driver = {
  identify: async (transport, options) =>
    new EbbMachine(await connectBoard(transport, options), options.events),
  virtualMachine: (options) => new VirtualBoard({ ...options, servo: {} }),
};
