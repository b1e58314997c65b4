/** Grbl and its children for `registry.ts`. */
import type { ControllerDescription } from "../driver.js";
import { isOwnVersion, takesArcs } from "./model/firmware.js";
import { findsHome, GRBL_FIELDS } from "./model/grbl-controller.js";
import { LIFT_CHOICE, liftFault } from "./model/pen-lift.js";
import { UNUSED_SETTINGS } from "./unused-settings.js";

export const description: ControllerDescription = {
  fields: GRBL_FIELDS,
  choice: LIFT_CHOICE,
  contradictionOf: liftFault,
  findsHome,
  // Many other devices have the same USB chips as these boards.
  usbIds: [],
  candidateIds: [
    // WCH: CH340, CH9102.
    { vendorId: "1a86" },
    // FTDI: FT232R, FT231X.
    { vendorId: "0403", productId: "6001" },
    { vendorId: "0403", productId: "6015" },
    // Silicon Labs: CP210x.
    { vendorId: "10c4", productId: "ea60" },
    // Arduino, and arduino.org.
    { vendorId: "2341" },
    { vendorId: "2a03" },
    // Espressif: the USB port of an ESP32-S3.
    { vendorId: "303a" },
  ],
  firmware: {
    isOwn: isOwnVersion,
    // The version says only whether there are arcs.
    isPlannedAlike: (_, a, b) => takesArcs(a) === takesArcs(b),
    advice: () => null,
  },
  consoleExamples: ["$$", "$#", "$I"],
  unusedSettings: UNUSED_SETTINGS,
  scaleSettings: ["$100", "$101"],
};

export { planGrblJob as planJob } from "./grbl-job.js";
