/** The serial ports of this computer. The server opens them with serialport, the page with Web Serial. */
import type { Transport } from "../../src/index.js";
import type { UsbId } from "../../src/internal.js";

export interface FoundBoard {
  /** The name by which `open` opens it; on the server the path to pass to `--device`. */
  readonly path: string;
  /** Manufacturer, to show to users. */
  readonly description: string;
  readonly serialNumber: string | null;
}

export interface Devices {
  /** All boards on USB with these ids, sorted by path. */
  find(ids: readonly UsbId[]): Promise<readonly FoundBoard[]>;
  /** Opens and locks a port. Rejects with `no-board`, `not-allowed` or `busy`. */
  open(path: string): Promise<Transport>;
}
