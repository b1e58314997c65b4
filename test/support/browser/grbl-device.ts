/** Virtual Grbls behind the USB chips of their boards, for the fake serial port of pages. */
import { VirtualGrbl } from "../../../src/drivers/grbl/virtual/virtual-grbl.js";
import type { VirtualGrblOptions } from "../../../src/drivers/grbl/virtual/virtual-settings.js";
import { machineById } from "../../../src/index.js";
import type { MachineId } from "../../../src/internal.js";
import { nodeClock } from "../../../server/serial/node-clock.js";
import type { UsbDevice } from "./fake-serial.js";

/** A CH340 has no serial number. */
const CHIPS = {
  CH340: { vendorId: "1a86", productId: "7523", hasSerialNumber: false },
  CP2102: { vendorId: "10c4", productId: "ea60", hasSerialNumber: true },
} as const satisfies Record<string, Omit<UsbDevice, "machine">>;

export interface GrblOptions extends VirtualGrblOptions {
  readonly chip: keyof typeof CHIPS;
  readonly model: MachineId;
  /** Its seconds per second. */
  readonly speed: number;
}

export interface GrblDevice extends UsbDevice {
  readonly machine: VirtualGrbl;
}

/** Anything else with such a chip, which says nothing. */
export const silentDevice = (): UsbDevice => ({
  ...CHIPS.CH340,
  machine: {
    transport: () => ({
      write: () => Promise.resolve(),
      onData: () => undefined,
      onClose: () => undefined,
      close: () => Promise.resolve(),
    }),
    unplug: () => undefined,
    close: () => undefined,
  },
});

export const grblDevice = ({ chip, model, speed, ...board }: GrblOptions): GrblDevice => ({
  ...CHIPS[chip],
  machine: new VirtualGrbl({ clock: nodeClock, speed, machine: machineById(model) }, board),
});
