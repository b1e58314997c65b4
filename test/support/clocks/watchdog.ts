/** Ends work that hangs, and measures its processor time: load on the machine makes neither fail. */
import { runInThisContext } from "node:vm";

const scope = globalThis as { watchedWork?: (() => unknown) | undefined };

/**
 * Runs synchronous work; throws (ERR_SCRIPT_EXECUTION_TIMEOUT) if it is not over in time, endless loops
 * included.
 */
export function endWhenOver<T>(limitMs: number, work: () => T): T {
  scope.watchedWork = work;
  try {
    return runInThisContext("watchedWork()", { timeout: limitMs }) as T;
  } finally {
    scope.watchedWork = undefined;
  }
}

/** Seconds of processor time since `mark`, all threads of this process together. */
export const cpuS = (mark: NodeJS.CpuUsage): number => {
  const { user, system } = process.cpuUsage(mark);
  return (user + system) / 1e6;
};
