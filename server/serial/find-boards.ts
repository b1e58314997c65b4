import { usbIds, type UsbId } from "../../src/internal.js";
import type { FoundBoard } from "../../host/plotter/devices.js";
import { sysfsPorts, type UsbPort } from "./sysfs-ports.js";

export type { FoundBoard } from "../../host/plotter/devices.js";

/** All boards on USB with these ids, sorted by path; default: those that some driver knows. */
export async function findBoards(ids: readonly UsbId[] = usbIds()): Promise<readonly FoundBoard[]> {
  const ports = await serialPorts();
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

async function serialPorts(): Promise<readonly UsbPort[]> {
  const { SerialPort } = await import("serialport");
  return SerialPort.list().catch((error: unknown) => {
    // On Linux serialport runs udevadm, which not every system has.
    if (process.platform === "linux" && isMissingProgram(error)) return sysfsPorts();
    throw error;
  });
}

const isMissingProgram = (error: unknown): boolean =>
  error instanceof Error && "code" in error && error.code === "ENOENT";
