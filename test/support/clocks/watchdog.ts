/** Ends work that hangs, and measures its processor time: load on the machine makes neither fail. */
import { Worker } from "node:worker_threads";

/** Stops what the main thread runs when the time that it was told is over. Null: it is over in time. */
const WATCHDOG = `
  const { Session } = require("node:inspector");
  const { parentPort } = require("node:worker_threads");
  const session = new Session();
  session.connectToMainThread();
  let timer;
  parentPort.on("message", (limitMs) => {
    clearTimeout(timer);
    if (limitMs === null) return;
    timer = setTimeout(() => {
      session.post("Runtime.terminateExecution");
      parentPort.postMessage("over");
    }, limitMs);
  });`;

const watchdog = new Worker(WATCHDOG, { eval: true, execArgv: [] });
watchdog.unref();

/** Rejects if the work is not over in time, endless loops included. */
export async function endWhenOver<T>(limitMs: number, work: () => T | Promise<T>): Promise<T> {
  watchdog.postMessage(limitMs);
  const over = new Promise<never>((_, reject) => {
    watchdog.once("message", () => reject(new Error(`not over in ${limitMs} ms`)));
  });
  try {
    // In a job of its own: all that waits for it goes on when it is stopped.
    return await Promise.race([Promise.resolve().then(work), over]);
  } finally {
    watchdog.postMessage(null);
    watchdog.removeAllListeners("message");
  }
}

/** Seconds of processor time since `mark`, all threads of this process together. */
export const cpuS = (mark: NodeJS.CpuUsage): number => {
  const { user, system } = process.cpuUsage(mark);
  return (user + system) / 1e6;
};
