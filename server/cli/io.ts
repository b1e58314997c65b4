/** What a command needs of its process, given in so that tests can run commands without one. */
export interface CliIo {
  /** Results: one call for each piece of text. */
  out(text: string): void;
  /** Messages and progress. */
  err(text: string): void;
  /** The user sees a terminal: a progress bar makes sense. */
  readonly isTerminal: boolean;
  /** Called at each Ctrl-C (or SIGTERM: `isFinal`); the returned function stops listening. */
  onInterrupt(listener: (isFinal: boolean) => void): () => void;
  /** Nothing is left to do: what keeps the process alive for longer is named, and it ends all the same. */
  endWithin(ms: number): void;
  /** Called at each line typed while listening; the returned function stops it. */
  onLine(listener: (line: string) => void): () => void;
}

export function processIo(): CliIo {
  // Whoever reads us through a pipe may have enough ("| head"): no reason to fail aloud.
  process.stdout.on("error", (error: NodeJS.ErrnoException) => {
    if (error.code === "EPIPE") process.exit();
    throw error;
  });
  return {
    out: (text) => void process.stdout.write(text),
    err: (text) => void process.stderr.write(text),
    isTerminal: process.stderr.isTTY,
    onInterrupt: (listener) => {
      const soft = (): void => listener(false);
      const final = (): void => listener(true);
      process.on("SIGINT", soft);
      process.on("SIGTERM", final);
      return () => {
        process.off("SIGINT", soft);
        process.off("SIGTERM", final);
      };
    },
    endWithin: (ms) => {
      const end = (): never => {
        const open = [...new Set(process.getActiveResourcesInfo())].join(", ");
        process.stderr.write(`plotwright: something was still open ${ms / 1000} s after the end: ${open}\n`);
        process.exit();
      };
      setTimeout(end, ms).unref();
    },
    onLine: (listener) => {
      if (!process.stdin.isTTY) return () => undefined;
      const take = (data: Buffer): void => listener(data.toString("utf8").trim());
      process.stdin.on("data", take);
      return () => {
        process.stdin.off("data", take);
        process.stdin.pause();
      };
    },
  };
}
