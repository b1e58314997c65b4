/** Scripts for child processes: each is one JavaScript file with all of the project's modules that it imports. */
import { mkdirSync, renameSync } from "node:fs";
import path from "node:path";
import { buildSync } from "esbuild";
import { ROOT } from "../../scripts/setup.mjs";

/** Below node_modules, so that the scripts can import packages. */
const FOLDER = path.join(ROOT, "node_modules", ".cache", "plotwright-tests");
const built = new Set<string>();

/**
 * The file to run for `name`.ts in test/support, or in `folder`. It starts in a third of the processor time that it takes to compile and
 * load the modules one by one.
 */
export function childScript(name: string, folder = path.join(ROOT, "test", "support")): string {
  const file = path.join(FOLDER, `${name}.mjs`);
  if (built.has(file)) return file;
  mkdirSync(FOLDER, { recursive: true });
  // Written under another name and renamed, since other test processes write the same file.
  const draft = `${file}.${process.pid}`;
  buildSync({
    entryPoints: [path.join(folder, `${name}.ts`)],
    outfile: draft,
    bundle: true,
    packages: "external",
    platform: "node",
    format: "esm",
    target: "node20",
  });
  renameSync(draft, file);
  built.add(file);
  return file;
}
