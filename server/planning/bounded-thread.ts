/**
 * A worker thread with limits: it is terminated when it takes too long or needs too much memory. Work on an
 * untrusted file may never end without this.
 */
import { Worker, type WorkerOptions } from "node:worker_threads";
import { PlotwrightError } from "../../src/index.js";
import { createHash, randomBytes } from "node:crypto";
import { existsSync, mkdirSync, renameSync, writeFileSync } from "node:fs";
import { createRequire } from "node:module";
import { dirname, join } from "node:path";
import { fileURLToPath, pathToFileURL } from "node:url";

const MEMORY_CHECK_MS = 200;

export interface TimeLimit {
  readonly s: number;
  /** The error when the time has passed. */
  readonly error: PlotwrightError;
}

interface ThreadStart {
  /** Name of the worker's file, which is in the folder of the starting module. */
  readonly name: string;
  readonly starterUrl: string;
  readonly workerData: unknown;
  /** Limit of the JavaScript heap. */
  readonly heapMb: number;
  /** How much the whole process may grow while the thread works. */
  readonly growthMb: number;
}

interface ThreadListener<Message> {
  message(message: Message): void;
  /** Called once, at the end; no message follows. */
  ended(reason: Error): void;
}

export class BoundedThread<Message> {
  private readonly worker: Worker;
  private readonly memoryTimer: NodeJS.Timeout;
  private timer: NodeJS.Timeout | undefined;
  private isEnded = false;

  constructor(
    { name, starterUrl, workerData, heapMb, growthMb }: ThreadStart,
    private readonly listener: ThreadListener<Message>,
  ) {
    this.worker = startWorker(name, starterUrl, {
      workerData,
      resourceLimits: { maxOldGenerationSizeMb: heapMb },
      // A library may print warnings about a damaged file; they must not mix with the output of a command.
      stdout: true,
    });
    this.worker.stdout.resume();
    const maxBytes = process.memoryUsage.rss() + growthMb * 1e6;
    this.memoryTimer = setInterval(() => {
      if (process.memoryUsage.rss() > maxBytes) void this.stop(tooLarge());
    }, MEMORY_CHECK_MS);
    this.worker.on("message", (message: Message) => {
      if (!this.isEnded) listener.message(message);
    });
    this.worker.on("error", (error) => this.end(endOf(error)));
    this.worker.on("exit", () => this.end(new PlotwrightError("internal", "The planning thread ended.")));
  }

  post(message: unknown): void {
    this.worker.postMessage(message);
  }

  /**
   * Sets the time limit for the work from now on, in place of the last limit; null while the thread is idle.
   */
  allow(limit: TimeLimit | null): void {
    clearTimeout(this.timer);
    if (limit !== null && !this.isEnded) {
      this.timer = setTimeout(() => void this.stop(limit.error), limit.s * 1_000);
    }
  }

  async stop(reason: Error): Promise<void> {
    this.end(reason);
    await this.worker.terminate();
  }

  private end(reason: Error): void {
    if (this.isEnded) return;
    this.isEnded = true;
    clearTimeout(this.timer);
    clearInterval(this.memoryTimer);
    this.listener.ended(reason);
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
    "Planning this drawing needs more memory than is available. Simplify it, or plot it in parts.",
    { cause },
  );

/**
 * Starts the worker thread whose file is in the folder of the starting module, built (.js) or as source (.ts).
 * The build puts the files of worker threads beside its chunks (scripts/bundle.mjs). A source file is bundled first with
 * all its packages, once per process: if every thread compiled and resolved hundreds of modules itself, it would take
 * seconds to start. The bundle is stored below node_modules.
 */
function startWorker(name: string, starterUrl: string, options: WorkerOptions): Worker {
  const entry = starterUrl.endsWith(".ts") ? bundleOf(name, starterUrl) : new URL(`./${name}.js`, starterUrl);
  return new Worker(entry, { ...options, execArgv: [] });
}

const bundles = new Map<string, URL>();

function bundleOf(name: string, starterUrl: string): URL {
  const known = bundles.get(name);
  if (known !== undefined) return known;
  const require = createRequire(starterUrl);
  const { buildSync } = require("esbuild") as typeof import("esbuild");
  const { outputFiles } = buildSync({
    entryPoints: [fileURLToPath(new URL(`./${name}.ts`, starterUrl))],
    bundle: true,
    platform: "node",
    format: "esm",
    // For packages in CommonJS, which require Node's own modules.
    banner: {
      js: `import { createRequire as requireFor } from "node:module"; const require = requireFor(import.meta.url);`,
    },
    target: "node20",
    write: false,
  });
  const { contents } = outputFiles[0];
  const folder = join(dirname(require.resolve("esbuild/package.json")), "..", ".cache", "plotwright");
  const path = join(
    folder,
    `${name}-${createHash("sha256").update(contents).digest("hex").slice(0, 16)}.mjs`,
  );
  if (!existsSync(path)) {
    // Written under another name and renamed, since other processes may write the same bundle.
    mkdirSync(folder, { recursive: true });
    const draft = `${path}.${randomBytes(4).toString("hex")}`;
    writeFileSync(draft, contents);
    renameSync(draft, path);
  }
  const url = pathToFileURL(path);
  bundles.set(name, url);
  return url;
}
