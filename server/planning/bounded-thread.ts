/**
 * A worker thread whose work has limits: one that takes too long, or more memory than it may have, is ended, and its
 * starter told. Work on a file from outside can't be trusted to come to an end.
 */
import type { Worker } from "node:worker_threads";
import { PlotwrightError } from "../../src/index.js";
import { startWorker } from "./worker-entry.js";

const LOOK_EACH_MS = 200;

export interface TimeLimit {
  readonly s: number;
  /** What to say when it has passed. */
  readonly error: PlotwrightError;
}

export interface ThreadStart {
  /** Of its file, which stands beside its starter. */
  readonly name: string;
  readonly starterUrl: string;
  readonly workerData: unknown;
  /** JavaScript heap that it may have. */
  readonly heapMb: number;
  /** By which the process may grow while it works. */
  readonly growthMb: number;
}

export interface ThreadListener<Message> {
  message(message: Message): void;
  /** Once: nothing comes any more. */
  ended(reason: Error): void;
}

export class BoundedThread<Message> {
  readonly #worker: Worker;
  readonly #listener: ThreadListener<Message>;
  readonly #memoryTimer: NodeJS.Timeout;
  #timer: NodeJS.Timeout | undefined;
  #isEnded = false;

  constructor(
    { name, starterUrl, workerData, heapMb, growthMb }: ThreadStart,
    listener: ThreadListener<Message>,
  ) {
    this.#listener = listener;
    this.#worker = startWorker(name, starterUrl, {
      workerData,
      resourceLimits: { maxOldGenerationSizeMb: heapMb },
      // What a library prints about a damaged file must not get between a command's results.
      stdout: true,
    });
    this.#worker.stdout.resume();
    const mostBytes = process.memoryUsage.rss() + growthMb * 1e6;
    this.#memoryTimer = setInterval(() => {
      if (process.memoryUsage.rss() > mostBytes) void this.stop(tooLarge());
    }, LOOK_EACH_MS);
    this.#worker.on("message", (message: Message) => {
      if (!this.#isEnded) listener.message(message);
    });
    this.#worker.on("error", (error) => this.#end(endOf(error)));
    this.#worker.on("exit", () => this.#end(new PlotwrightError("internal", "The planning thread ended.")));
  }

  post(message: unknown): void {
    this.#worker.postMessage(message);
  }

  /** What is done from now on may take that long; null: nothing is being done. Replaces the limit before. */
  allow(limit: TimeLimit | null): void {
    clearTimeout(this.#timer);
    if (limit !== null && !this.#isEnded) {
      this.#timer = setTimeout(() => void this.stop(limit.error), limit.s * 1_000);
    }
  }

  async stop(reason: Error): Promise<void> {
    this.#end(reason);
    await this.#worker.terminate();
  }

  #end(reason: Error): void {
    if (this.#isEnded) return;
    this.#isEnded = true;
    clearTimeout(this.#timer);
    clearInterval(this.#memoryTimer);
    this.#listener.ended(reason);
  }
}

function endOf(error: Error): PlotwrightError {
  if ((error as NodeJS.ErrnoException).code === "ERR_WORKER_OUT_OF_MEMORY") {
    return tooLarge(error);
  }
  return new PlotwrightError("internal", `The planning thread failed: ${error.message}`, { cause: error });
}

const tooLarge = (cause?: Error): PlotwrightError =>
  new PlotwrightError(
    "too-large",
    "The drawing needs more memory than there is for planning. Simplify it, or plot it in parts.",
    { cause },
  );
