/**
 * The drivers, which only code that connects to a machine loads; Grbl's only for a Grbl machine. They are not in
 * `registry.ts`, because a bundler splits all code that such an import and a plan share.
 */
import type { MachineProfile } from "../machines/profile.js";
import type { Driver, UsbId } from "./driver.js";
import { driver as ebb } from "./ebb/driver.js";
import { CONTROLLERS, ofKind, usbIdsOf, type ByKind } from "./registry.js";

const DRIVERS: ByKind<() => Promise<Driver>> = {
  ebb: () => Promise.resolve(ebb),
  grbl: async () => (await import("./grbl/driver.js")).driver,
};

/** The driver that connects to a machine. Rejects with `bad-setting` for an unknown controller. */
export const driverOf = async (machine: MachineProfile): Promise<Driver> => ofKind(DRIVERS, machine)();

/** A driver, its controller's `kind`, and the USB devices that may be its boards. */
export interface KnownDriver {
  readonly kind: string;
  readonly driver: Driver;
  readonly ids: readonly UsbId[];
}

export const allDrivers = (): Promise<readonly KnownDriver[]> =>
  Promise.all(
    (Object.keys(DRIVERS) as (keyof typeof DRIVERS)[]).map(async (kind) => ({
      kind,
      driver: await DRIVERS[kind](),
      ids: usbIdsOf(CONTROLLERS[kind]),
    })),
  );
