import type { ChildProcess } from "node:child_process";

/** Longer than a busy computer needs to start a process. */
const WITHIN_MS = 120_000;

/** The child's next message that `isWanted` accepts. Rejects if the child ends first, and after two minutes. */
export function nextMessage<T>(
  child: ChildProcess,
  isWanted: (message: T) => boolean = () => true,
): Promise<T> {
  return new Promise((resolve, reject) => {
    const stop = (): void => {
      clearTimeout(timer);
      child.off("message", onMessage);
      child.off("exit", onExit);
    };
    const fail = (why: string): void => {
      stop();
      reject(new Error(`the child process ${why}: ${child.spawnargs.join(" ")}`));
    };
    const onMessage = (message: T): void => {
      if (!isWanted(message)) return;
      stop();
      resolve(message);
    };
    const onExit = (): void => fail("ended before it sent the message");
    const timer = setTimeout(() => fail("sent no such message in two minutes"), WITHIN_MS);
    child.on("message", onMessage);
    child.once("exit", onExit);
    if (hasEnded(child)) onExit();
  });
}

export const hasEnded = ({ exitCode, signalCode }: ChildProcess): boolean =>
  exitCode !== null || signalCode !== null;
