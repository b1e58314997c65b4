/**
 * Starts the worker thread whose file is in the folder of the starting module, built (.js) or as source (.ts).
 * The build puts the files of worker threads beside its chunks (scripts/bundle.mjs). A source file is bundled first with all its packages, once per process: if every thread compiled and
 * resolved hundreds of modules itself, it would take seconds to start. The bundle is stored below node_modules.
 */
import { createHash, randomBytes } from "node:crypto";
import { existsSync, mkdirSync, renameSync, writeFileSync } from "node:fs";
import { createRequire } from "node:module";
import { dirname, join } from "node:path";
import { fileURLToPath, pathToFileURL } from "node:url";
import { Worker, type WorkerOptions } from "node:worker_threads";

export function startWorker(name: string, starterUrl: string, options: WorkerOptions): Worker {
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
