import { allUsbIds, hasUsbId, type UsbId } from "../../src/internal.js";
import type { FoundBoard } from "../../host/plotter/devices.js";
import { readdirSync, readFileSync, realpathSync } from "node:fs";
import path from "node:path";

export type { FoundBoard } from "../../host/plotter/devices.js";

/** All devices on USB with these ids, sorted by path; default: those that may be a plotter. */
export async function findBoards(ids: readonly UsbId[] = allUsbIds()): Promise<readonly FoundBoard[]> {
  const ports = await serialPorts();
  return ports
    .filter((port) => hasUsbId(ids, port.vendorId, port.productId))
    .map((port) => ({
      path: port.path,
      description: port.manufacturer ?? "USB device",
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

/** A serial port, with what its USB device says of itself; undefined if it says nothing. */
export interface UsbPort {
  readonly path: string;
  readonly vendorId?: string | undefined;
  readonly productId?: string | undefined;
  readonly manufacturer?: string | undefined;
  readonly serialNumber?: string | undefined;
}

/**
 * The modems (ttyACM*) and serial adapters (ttyUSB*) under `root`. Each one's `device` is a link to an interface of the USB
 * device, for an adapter to a port of the interface. The folder above the interface has the ids and names of the device.
 */
export function sysfsPorts(root = "/sys/class/tty"): readonly UsbPort[] {
  return folderNames(root).flatMap((name) => {
    const up = { ttyACM: "..", ttyUSB: "../.." }[name.slice(0, 6)];
    if (up === undefined) return [];
    const read = (file: string): string | undefined => textOf(path.join(root, name, "device"), up, file);
    return [
      {
        path: `/dev/${name}`,
        vendorId: read("idVendor"),
        productId: read("idProduct"),
        manufacturer: read("manufacturer"),
        serialNumber: read("serial"),
      },
    ];
  });
}

function folderNames(folder: string): readonly string[] {
  try {
    return readdirSync(folder);
  } catch {
    return [];
  }
}

/** Undefined if the device has no such file, or was unplugged meanwhile. */
function textOf(device: string, up: string, file: string): string | undefined {
  try {
    return readFileSync(path.join(realpathSync(device), up, file), "utf8").trim();
  } catch {
    return undefined;
  }
}
