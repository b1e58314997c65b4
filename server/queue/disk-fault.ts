/** A disk that takes no more: what the user is told, and which errors mean it. */

export const DISK_FULL =
  "The server's disk is full or can't be written to. Make room: what has happened is kept in memory and stored then.";

/** SQLite says "disk I/O error" too when a write finds no room. */
export function isDiskFault(error: unknown): boolean {
  if (!(error instanceof Error)) return false;
  const { code } = error as NodeJS.ErrnoException;
  return (
    ["ENOSPC", "EDQUOT", "EROFS", "EIO"].includes(code ?? "") ||
    /database or disk is full|disk I\/O error/.test(error.message)
  );
}
