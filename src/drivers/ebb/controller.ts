/** The exports of this folder for `registry.ts`. */
import type { ControllerDescription } from "../driver.js";
import { EBB_FIELDS } from "./protocol/ebb-controller.js";
import { ebbFirmware } from "./protocol/firmware-motion.js";

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
export { ebbDriver as driver } from "./ebb-driver.js";
