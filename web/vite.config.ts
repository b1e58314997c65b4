import { defineConfig, type Plugin } from "vite";
import { licencePlugins } from "../scripts/licences.mjs";
import { NEVER_CALLED, emptied } from "../scripts/never-called.mjs";

/**
 * The page is written for React, with React's types, and runs on Preact: the same components in a fifth of React's size,
 * which every first visit would load.
 */
export const WITH_PREACT = { alias: { react: "preact/compat", "react-dom": "preact/compat" } };

/** The first visit would load them. */
const withoutNeverCalled = (): Plugin => ({
  name: "without-never-called",
  apply: "build",
  transform: (source, id) => (NEVER_CALLED.test(id) ? emptied(source) : null),
});

/**
 * Puts what the SVG reader imports on demand beside it. The workers load all readers with the first drawing; in files of
 * their own, these parts would share code with the worker, which would then be one more file of the first load.
 */
const withWholeReader = (): Plugin => ({
  name: "with-whole-reader",
  apply: "build",
  enforce: "pre",
  transform(source, id) {
    if (!id.endsWith("/src/import/svg/import-svg.ts")) return null;
    const files: string[] = [];
    const code = source.replace(/await import\(("[^"]+")\)/g, (_, file: string) => `part${files.push(file)}`);
    return files.map((file, i) => `import * as part${i + 1} from ${file};`).join("") + code;
  },
});

/** The files of public/ that the page needs when it is opened offline. The other icons are only used to install it. */
const PUBLIC_FILES = ["icon.svg", "manifest.webmanifest"];

/** Builds the service worker and writes the names of all of the page's files into it. */
const serviceWorker = (): Plugin => ({
  name: "service-worker",
  apply: "build",
  buildStart() {
    this.emitFile({ type: "chunk", id: "pwa/service-worker.ts", fileName: "service-worker.js" });
  },
  generateBundle: {
    order: "post",
    handler(_options, bundle) {
      const isNeededOffline = (name: string) =>
        /^assets\/.*\.(js|css|svg)$/.test(name) || /^assets\/inter-latin-wght-normal-.*\.woff2$/.test(name);
      const built = Object.keys(bundle).filter(isNeededOffline);
      // Relative to the service worker, because the static page may be in any folder of a site.
      const files = ["./", ...PUBLIC_FILES, ...built].sort();
      // Each of these two names the hashes of all other files, so its own hash changes with any of them.
      const version = built.filter((name) => /^assets\/index-/.test(name)).join();
      const worker = bundle["service-worker.js"];
      if (worker?.type !== "chunk") throw new Error("no service worker was built");
      const shell = JSON.stringify(JSON.stringify({ version, files }));
      worker.code = worker.code.replace(/(["'`])__SHELL__\1/, () => shell);
      if (!worker.code.includes(version))
        throw new Error("the list of files was not written into the service worker");
    },
  },
});

const licences = licencePlugins();

// plotwright's server serves the page under a strict content security policy, so nothing is inlined into the HTML.
export default defineConfig({
  // Relative to the package, where npm runs its scripts.
  root: "web",
  // The static app may be in any folder of a site. The server serves the page at its root.
  base: process.env["VITE_BACKEND"] === "browser" ? "./" : "/",
  resolve: WITH_PREACT,
  plugins: [withoutNeverCalled(), serviceWorker(), licences.inPage()],
  build: {
    outDir: "../dist/web",
    emptyOutDir: true,
    // The same browsers are named in index.html, and in docs/troubleshooting.md.
    target: ["chrome105", "edge105", "firefox121", "safari16.4"],
    assetsInlineLimit: 0,
    modulePreload: { polyfill: false },
    rolldownOptions: {
      output: {
        // The whole first load is one file, which compresses better than twenty small ones. The service worker is not in
        // it: it is an entry of its own.
        codeSplitting: {
          groups: [
            { name: "index", tags: ["$initial"], test: /^(?!.*[\\/]pwa[\\/](service-worker|shell-rules)\.)/ },
          ],
        },
      },
    },
  },
  worker: { format: "es", plugins: () => [withoutNeverCalled(), withWholeReader(), licences.inWorkers()] },
  server: {
    port: 5173,
    // Only the versioned interface: the client's sources are also under /api/.
    proxy: { "^/api/v1/": { target: "http://127.0.0.1:9080", ws: true } },
  },
});
