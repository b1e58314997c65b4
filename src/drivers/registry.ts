/**
 * The drivers, by the `kind` of a machine's controller. Planning and versions have their own tables, so that
 * a page that only plans does not load the code that talks to a machine.
 */
import { PlotwrightError } from "../errors.js";
import type { Controller } from "../machines/controllers.js";
import type { MachineProfile } from "../machines/profile.js";
import type { Driver, UsbId } from "./driver.js";
import { planEbbJob } from "./ebb/compile/ebb-job.js";
import { ebbDriver } from "./ebb/ebb-driver.js";
import { ebbFirmware } from "./ebb/protocol/firmware-motion.js";
import { grblFirmware, planGrblJob } from "./grbl/grbl-job.js";
import { grblDriver } from "./grbl/grbl-driver.js";
import type { FirmwareRules, PlanForMachine } from "./machine-job.js";

type ByController<T> = Readonly<Record<Controller["kind"], T>>;

const PLANNERS: ByController<PlanForMachine> = { ebb: planEbbJob, grbl: planGrblJob };
const FIRMWARES: ByController<FirmwareRules> = { ebb: ebbFirmware, grbl: grblFirmware };
const DRIVERS: ByController<Driver> = { ebb: ebbDriver, grbl: grblDriver };

/** Plans jobs for a machine. Throws `bad-setting` for a profile with an unknown controller. */
export const plannerOf = (machine: MachineProfile): PlanForMachine => ofController(PLANNERS, machine);

/** Connects machines. Throws `bad-setting` for a profile with an unknown controller. */
export const driverOf = (machine: MachineProfile): Driver => ofController(DRIVERS, machine);

/** The USB devices of all drivers. */
export const usbIds = (): readonly UsbId[] => Object.values(DRIVERS).flatMap((driver) => driver.usbIds);

/** The version to plan for: null if it belongs to a different controller. */
export function firmwareFor(machine: MachineProfile, firmware: string | null): string | null {
  return firmware !== null && ofController(FIRMWARES, machine).isOwn(firmware) ? firmware : null;
}

/** Whether a machine moves in the same way with both versions. */
export function isPlannedAlike(machine: MachineProfile, a: string | null, b: string | null): boolean {
  const { limitsMotion } = ofController(FIRMWARES, machine);
  return limitsMotion(firmwareFor(machine, a)) === limitsMotion(firmwareFor(machine, b));
}

function ofController<T>(table: ByController<T>, { name, controller }: MachineProfile): T {
  if (Object.hasOwn(table, controller.kind)) return table[controller.kind];
  const known = Object.keys(table).join(", ");
  throw new PlotwrightError(
    "bad-setting",
    `The controller of ${name}, "${controller.kind}", is unknown. Known controllers: ${known}.`,
  );
}
