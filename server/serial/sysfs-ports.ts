/** The USB serial ports that Linux itself knows, for systems without udev, such as containers. */
import { readdirSync, readFileSync, realpathSync } from "node:fs";
import path from "node:path";

export interface SysfsPort {
  readonly path: string;
  readonly vendorId: string;
  readonly productId: string;
  readonly manufacturer: string | undefined;
  readonly serialNumber: string | undefined;
}

/**
 * The USB modems (ttyACM*) under `root`. Each one's `device` is a link to an interface of the USB device, and the folder
 * above it has the ids and names of the device.
 */
export function sysfsPorts(root = "/sys/class/tty"): readonly SysfsPort[] {
  return folderNames(root).flatMap((name) => {
    if (!name.startsWith("ttyACM")) return [];
    const read = (file: string): string | undefined => textOf(path.join(root, name, "device"), file);
    const [vendorId, productId] = [read("idVendor"), read("idProduct")];
    if (vendorId === undefined || productId === undefined) return [];
    const [manufacturer, serialNumber] = [read("manufacturer"), read("serial")];
    return [{ path: `/dev/${name}`, vendorId, productId, manufacturer, serialNumber }];
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
