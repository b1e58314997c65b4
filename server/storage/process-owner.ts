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
  if (statOf(owner.pid)[STATE] === ENDED) return false;
  return owner.began === "" || owner.began === processBegan(owner.pid);
}

/** Indexes into `statOf`. */
const STATE = 0;
const START_TICKS = 19;
/** The state of a process that has ended, while its parent has not asked for its result: it still has its id. */
const ENDED = "Z";

function processBegan(pid: number): string {
  try {
    const ticks = statOf(pid)[START_TICKS];
    if (ticks === undefined) return "";
    return `${ticks}@${readFileSync("/proc/sys/kernel/random/boot_id", "utf8").trim()}`;
  } catch {
    return "";
  }
}

/** /proc/PID/stat from its third field on; empty where it is not available. The second is a name and may contain spaces. */
function statOf(pid: number): readonly string[] {
  try {
    const stat = readFileSync(`/proc/${pid}/stat`, "utf8");
    return stat.slice(stat.lastIndexOf(")") + 2).split(" ");
  } catch {
    return [];
  }
}
