/** The drivers, by the `kind` of a machine's controller. */
import { PlotwrightError } from "../errors.js";
import type { Controller, MachineProfile } from "../machines/profile.js";
import type { Driver } from "./driver.js";
import { ebbDriver } from "./ebb/ebb-driver.js";
import type { CommandStream } from "./ebb/compile/command-stream.js";

/** What a job's commands can be, one type for each driver. */
export type AnyCommands = CommandStream;

const DRIVERS: Readonly<Record<Controller["kind"], Driver<AnyCommands>>> = {
  ebb: ebbDriver,
};

/** @throws PlotwrightError "bad-setting" for a profile from elsewhere whose controller is not known */
export function driverOf({ name, controller }: MachineProfile): Driver<AnyCommands> {
  if (Object.hasOwn(DRIVERS, controller.kind)) return DRIVERS[controller.kind];
  const known = Object.keys(DRIVERS).join(", ");
  throw new PlotwrightError(
    "bad-setting",
    `The controller of ${name}, "${controller.kind}", is not known. Known controllers: ${known}.`,
  );
}
