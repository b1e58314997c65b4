/**
 * Bundles the library, the server and the entry for Web Serial: one file per entry, and chunks for the code that they
 * share or load on demand. Node then opens 75 files to start the server instead of 300. All entries are built
 * together, so there is only one PlotwrightError class. tsc writes the types to the same folders.
 */
import { build } from "esbuild";
import { readFileSync, rmSync, writeFileSync } from "node:fs";
import path from "node:path";
import { licencesOf } from "./licences.mjs";
import { NEVER_CALLED, emptied } from "./never-called.mjs";
import { ROOT } from "./setup.mjs";

const CHUNKS = path.join(ROOT, "dist", "chunks");

const { dependencies, optionalDependencies, peerDependencies } = JSON.parse(
  readFileSync(path.join(ROOT, "package.json"), "utf8"),
);
/**
 * What users of the package install. Packages of many small files, of which few are used, are development dependencies
 * and become part of the bundle: loading them one by one takes 70 ms. They must run in browsers too, and as ES modules.
 */
const external = Object.keys({ ...dependencies, ...optionalDependencies, ...peerDependencies }).flatMap(
  (name) => [name, `${name}/*`],
);

/**
 * The files that src/index.ts exports from are entries too. So the code of each name is in files of its own, and the
 * bundler of a program takes only those whose names it uses.
 */
const libraryEntries = Object.fromEntries(
  [...readFileSync(path.join(ROOT, "src", "index.ts"), "utf8").matchAll(/ from "\.\/(.*)\.js";/g)].map(
    ([, file]) => [`src/${file}`, `src/${file}.ts`],
  ),
);

const neverCalled = {
  name: "never-called",
  setup({ onLoad }) {
    onLoad({ filter: NEVER_CALLED }, ({ path: file }) => ({ contents: emptied(readFileSync(file, "utf8")) }));
  },
};

rmSync(CHUNKS, { recursive: true, force: true });
const { metafile } = await build({
  absWorkingDir: ROOT,
  entryPoints: {
    ...libraryEntries,
    "src/index": "src/index.ts",
    "src/internal": "src/internal.ts",
    "src/schema/index": "src/schema/index.ts",
    "web/serial/web-serial": "web/serial/web-serial.ts",
    "web/serial/open-plotter": "web/serial/open-plotter.ts",
    "server/plotter/open-plotter": "server/plotter/open-plotter.ts",
    "server/index": "server/index.ts",
    "server/main": "server/main.ts",
    // Beside the chunks that start them (server/planning/bounded-thread.ts).
    "chunks/plan-worker": "server/planning/plan-worker.ts",
    "chunks/plan-command-worker": "server/cli/plan/plan-command-worker.ts",
  },
  outdir: "dist",
  bundle: true,
  splitting: true,
  format: "esm",
  platform: "node",
  target: "es2022",
  external,
  plugins: [neverCalled],
  chunkNames: "chunks/[name]-[hash]",
  metafile: true,
  logLevel: "warning",
});
// esbuild adds imports without names, to keep the order in which modules run. Nothing depends on that order (see
// "sideEffects" in package.json), and such an import would make a bundler load chunks that are loaded on demand.
for (const entry of ["index", ...Object.keys(libraryEntries).map((name) => name.slice(4))]) {
  const file = path.join(ROOT, "dist", "src", `${entry}.js`);
  writeFileSync(file, readFileSync(file, "utf8").replace(/^import "[^"]+";\n/gm, ""));
}
const inputs = Object.keys(metafile.inputs).map((file) => path.join(ROOT, file));
writeFileSync(path.join(CHUNKS, "licences.txt"), licencesOf(inputs));
