/** The EiBotBoard for `registry.ts`. */
import type { Controller } from "../../machines/profile.js";
import type { ControllerDescription } from "../driver.js";
import { EBB_FIELDS, findsHome, type EbbController } from "./protocol/ebb-controller.js";
import { ebbFirmware } from "./protocol/firmware-motion.js";

export const description: ControllerDescription = {
  fields: EBB_FIELDS,
  contradictionOf: contradictionIn,
  findsHome,
  // Microchip's vendor ID, with a sublicensed product ID.
  usbIds: [{ vendorId: "04d8", productId: "fd92" }],
  candidateIds: [],
  firmware: ebbFirmware,
  consoleExamples: ["QS", "QM", "V"],
};

export { planEbbJob as planJob } from "./compile/ebb-job.js";

function contradictionIn(controller: Controller): { field: string; message: string } | null {
  const { servoPosAt0Pct, servoPosAt100Pct, homing, cornerSwitch } = controller as EbbController;
  if (servoPosAt0Pct === servoPosAt100Pct)
    return {
      field: "servoPosAt100Pct",
      message: "the servo has no range: 0 % and 100 % are the same position",
    };
  if (homing && cornerSwitch)
    return {
      field: "cornerSwitch",
      message: "a machine has either one switch in its corner or two (homing)",
    };
  if (cornerSwitch && cornerSwitch.port !== "B")
    return { field: "cornerSwitch", message: "the board can stop only at a switch on port B" };
  return null;
}
