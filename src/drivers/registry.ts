/**
 * The controllers, by the `kind` of a machine's controller. There are two tables instead of one because a bundler keeps or
 * drops a table as a whole. The page loads only the descriptions (2 kB), and its worker also the planners (26 kB). The
 * drivers are in `connecting.ts`.
 */
import { PlotwrightError } from "../errors.js";
import { checkController, checkProfile } from "../machines/check-profile.js";
import type { MachineProfile } from "../machines/profile.js";
import type { PenSettings } from "../settings/pen.js";
import type { ControllerDescription, UsbId } from "./driver.js";
import * as ebb from "./ebb/controller.js";
import * as grbl from "./grbl/controller.js";
import type { PlanForMachine } from "./machine-job.js";

/** All controllers, by their `kind`. */
export const CONTROLLERS = { ebb: ebb.description, grbl: grbl.description } as const;
const PLANNERS: ByKind<PlanForMachine> = { ebb: ebb.planJob, grbl: grbl.planJob };

export type ByKind<T> = Readonly<Record<keyof typeof CONTROLLERS, T>>;

/** Throws `bad-setting` for a profile with an unknown controller, as do the functions below. */
export const controllerOf = (machine: MachineProfile): ControllerDescription => ofKind(CONTROLLERS, machine);

/** The function that plans jobs for a machine. */
export const plannerOf = (machine: MachineProfile): PlanForMachine => ofKind(PLANNERS, machine);

type UsbIds = Pick<ControllerDescription, "usbIds" | "candidateIds">;

/** The USB devices of a driver, and those that may be one of its boards. */
export const usbIdsOf = ({ usbIds, candidateIds }: UsbIds): readonly UsbId[] => [...usbIds, ...candidateIds];

/** The same of all drivers. */
export const allUsbIds = (): readonly UsbId[] => Object.values(CONTROLLERS).flatMap(usbIdsOf);

/** `vendorId`, `productId`: hexadecimal; undefined for a device that is not on USB. */
export const hasUsbId = (
  ids: readonly UsbId[],
  vendorId: string | undefined,
  productId: string | undefined,
): boolean =>
  ids.some(
    (id) =>
      id.vendorId === vendorId?.toLowerCase() &&
      (id.productId === undefined || id.productId === productId?.toLowerCase()),
  );

/** @throws PlotwrightError "bad-setting" for the first field of the profile that is missing or invalid */
export function checkMachine(machine: MachineProfile): void {
  checkProfile(machine);
  checkController(machine, controllerOf(machine).fields);
}

/** Whether the machine finds home by itself, with switches. Otherwise home is where the user places the carriage. */
export const findsHome = (machine: MachineProfile): boolean =>
  controllerOf(machine).findsHome?.(machine) ?? false;

/** The firmware version to plan for; null if unknown, or if it is that of another controller. */
export function firmwareFor(machine: MachineProfile, firmware: string | null): string | null {
  return firmware !== null && controllerOf(machine).firmware.isOwn(firmware) ? firmware : null;
}

/** What users of a connected board should know about its firmware, in one sentence; null: nothing, or it is unknown. */
export function firmwareAdvice(
  machine: MachineProfile,
  board: { readonly kind: "serial" | "virtual"; readonly firmware: string | null },
): string | null {
  const own = firmwareFor(machine, board.firmware);
  return board.kind === "virtual" || own === null ? null : controllerOf(machine).firmware.advice(own);
}

/** Whether a plan with these pen settings for one version is also right for the other. */
export function isPlannedAlike(
  machine: MachineProfile,
  pen: PenSettings,
  a: string | null,
  b: string | null,
): boolean {
  const { firmware } = controllerOf(machine);
  return firmware.isPlannedAlike(pen, firmwareFor(machine, a), firmwareFor(machine, b));
}

/** `path`: as in `unusedSettings`. */
export const usesSetting = (machine: MachineProfile, path: string): boolean =>
  !Object.hasOwn(controllerOf(machine).unusedSettings ?? {}, path);

/** Throws `bad-setting` for an unknown controller. */
export function ofKind<T>(table: ByKind<T>, { name, controller }: MachineProfile): T {
  const all: Readonly<Record<string, T>> = table;
  if (Object.hasOwn(all, controller.kind)) return all[controller.kind];
  const known = Object.keys(table).join(", ");
  throw new PlotwrightError(
    "bad-setting",
    `The controller of ${name}, "${controller.kind}", is unknown. Known controllers: ${known}.`,
  );
}
