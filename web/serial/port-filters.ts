/** What the browser's dialog of ports lists: devices that may be a plotter. */
import { allUsbIds } from "../../src/internal.js";

/** Without a product: all of that vendor. */
interface PortFilter {
  readonly usbVendorId: number;
  readonly usbProductId?: number;
}

export const portFilters = (): PortFilter[] =>
  allUsbIds().map(({ vendorId, productId }) => ({
    usbVendorId: Number.parseInt(vendorId, 16),
    ...(productId === undefined ? {} : { usbProductId: Number.parseInt(productId, 16) }),
  }));
