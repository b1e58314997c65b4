import { browserText } from "./text.js";

/** Why the browser's storage failed, in words for the user. */
export const storageReason = (error: unknown): string => {
  if (error instanceof DOMException && error.name === "QuotaExceededError") return browserText.full;
  if (error instanceof DOMException && error.name === "InvalidStateError") return browserText.closedStorage;
  return browserText.storageSays(error instanceof Error ? error.message : String(error));
};
