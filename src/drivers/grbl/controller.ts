/** The exports of this folder for `registry.ts`. */
import type { ControllerDescription } from "../driver.js";
import { GRBL_FIELDS } from "./model/grbl-controller.js";
import { UNUSED_SETTINGS } from "./unused-settings.js";

export const description: ControllerDescription = {
  fields: GRBL_FIELDS,
  // Many other devices have the same USB chips as these boards.
  usbIds: [],
  // The plan does not depend on the version.
  firmware: { isOwn: (firmware) => firmware.startsWith("Grbl"), limitsMotion: () => false },
  unusedSettings: UNUSED_SETTINGS,
};

export { planGrblJob as planJob } from "./grbl-job.js";
export { grblDriver as driver } from "./grbl-driver.js";
