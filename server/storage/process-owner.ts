/**
 * Names the process that owns a file, so that a later one can tell whether it still runs. A process id is not enough:
 * ids are reused after a restart, and are always small in a container.
 */
import { readFileSync } from "node:fs";

export interface ProcessOwner {
  readonly pid: number;
  /** Start time: clock ticks since boot plus boot id on Linux; "" where it is not available. */
  readonly began: string;
}

export const thisProcess = (): ProcessOwner => ({ pid: process.pid, began: processBegan(process.pid) });

export function isAlive(owner: ProcessOwner): boolean {
  try {
    process.kill(owner.pid, 0);
  } catch (error) {
    // EPERM: the process is alive and belongs to another user.
    if ((error as NodeJS.ErrnoException).code !== "EPERM") return false;
  }
  return owner.began === "" || owner.began === processBegan(owner.pid);
}

/** Field 22 of /proc/PID/stat. The name in field 2 may contain spaces, so count from its closing bracket. */
function processBegan(pid: number): string {
  try {
    const stat = readFileSync(`/proc/${pid}/stat`, "utf8");
    const ticks = stat.slice(stat.lastIndexOf(")") + 2).split(" ")[19] ?? "";
    return `${ticks}@${readFileSync("/proc/sys/kernel/random/boot_id", "utf8").trim()}`;
  } catch {
    return "";
  }
}
