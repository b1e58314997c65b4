import { SerialPort } from "serialport";

/** USB ids of every EiBotBoard (Microchip's vendor id, with a sublicensed product id). */
const EBB_VENDOR = "04d8";
const EBB_PRODUCT = "fd92";

export interface FoundBoard {
  /** The path to pass to `--device`. */
  readonly path: string;
  /** Manufacturer, to show to users. */
  readonly description: string;
  readonly serialNumber: string | null;
}

/** All EiBotBoards on USB, sorted by path. */
export async function findBoards(): Promise<readonly FoundBoard[]> {
  const ports = await SerialPort.list();
  return ports
    .filter(
      (port) => port.vendorId?.toLowerCase() === EBB_VENDOR && port.productId?.toLowerCase() === EBB_PRODUCT,
    )
    .map((port) => ({
      path: port.path,
      description: port.manufacturer ?? "EiBotBoard",
      serialNumber: port.serialNumber ?? null,
    }))
    .sort((a, b) => (a.path < b.path ? -1 : 1));
}
