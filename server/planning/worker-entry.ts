/**
 * Starts the worker thread whose file stands beside its starter: compiled (.js), or the source (.ts).
 * Sources need tsx in the thread, where Node 20 does not let `--import tsx` take hold: the thread begins
 * with a line that registers it.
 */
import { createRequire } from "node:module";
import { pathToFileURL } from "node:url";
import { Worker, type WorkerOptions } from "node:worker_threads";

export function startWorker(name: string, starterUrl: string, options: WorkerOptions): Worker {
  const own = { ...options, execArgv: [] };
  if (!starterUrl.endsWith(".ts")) return new Worker(new URL(`./${name}.js`, starterUrl), own);
  const tsx = new URL(
    "./dist/esm/api/index.mjs",
    pathToFileURL(createRequire(starterUrl).resolve("tsx/package.json")),
  );
  const entry = new URL(`./${name}.ts`, starterUrl).href;
  const begin = `import(${JSON.stringify(tsx.href)}).then(({ register }) => { register(); return import(${JSON.stringify(entry)}); })`;
  return new Worker(begin, { ...own, eval: true });
}
