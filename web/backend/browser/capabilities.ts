/** What this browser lets a page do. A page that was opened by plain http over a network may use very little. */
import { browserText } from "./text.js";

/** Why the page can't use a plotter, and what to do; null where it can. */
export const whyNoPort = (): string | null => {
  if (!window.isSecureContext) return browserText.insecure;
  return (navigator as { serial?: Serial }).serial === undefined ? browserText.noSerial : null;
};

/** Whether one tab can know of the others. The Web Locks that this takes are missing on an insecure page. */
export const hasLocks = (): boolean => (navigator as { locks?: LockManager }).locks !== undefined;

/** Browsers offer `crypto.randomUUID` on secure pages only. Without it the virtual plotter would not work either. */
export const provideRandomIds = (): void => {
  const { crypto } = globalThis as {
    crypto: { randomUUID?: () => string } & Pick<Crypto, "getRandomValues">;
  };
  crypto.randomUUID ??= () => {
    const bytes = crypto.getRandomValues(new Uint8Array(16));
    // Version 4, variant 1 (RFC 9562).
    bytes[6] = (bytes[6] & 0x0f) | 0x40;
    bytes[8] = (bytes[8] & 0x3f) | 0x80;
    const hex = Array.from(bytes, (byte) => byte.toString(16).padStart(2, "0")).join("");
    return hex.replace(/^(.{8})(.{4})(.{4})(.{4})/, "$1-$2-$3-$4-");
  };
};
