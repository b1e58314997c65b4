/** Recognizes the errors of a full or unwritable disk, and defines the message for the user. */

export const DISK_FULL =
  "The server's disk is full or can't be written to. Make room on it: until then the changes are only in memory. They are stored as soon as there is room.";

/**
 * SQLite also reports "disk I/O error" when a write finds no space, and the last two when it can't make or write a file.
 */
export function isDiskFault(error: unknown): boolean {
  if (!(error instanceof Error)) return false;
  const { code } = error as Error & { readonly code?: string };
  return (
    ["ENOSPC", "EDQUOT", "EROFS", "EIO"].includes(code ?? "") ||
    /disk is full|disk I\/O error|unable to open database file|readonly database/.test(error.message)
  );
}
