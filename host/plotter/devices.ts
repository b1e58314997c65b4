/** The serial ports of this computer, as the host uses them. */
import type { Transport } from "../../src/index.js";
import type { UsbId } from "../../src/internal.js";

/** A board on a serial port of this computer, or a device that may be one. */
export interface FoundBoard {
  /** The name by which `open` opens it; on the server the path to pass to `--device`. */
  readonly path: string;
  /** Manufacturer, to show to users. */
  readonly description: string;
  readonly serialNumber: string | null;
}

/** The serial ports of this computer. The server opens them with serialport, the page with Web Serial. */
export interface Devices {
  /** All devices on USB with these ids, sorted by path. */
  find(ids: readonly UsbId[]): Promise<readonly FoundBoard[]>;
  /** Opens and locks a port. Rejects with `no-board`, `not-allowed` or `busy`. */
  open(path: string): Promise<Transport>;
}
