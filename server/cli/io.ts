/** What a command needs of its process, given in so that tests can run commands without one. */
import { isatty } from "node:tty";

export interface CliIo {
  /** Results: one call for each piece of text. */
  out(text: string): void;
  /** Messages and progress. */
  err(text: string): void;
  /** The user sees a terminal: a progress bar makes sense. */
  readonly isTerminal: boolean;
  /** There is somebody who can type: a question makes sense. */
  readonly hasKeyboard: boolean;
  /**
   * Called at each Ctrl-C; and once (`isFinal`) at SIGTERM, when the terminal is closed (SIGHUP), or when the program
   * that started this one has ended. The returned function stops listening.
   */
  onInterrupt(listener: (isFinal: boolean) => void): () => void;
  /** The process has no longer than that: what still keeps it alive then is named, and it ends all the same. */
  endWithin(ms: number): void;
  /** Called at each line typed while listening; the returned function stops it. */
  onLine(listener: (line: string) => void): () => void;
}

/** "disconnect": the parent that opened a channel to us, as `npm start` does, is gone. */
const ENDS = ["SIGTERM", "SIGHUP", "disconnect"] as const;

export function processIo(): CliIo {
  // Whoever reads us may have enough ("| head"), close the terminal, or fill the disk: a plot goes on without them.
  for (const stream of [process.stdout, process.stderr]) stream.on("error", () => undefined);
  return {
    out: (text) => void process.stdout.write(text),
    err: (text) => void process.stderr.write(text),
    isTerminal: process.stderr.isTTY,
    // Not process.stdin.isTTY: to open stdin as a stream makes a pipe answer "nothing yet" to whoever reads it whole.
    hasKeyboard: isatty(0),
    onInterrupt: (listener) => {
      const soft = (): void => listener(false);
      const final = (): void => listener(true);
      process.on("SIGINT", soft);
      for (const end of ENDS) process.on(end, final);
      // Listening for the end of the parent must not keep us alive.
      process.channel?.unref();
      return () => {
        process.off("SIGINT", soft);
        for (const end of ENDS) process.off(end, final);
      };
    },
    endWithin: (ms) => {
      const end = (): never => {
        const open = [...new Set(process.getActiveResourcesInfo())].join(", ");
        process.stderr.write(`plotwright: something was still open after ${ms / 1000} s: ${open}\n`);
        process.exit();
      };
      setTimeout(end, ms).unref();
    },
    onLine: (listener) => {
      if (!isatty(0)) return () => undefined;
      const take = (data: Buffer): void => listener(data.toString("utf8").trim());
      process.stdin.on("data", take);
      return () => {
        process.stdin.off("data", take);
        process.stdin.pause();
      };
    },
  };
}
