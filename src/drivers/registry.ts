/**
 * The drivers, by the `kind` of a machine's controller. Planning has a table of its own: a page that only plans does not
 * load what talks to a machine.
 */
import { PlotwrightError } from "../errors.js";
import type { Controller } from "../machines/controllers.js";
import type { MachineProfile } from "../machines/profile.js";
import type { Driver } from "./driver.js";
import type { CommandStream } from "./ebb/compile/command-stream.js";
import { planEbbJob } from "./ebb/compile/ebb-job.js";
import { ebbDriver } from "./ebb/ebb-driver.js";
import type { PlanForMachine } from "./machine-job.js";

/** What a job's commands can be, one type for each driver. */
export type AnyCommands = CommandStream;

type ByController<T> = Readonly<Partial<Record<Controller["kind"], T>>>;

const PLANNERS: ByController<PlanForMachine<AnyCommands>> = { ebb: planEbbJob };
const DRIVERS: ByController<Driver> = { ebb: ebbDriver };

/** Plans jobs for a machine. Throws `bad-setting` for a profile whose controller is not known. */
export const plannerOf = (machine: MachineProfile): PlanForMachine<AnyCommands> =>
  ofController(PLANNERS, machine);

/** Connects machines. Throws `bad-setting` for a profile whose controller is not known. */
export const driverOf = (machine: MachineProfile): Driver => ofController(DRIVERS, machine);

function ofController<T>(table: ByController<T>, { name, controller }: MachineProfile): T {
  const found = Object.hasOwn(table, controller.kind) ? table[controller.kind] : undefined;
  if (found) return found;
  const known = Object.keys(table).join(", ");
  throw new PlotwrightError(
    "bad-setting",
    `The controller of ${name}, "${controller.kind}", is not known. Known controllers: ${known}.`,
  );
}
