/**
 * The serial ports that the user has allowed this page to use. A worker can open them, but only a page can ask for more.
 */
import { PlotwrightError } from "../../../src/index.js";
import { allUsbIds, hasUsbId, type UsbId } from "../../../src/internal.js";
import type { Devices, FoundBoard } from "../../../host/plotter/devices.js";
import { openWebSerial } from "../../serial/web-serial.js";

const hex = (id: number | undefined): string | undefined => id?.toString(16).padStart(4, "0");

export function serialDevices(
  serial: Serial | undefined,
): Devices & { readonly findAll: () => Promise<readonly FoundBoard[]> } {
  /** Ports have no names, so they are numbered in the order in which they are found. */
  const names = new Map<SerialPort, string>();
  const ports = async (): Promise<SerialPort[]> => {
    const found = (await serial?.getPorts()) ?? [];
    for (const port of found) if (!names.has(port)) names.set(port, `usb-${names.size + 1}`);
    return found;
  };
  const find = async (ids: readonly UsbId[]): Promise<FoundBoard[]> => {
    const boards = (await ports()).filter((port) => {
      const { usbVendorId, usbProductId } = port.getInfo();
      return hasUsbId(ids, hex(usbVendorId), hex(usbProductId));
    });
    return boards.map((port) => ({
      path: names.get(port) ?? "",
      description: "USB device",
      serialNumber: null,
    }));
  };
  return {
    find,
    findAll: () => find(allUsbIds()),
    open: async (path) => {
      const port = (await ports()).find((candidate) => names.get(candidate) === path);
      if (port === undefined) {
        throw new PlotwrightError(
          "no-board",
          "The plotter is no longer plugged in, or this page may not use it: plug it in, then press “Connect a plotter…”.",
        );
      }
      return openWebSerial(port);
    },
  };
}
