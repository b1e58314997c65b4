import { usbIds, type UsbId } from "../../src/internal.js";
import type { FoundBoard } from "../../host/plotter/devices.js";

export type { FoundBoard } from "../../host/plotter/devices.js";

/** All boards on USB with these ids, sorted by path; default: those that some driver knows. */
export async function findBoards(ids: readonly UsbId[] = usbIds()): Promise<readonly FoundBoard[]> {
  const { SerialPort } = await import("serialport");
  const ports = await SerialPort.list();
  return ports
    .filter((port) =>
      ids.some(
        ({ vendorId, productId }) =>
          port.vendorId?.toLowerCase() === vendorId && port.productId?.toLowerCase() === productId,
      ),
    )
    .map((port) => ({
      path: port.path,
      description: port.manufacturer ?? "EiBotBoard",
      serialNumber: port.serialNumber ?? null,
    }))
    .sort((a, b) => (a.path < b.path ? -1 : 1));
}
