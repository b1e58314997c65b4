import react from "@vitejs/plugin-react";
import { defineConfig, type Plugin } from "vite";
import { licencePlugins } from "../scripts/licences.mjs";

/**
 * Parts of libraries that are referred to, so that no tree-shaking removes them, and never called here:
 * zod's writer of JSON schemas, and of css-select's default adapter (we give our own) what writes and changes
 * documents. Together a twentieth of the first visit's code.
 */
const NEVER_CALLED =
  /\/(zod\/v4\/core\/(json-schema-processors|to-json-schema)|domutils\/dist\/(feeds|legacy|manipulation|stringify))\.js$/;

/** A library that does not say of itself that a file of it from which nothing is taken may be left out. */
const ONLY_WHAT_IS_USED = /\/clipper2-ts\/dist\//;

/** Puts functions without a body in the place of those. */
const withoutNeverCalled = (): Plugin => ({
  name: "without-never-called",
  apply: "build",
  transform(source, id) {
    const file = id.replaceAll("\\", "/");
    if (ONLY_WHAT_IS_USED.test(file)) return { code: source, moduleSideEffects: false };
    if (!NEVER_CALLED.test(file)) return null;
    const names = [...source.matchAll(/^export (?:function|const) (\w+)/gm)].map((match) => match[1]);
    const renamed = [...source.matchAll(/^export \{ \w+ as (\w+) \};$/gm)].map((match) => match[1]);
    return [...names, ...renamed].map((name) => `export const ${name} = () => undefined;`).join("\n");
  },
});

/** Of public/: what belongs to the page when it is opened without the server; the other icons are for installing it. */
const PUBLIC_FILES = ["icon.svg", "manifest.webmanifest"];

/** The service worker, with the names of all the files of the page put in. */
const serviceWorker = (): Plugin => ({
  name: "service-worker",
  apply: "build",
  buildStart() {
    this.emitFile({ type: "chunk", id: "pwa/service-worker.ts", fileName: "service-worker.js" });
  },
  generateBundle: {
    order: "post",
    handler(_options, bundle) {
      const built = Object.keys(bundle).filter((name) => /^assets\/.*\.(js|css|svg)$/.test(name));
      // Relative to the service worker, since the static page may be in any folder of a site.
      const files = ["./", ...PUBLIC_FILES, ...built].sort();
      // Every other file's hash is named in one of these two, and so changes theirs.
      const version = built.filter((name) => /^assets\/index-/.test(name)).join();
      const worker = bundle["service-worker.js"];
      if (worker?.type !== "chunk") throw new Error("no service worker was built");
      const shell = JSON.stringify(JSON.stringify({ version, files }));
      worker.code = worker.code.replace(/(["'`])__SHELL__\1/, () => shell);
      if (!worker.code.includes(version)) throw new Error("the service worker was not told its files");
    },
  },
});

const licences = licencePlugins();

// The page is served by plotwright's own server under a strict content security policy:
// everything is a file of its own, nothing is inlined into the HTML.
export default defineConfig({
  // Relative to the package, where npm runs its scripts.
  root: "web",
  // The static app may be in any folder of a site; the server has the page at its root.
  base: process.env["VITE_BACKEND"] === "browser" ? "./" : "/",
  plugins: [react(), withoutNeverCalled(), serviceWorker(), licences.inPage()],
  build: {
    outDir: "../dist/web",
    emptyOutDir: true,
    target: "es2022",
    assetsInlineLimit: 0,
    modulePreload: { polyfill: false },
    rolldownOptions: {
      output: {
        // What the first load needs anyway in one file, where it packs better than in ten small ones.
        codeSplitting: {
          groups: [
            {
              name: "index",
              test: /node_modules\/(react|react-dom|scheduler|zod|zustand)\/|\/web\/ui\/(choice|format|group|icon|lazy-part|number-box|number-field|settings-group|text)\.|\/web\/(state|drawing|layers|pens|motion|queue|plotter|preview)\/text\.|\/web\/drawing\/paper\.|\/web\/scene\/placing\.|\/src\/(schema\/(?!studio|hand-moves)|drawing|machines\/(?!set-up)|errors)/,
            },
          ],
        },
      },
    },
  },
  worker: { format: "es", plugins: () => [withoutNeverCalled(), licences.inWorkers()] },
  server: {
    port: 5173,
    // Only the versioned interface: /api/ is also where the sources of the client lie.
    proxy: { "^/api/v1/": { target: "http://127.0.0.1:9080" } },
  },
});
