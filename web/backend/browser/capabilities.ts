/** What this browser allows the page to do. It allows less on an insecure page (plain http from another computer). */
import { browserText } from "./text.js";

/** Why the page can't use a plotter, and what to do; null if it can. */
export const whyNoPort = (): string | null => {
  if (!window.isSecureContext) return browserText.insecure;
  return (navigator as { serial?: Serial }).serial === undefined ? browserText.noSerial : null;
};

/** Whether the tabs can agree on one host. They do so with Web Locks, which an insecure page does not have. */
export const hasLocks = (): boolean => (navigator as { locks?: LockManager }).locks !== undefined;

/** Adds `crypto.randomUUID` on insecure pages, where browsers do not have it. Even the virtual plotter needs it. */
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
