import { PlotwrightError } from "../../../errors.js";
import type { EbbController } from "../../../machines/controllers.js";
import type { MachineProfile } from "../../../machines/profile.js";

/** The machine's controller as this driver's own. Throws `bad-setting` for a machine of another driver. */
export function ebbOf({ name, controller }: MachineProfile): EbbController {
  if (controller.kind === "ebb") return controller;
  throw new PlotwrightError(
    "bad-setting",
    `${name} is not driven by an EiBotBoard: its profile says "${controller.kind}". Choose another machine.`,
  );
}
