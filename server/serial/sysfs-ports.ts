/** The USB serial ports that Linux itself knows, for systems without udev, such as containers. */
import { readdirSync, readFileSync, realpathSync } from "node:fs";
import path from "node:path";

/** A serial port, with what its USB device says of itself; undefined if it says nothing. */
export interface UsbPort {
  readonly path: string;
  readonly vendorId?: string | undefined;
  readonly productId?: string | undefined;
  readonly manufacturer?: string | undefined;
  readonly serialNumber?: string | undefined;
}

/**
 * The modems (ttyACM*) under `root`. Each one's `device` is a link to an interface of the USB device, and the folder
 * above it has the ids and names of the device.
 */
export function sysfsPorts(root = "/sys/class/tty"): readonly UsbPort[] {
  return folderNames(root).flatMap((name) => {
    if (!name.startsWith("ttyACM")) return [];
    const read = (file: string): string | undefined => textOf(path.join(root, name, "device"), file);
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
function textOf(device: string, file: string): string | undefined {
  try {
    return readFileSync(path.join(realpathSync(device), "..", file), "utf8").trim();
  } catch {
    return undefined;
  }
}
