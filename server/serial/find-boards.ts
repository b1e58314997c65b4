import { SerialPort } from "serialport";

/** USB identity of every EiBotBoard (Microchip's vendor number, sub-licensed product number). */
const EBB_VENDOR = "04d8";
const EBB_PRODUCT = "fd92";

export interface FoundBoard {
  /** What to give to `--device`. */
  readonly path: string;
  /** Maker and name, for people. */
  readonly description: string;
  readonly serialNumber: string | null;
}

/** All EiBotBoards that the system sees on USB, by path. */
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
